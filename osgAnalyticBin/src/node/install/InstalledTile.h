// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../cull/TileBlock.h"

#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <osg/Node>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

class Database;

/// What the installer keeps beside a tile's cull callback: the node that the bin was made for, whether the bin holds
/// everything below the node at present, and the nodes whose sphere test was switched off.
/// Threads: mayCull() and keepVisible() at any time; the rest where no cull traversal runs.
class InstalledTile final : public osg::Referenced {
public:
    /// `culled`: the node that carries the callback.
    InstalledTile(const osg::Node& culled, Database& database);

    /// That of a copied callback: for no node.
    InstalledTile(const InstalledTile& other);

    [[nodiscard]] Database& database() const { return *_database; }

    /// Whether `node` is the one that the bin was made for. A clone of a scene may share the callback.
    [[nodiscard]] bool isFor(const osg::Node* node) const { return node == _culled; }

    /// Whether the callback may cull this node: it is the bin's own, and nothing stands below it that the bin does not
    /// hold.
    [[nodiscard]] bool mayCull(const osg::Node* node) const {
        return isFor(node) && !_isKeptVisible.load(std::memory_order_relaxed);
    }

    /// Keeps the tile visible until this is called with false.
    void keepVisible(bool kept);

    [[nodiscard]] bool isKeptVisible() const { return _isKeptVisible.load(std::memory_order_relaxed); }

    /// Gives the tile a slot in a family. The tile's callback fills it.
    void joinFamily(TileBlock& block, std::size_t slot);
    [[nodiscard]] bool hasFamily() const { return _block.valid(); }
    /// From now on only the tile's own callback culls it.
    void leaveFamily();
    /// Says that the mesh has changed since the bin was fitted. The family leaves the tile to its callback until
    /// trustMesh() is called. `isMoved`: it has left its place, which may be empty now.
    void doubtMesh(bool isMoved);
    void trustMesh();
    [[nodiscard]] bool isMeshDoubted() const { return _isMeshDoubted.load(std::memory_order_relaxed); }
    /// Copies the numbers that the family, if there is one, tests the tile by.
    void fillSlot(const TileBlock::Slot& tile, const TileBlock::Bins& bins);
    /// Has the family leave the tile to its callback until the slot is filled again.
    void emptySlot();

    /// Says that what the tile draws can be seen through. At any time.
    void setSeeThrough() { _isSeeThrough.store(true, std::memory_order_relaxed); }
    /// Whether the horizon must not rely on the tile: it can be seen through, or its place may be empty.
    [[nodiscard]] bool isSeeThrough() const { return _isSeeThrough.load(std::memory_order_relaxed) || isMoved(); }
    /// Whether the mesh has left its place since bins were installed.
    [[nodiscard]] bool isMoved() const { return _isMoved.load(std::memory_order_relaxed); }

    /// What is known of the altitudes of the tile's own mesh, cell by cell; null: nothing can be known.
    void setPlates(std::unique_ptr<const core::GroundPlates> plates);
    /// Returns: nullptr where nothing is known, and once the mesh has changed.
    [[nodiscard]] const core::GroundPlates* plates() const { return isMeshChanged() ? nullptr : _plates.get(); }
    /// Returns: true the first time, unless setPlates() was called before.
    [[nodiscard]] bool askForPlates() {
        return _numberOfPlates == 0 && !_isAskedForPlates.exchange(true, std::memory_order_relaxed);
    }
    /// Tells plates apart: no two that were ever set have the same number. 0: none were set.
    [[nodiscard]] std::uint64_t numberOfPlates() const { return _numberOfPlates; }
    /// Whether a change of the mesh was noticed since bins were installed.
    [[nodiscard]] bool isMeshChanged() const { return _isMeshChanged.load(std::memory_order_relaxed); }

    /// Keeps what others observe as long as the tile is there.
    void keep(const osg::Referenced& observed) { _kept = &observed; }

    /// Switches OSG's sphere test off on a node where it is on.
    void suspendSphere(osg::Node& node);

    /// Switches the sphere test on again on the nodes where it was on. Requires: isFor(&culled).
    void resumeSpheres(osg::Node& culled);

    /// Whether the test was on at the i-th call of suspendSphere(): what a clone of the nodes has to go back to. Nodes
    /// that came later count as such where it was on.
    [[nodiscard]] bool wasActive(std::size_t i) const;

protected:
    ~InstalledTile() override;

private:
    void tellFamily();

    const osg::Node* const _culled;
    const osg::ref_ptr<Database> _database;
    std::atomic<bool> _isKeptVisible{false};
    std::atomic<bool> _isMeshDoubted{false};
    std::atomic<bool> _isMeshChanged{false};  // since bins were installed
    std::unique_ptr<const core::GroundPlates> _plates;
    std::uint64_t _numberOfPlates = 0;
    std::atomic<bool> _isAskedForPlates{false};
    osg::ref_ptr<TileBlock> _block;
    std::size_t _slot = 0;
    bool _isSlotFilled = false;
    std::atomic<bool> _isSeeThrough{false};
    std::atomic<bool> _isMoved{false};
    osg::ref_ptr<const osg::Referenced> _kept;
    bool _wasCulledActive = false;                    // of the culled node, which owns this and must not be owned by it
    std::vector<osg::ref_ptr<osg::Node>> _suspended;  // other nodes
    std::size_t _suspensions = 0;                     // calls of suspendSphere()
    std::vector<std::size_t> _wasInactive;            // those that met a node without the test
};

}  // namespace osgAnalyticBin
