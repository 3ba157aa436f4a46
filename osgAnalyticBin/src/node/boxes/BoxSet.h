// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../index/AutoIndex.h"
#include "../surface/MeshBox.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>

#include <osg/CullingSet>
#include <osg/Node>
#include <osg/Referenced>
#include <osg/observer_ptr>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

/// How a LOD of a photogrammetry set is tested.
struct BoxTest {
    TestedBox box;          ///< what has to be out of view
    bool isTested = false;  ///< otherwise it is never culled
    /// Whether the box holds all that is paged below, loaded or not. Otherwise OSG's own sphere of the node has to be
    /// out of view, too.
    bool isComplete = false;

    [[nodiscard]] core::Side sideOf(const osg::Polytope::PlaneList& planes, core::PlaneMask& undecided,
                                    const osg::Node& node) const {
        if (!isTested) return core::Side::Straddling;
        return box.classify(planes, undecided, isComplete ? nullptr : &node.getBound());
    }
    /// What is tested for other reasons than the planes: small features, occluders.
    [[nodiscard]] const osg::BoundingSphere& sphereOf(const osg::Node& node) const {
        return isComplete ? box.sphere() : node.getBound();
    }
};

/// The children of a group, with all that their tests need, side by side.
class BoxSlots final : public osg::Referenced {
public:
    struct Slot {
        BoxTest test;
        const osg::Node* node = nullptr;  ///< the child; null: no LOD of the set
        bool isPlain = false;             ///< a LOD or PagedLOD, and not of a class derived from these
        bool wasCullingActive = true;
    };

    explicit BoxSlots(std::size_t count) : slots(count) {}

    std::vector<Slot> slots;

protected:
    ~BoxSlots() override = default;
};

/// What is known of a LOD of a photogrammetry set. Cull traversals read it; it changes in update traversals alone.
class BoxTile final : public osg::Referenced {
public:
    /// `parent`: the LOD above it; null: none.
    explicit BoxTile(BoxTile* parent) : _parent(parent) {}

    /// `isComplete`: the box holds all that is paged below, loaded or not.
    void set(const MeshBox& box, bool isComplete);

    /// Keeps a slot up to date with the tile.
    void join(BoxSlots& slots, std::size_t number);

    /// Records that something below differs from the index: the box never becomes complete.
    void setMisfit() { _isMisfit = true; }
    [[nodiscard]] bool isMisfit() const { return _isMisfit; }

    [[nodiscard]] BoxTile* parent() { return _parent.get(); }
    [[nodiscard]] const MeshBox& box() const { return _box; }
    [[nodiscard]] bool isComplete() const { return _test.isComplete; }
    [[nodiscard]] const BoxTest& test() const { return _test; }

protected:
    ~BoxTile() override = default;

private:
    const osg::ref_ptr<BoxTile> _parent;
    MeshBox _box;
    BoxTest _test;
    bool _isMisfit = false;
    osg::ref_ptr<BoxSlots> _slots;
    std::size_t _slot = 0;
};

/// A photogrammetry set that is culled by boxes. Threads: all but update().
class BoxSet final : public osg::Referenced {
public:
    BoxSet(const CullOptions& options, ChosenIndex index) : _options(options), _index(std::move(index)) {}

    [[nodiscard]] const CullOptions& options() const { return _options; }
    /// Returns: null where there is none, or it is not whole yet.
    [[nodiscard]] osg::ref_ptr<const BinIndex> index() const {
        return _index.making ? _index.making->whole() : _index.index;
    }
    /// Returns: null where none is made.
    [[nodiscard]] const osg::ref_ptr<AutoIndex>& making() const { return _index.making; }

    /// Records that the tiles of a file got boxes without an index; an update gives them those of the index that is
    /// being made, if any, when it is complete. `parent`: the LOD that pages the file; null: none.
    void awaitIndex(osg::Node& root, const std::string& file, BoxTile* parent,
                    const std::vector<osg::ref_ptr<BoxTile>>& tiles);

    /// Records that boxes are removed: tiles that still have them are not culled by them.
    void setRemoved() { _isRemoved.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool isRemoved() const { return _isRemoved.load(std::memory_order_relaxed); }

    /// Reports that the content of a file, or a LOD, does not fit the index. Warns once.
    void noteMisfit(const std::string& file);

    /// Reports what was read below a tile. The tile and those above it are expanded in the next update. `isMisfit`: the
    /// index does
    /// not know the content, and no tile above it is complete.
    void grow(BoxTile& tile, const MeshBox& box, bool isMisfit);

    /// In update traversals.
    void update();

protected:
    ~BoxSet() override = default;

private:
    struct Growth {
        osg::ref_ptr<BoxTile> tile;
        MeshBox box;
        bool isMisfit;
    };

    // The content of a file.
    struct Awaiting {
        osg::observer_ptr<osg::Node> root;
        std::string file;
        osg::ref_ptr<BoxTile> parent;
        std::vector<osg::ref_ptr<BoxTile>> tiles;
    };

    void adopt(const Awaiting& content, const BinIndex& index);
    void adoptIndex();

    const CullOptions _options;
    const ChosenIndex _index;
    std::atomic<bool> _isRemoved{false}, _hasWarned{false};
    std::mutex _mutex;  // guards what follows, and changes of tiles in the scene
    std::vector<Growth> _growths;
    std::vector<Awaiting> _awaiting;
};

}  // namespace osgAnalyticBin
