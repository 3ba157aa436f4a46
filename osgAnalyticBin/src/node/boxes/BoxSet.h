// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "MeshBox.h"

#include <osgAnalyticBin/BoxIndex.h>
#include <osgAnalyticBin/CullOptions.h>

#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

/// What is known of a LOD of a photogrammetry set. Cull traversals read it; it changes in update traversals alone.
class BoxTile final : public osg::Referenced {
public:
    /// `parent`: the LOD above it; null: none.
    explicit BoxTile(BoxTile* parent) : _parent(parent) {}

    /// `isComplete`: the box holds all that is paged below, loaded or not.
    void set(const MeshBox& box, bool isComplete);

    [[nodiscard]] BoxTile* parent() { return _parent.get(); }
    [[nodiscard]] const MeshBox& box() const { return _box; }
    [[nodiscard]] bool isComplete() const { return _isComplete; }
    /// Whether there is a box to test.
    [[nodiscard]] bool isTested() const { return _isTested; }
    [[nodiscard]] const TestedBox& tested() const { return _tested; }

protected:
    ~BoxTile() override = default;

private:
    const osg::ref_ptr<BoxTile> _parent;
    TestedBox _tested;
    bool _isTested = false;
    bool _isComplete = false;
    MeshBox _box;
};

/// A photogrammetry set that is culled by boxes. Threads: all but update().
class BoxSet final : public osg::Referenced {
public:
    /// `index` may be null.
    BoxSet(const CullOptions& options, BoxIndex* index) : _options(options), _index(index) {}

    [[nodiscard]] const CullOptions& options() const { return _options; }
    [[nodiscard]] const BoxIndex* index() const { return _index.get(); }

    /// Says that boxes are taken off: what has them still is not culled by them.
    void setRemoved() { _isRemoved.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool isRemoved() const { return _isRemoved.load(std::memory_order_relaxed); }

    /// Says that the content of a file, or a LOD, does not fit the index. Warns once.
    void noteMisfit(const std::string& file);

    /// Says what was read below a tile. It and the tiles above it grow in the next update. `isMisfit`: the index does
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

    const CullOptions _options;
    const osg::ref_ptr<const BoxIndex> _index;
    std::atomic<bool> _isRemoved{false}, _hasWarned{false};
    std::mutex _mutex;  // guards what follows
    std::vector<Growth> _growths;
};

}  // namespace osgAnalyticBin
