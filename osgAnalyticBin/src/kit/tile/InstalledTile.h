// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "InstalledDatabase.h"
#include "TileBlock.h"

#include <osgAnalyticBin/core/mesh/MeshCover.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <osg/Node>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace osgAnalyticBin {

/// The installer's record of a tile, owned by the tile's cull callback: the node that the bin was made for, and
/// whether the bin contains everything below that node.
/// Threads: mayCull() and keepVisible() at any time; the rest only while no cull traversal runs.
class InstalledTile final : public osg::Referenced {
public:
    /// `culled`: the node that carries the callback.
    InstalledTile(const osg::Node& culled, InstalledDatabase& database) : _culled(&culled), _database(&database) {}

    /// For a copied callback: it belongs to no node.
    InstalledTile(const InstalledTile& other);

    [[nodiscard]] InstalledDatabase& database() const { return *_database; }

    /// Whether `node` is the one that the bin was made for. A clone of a scene may share the callback.
    [[nodiscard]] bool isFor(const osg::Node* node) const { return node == _culled; }

    /// Whether the callback may cull this node: the bin was made for it and contains everything below it.
    [[nodiscard]] bool mayCull(const osg::Node* node) const {
        return isFor(node) && !_isKeptVisible.load(std::memory_order_relaxed) && !_database->isRemoved();
    }

    /// While true, the tile is not culled.
    void keepVisible(bool kept);

    [[nodiscard]] bool isKeptVisible() const { return _isKeptVisible.load(std::memory_order_relaxed); }

    /// Whether the bin holds heights that were declared alone. OSG's sphere bounds what is loaded below the tile then,
    /// and the tile is culled by both.
    [[nodiscard]] bool testsSphere() const { return _testsSphere; }
    void setTestsSphere(bool does) { _testsSphere = does; }

    /// Call when the bin holds what is loaded alone, and OSG's sphere of the node what is not: the tile is culled where
    /// both are out of view, by its own callback. At any time.
    void needSphere();
    [[nodiscard]] bool needsSphere() const { return _needsSphere.load(std::memory_order_relaxed); }

    /// Has OSG test no sphere of the node before its callbacks, until restoreSphere(): what the sphere does not hold
    /// may be in view.
    void switchOffSphere(osg::Node& node);
    void restoreSphere(osg::Node& node) const;

    /// Assigns the tile a slot in a family. The tile's callback calls fillSlot().
    void joinFamily(TileBlock& block, std::size_t slot);
    [[nodiscard]] bool hasFamily() const { return _block.valid(); }
    /// The tile is culled by its own callback alone from now on.
    void leaveFamily();
    /// Call when the mesh has changed since the bin was fitted. Until trustMesh() the tile is tested by its own
    /// callback, not by the family. `isMoved`: the mesh has moved, and its former place may be empty.
    void doubtMesh(bool isMoved);
    void trustMesh();
    [[nodiscard]] bool isMeshDoubted() const { return _isMeshDoubted.load(std::memory_order_relaxed); }
    /// Copies the tile's bin and bounds into its family's slot, if it has a family.
    void fillSlot(const TileBlock::Slot& tile, const TileBlock::Bins& bins);
    /// Until the slot is filled again, the tile is tested by its own callback.
    void emptySlot();

    /// Call when the tile draws something that is not known to hide what is behind it. At any time.
    void setSeeThrough() {
        _isSeeThrough.store(true, std::memory_order_relaxed);
        tellFamily();
    }
    /// Whether the horizon must not rely on the tile: it can be seen through, or its place may be empty.
    [[nodiscard]] bool isSeeThrough() const { return _isSeeThrough.load(std::memory_order_relaxed) || isMoved(); }
    /// Call when the tile, or something below it, may be drawn in front of what is nearer: nothing hides the tile from
    /// then on. At any time.
    void ignoreDepth();
    [[nodiscard]] bool obeysDepth() const { return !_ignoresDepth.load(std::memory_order_relaxed); }
    /// What the tile's own mesh covers. It holds until the mesh changes.
    void setCover(const core::MeshCover& cover);
    /// Where the tile belongs: the rectangle of its mesh when it was installed.
    [[nodiscard]] const core::GeodeticBin& place() const { return _place; }
    /// Whether the mesh is known to fill its place.
    [[nodiscard]] bool isFilled() const { return _isFilled.load(std::memory_order_relaxed); }
    /// Call when the tiles of a file that is paged below are not known to fill the place. At any time.
    void noteGapBelow() {
        _hasGapBelow.store(true, std::memory_order_relaxed);
        tellFamily();
    }
    [[nodiscard]] bool hasGapBelow() const { return _hasGapBelow.load(std::memory_order_relaxed); }
    /// Whether the mesh has moved since bins were installed.
    [[nodiscard]] bool isMoved() const { return _isMoved.load(std::memory_order_relaxed); }

    /// Sets the lowest altitudes of the tile's own mesh, by cells; null: they cannot be found.
    void setPlates(std::unique_ptr<const core::GroundPlates> plates);
    /// Returns: nullptr when they are unknown or the mesh has changed since.
    [[nodiscard]] const core::GroundPlates* plates() const { return isMeshChanged() ? nullptr : _plates.get(); }
    /// Returns: true the first time, unless setPlates() was called before.
    [[nodiscard]] bool askForPlates() {
        return _numberOfPlates == 0 && !_isAskedForPlates.exchange(true, std::memory_order_relaxed);
    }
    /// An identifier of the plates, never used twice. 0: none were set.
    [[nodiscard]] std::uint64_t numberOfPlates() const { return _numberOfPlates; }
    /// Whether a change of the mesh was noticed since bins were installed.
    [[nodiscard]] bool isMeshChanged() const { return _isMeshChanged.load(std::memory_order_relaxed); }

    /// Whether the mesh fills its place and cannot be seen through, is as it was, and levels below leave no gap.
    [[nodiscard]] bool isCertain() const { return isFilled() && !isSeeThrough() && !isMeshChanged() && !hasGapBelow(); }

    /// From now on the record is for no node.
    void forgetNode() { _culled = nullptr; }

protected:
    ~InstalledTile() override;

private:
    void tellFamily();

    const osg::Node* _culled;
    const osg::ref_ptr<InstalledDatabase> _database;
    std::atomic<bool> _isKeptVisible{false};
    std::atomic<bool> _isMeshDoubted{false};
    std::atomic<bool> _isMeshChanged{false};  // since bins were installed
    std::unique_ptr<const core::GroundPlates> _plates;
    std::uint64_t _numberOfPlates = 0;
    std::atomic<bool> _isAskedForPlates{false};
    osg::ref_ptr<TileBlock> _block;
    std::size_t _slot = 0;
    bool _isSlotFilled = false;
    bool _testsSphere = false;
    bool _hasSwitchedOffSphere = false;
    std::atomic<bool> _needsSphere{false};
    std::atomic<bool> _isSeeThrough{false};
    std::atomic<bool> _ignoresDepth{false};
    std::atomic<bool> _isFilled{false};
    std::atomic<bool> _hasGapBelow{false};
    core::GeodeticBin _place;
    std::atomic<bool> _isMoved{false};
};

}  // namespace osgAnalyticBin
