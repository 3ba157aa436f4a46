// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "InstalledDatabase.h"
#include "TileBlock.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/core/mesh/MeshCover.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <osg/Node>
#include <osg/NodeCallback>
#include <osg/Referenced>
#include <osg/observer_ptr>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace osgAnalyticBin {

/// What a tile's bin has to be expanded by.
struct Widening {
    AnalyticBin bin;
    bool isBoundless = false;  ///< the extents of what was found are unknown

    [[nodiscard]] bool any() const { return isBoundless || bin.valid(); }
    [[nodiscard]] bool contains(const Widening& other) const {
        if (isBoundless || !other.any()) return true;
        return !other.isBoundless && bin.valid() && bin.contains(other.bin);
    }
    void expandBy(const Widening& other) {
        isBoundless = isBoundless || other.isBoundless;
        bin.expandBy(other.bin);
    }
    /// The expanded bin. An unknown (invalid) bin stays unknown.
    [[nodiscard]] AnalyticBin widened(const AnalyticBin& known) const {
        if (isBoundless || !known.valid()) return {};
        AnalyticBin wider = known;
        wider.expandBy(bin);
        return wider;
    }
};

/// The installer's record of a tile. The tile's cull callback owns it, and the tiles of files that the tile pages refer
/// to it.
/// Threads: doubt(), settle() and has() at any time; what says so by its guard; the rest only while no cull traversal
/// runs.
class InstalledTile : public osg::Referenced {
public:
    /// Why a tile is not culled, or hides nothing.
    enum Reason : unsigned int {
        /// Content below it is not in its bin: it is not culled, until the bin is expanded.
        Outgrown = 1u << 0,
        /// The bin holds heights that were declared alone, and OSG's sphere bounds what is loaded: both cull the tile.
        Declared = 1u << 1,
        /// The mesh has changed and has not been looked at since: the tile's own callback tests it, not its family.
        MeshUnread = 1u << 2,
        /// The mesh has changed since bins were installed.
        MeshChanged = 1u << 3,
        /// The mesh has moved since then: its former place may be empty.
        MeshMoved = 1u << 4,
        /// The mesh is not known to fill its place.
        NotFilled = 1u << 5,
        /// The tiles of a file that is paged below are not known to fill the place.
        GapBelow = 1u << 6,
        /// The tile draws something that is not known to hide what is behind it.
        SeeThrough = 1u << 7,
        /// The tile, or something below it, may be drawn in front of what is nearer, or beside its triangles: nothing
        /// hides the tile.
        IgnoresDepth = 1u << 8,
        /// The application has switched off culling for the tile's mesh, or for something below it: never culled.
        NeverCulled = 1u << 9,
        /// Content stands in the tile beside the mesh that was read, and may be higher.
        MoreThanMesh = 1u << 10,
    };

    /// How deep the bins of a tile and of all tiles above it are.
    struct Depth {
        /// The least length of skirts, in metres, that one of them has room for below it. Infinity: all of them hold
        /// the skirts of what is below already.
        double skirt = std::numeric_limits<double>::infinity();
        /// The altitude in metres to which all of them reach down at vertical scale 1, skirts included.
        double low = -std::numeric_limits<double>::infinity();
    };

    /// Where a tile lies, for the tiles below it.
    struct Extents {
        core::GeodeticBin bin;
        bool isMeasured = false;  ///< they are those of its mesh, and finer tiles may leave them
        Depth depth;
    };

    /// `above`, `number`: see parent and ordinal.
    InstalledTile(InstalledDatabase& database, InstalledTile* above, const TileFrame& frame,
                  std::optional<std::size_t> number)
        : file(frame.file), ordinal(number), isAttached(frame.isAttached), parent(above), _database(&database) {}

    /// For a copied callback: it belongs to no node.
    InstalledTile(const InstalledTile& other);

    const std::string file;
    /// Of the tile in its file; nullopt: the record is for a node without a bin, between tiles, and has no extents.
    const std::optional<std::size_t> ordinal;
    /// See TileFrame.
    const bool isAttached = false;
    /// The tile that pages the file, or that the tile stands below; null: none.
    const osg::ref_ptr<InstalledTile> parent;
    Extents extents;
    /// The tile's stored bin, or that of the nearest ancestor with one. Not valid: there is none.
    AnalyticBin stored;
    /// What was found below that the bin did not hold; null: nothing. Guarded by the database.
    std::unique_ptr<Widening> widening;

    /// A globe inside another globe has its own.
    [[nodiscard]] InstalledDatabase& database() const { return *_database; }

    /// Sets the node that carries the callback; null: from now on the record is for no node.
    void setNode(const osg::Node* culled) { _culled = culled; }
    /// Whether `node` is the one that the bin was made for. A clone of a scene may share the callback.
    [[nodiscard]] bool isFor(const osg::Node* node) const { return node == _culled; }
    /// Sets the callback that owns the record.
    void setCallback(osg::NodeCallback* callback) { _callback = callback; }
    /// Returns: null when it is gone. At any time.
    [[nodiscard]] osg::ref_ptr<osg::NodeCallback> callback() const {
        osg::ref_ptr<osg::NodeCallback> callback;
        (void)_callback.lock(callback);
        return callback;
    }

    /// Call when the tile was fitted anew: from now on what is reported for this record counts for the next one. Those
    /// who have asked for files before refer to this one still. Requires: the next one is complete.
    void setSuccessor(InstalledTile& next);
    /// The record of the tile at present: this one, or the last of its successors. At any time.
    [[nodiscard]] osg::ref_ptr<InstalledTile> latest();
    /// That of the tile above. Null: there is none.
    [[nodiscard]] osg::ref_ptr<InstalledTile> above() const { return parent ? parent->latest() : nullptr; }

    /// Call when one of these reasons, or several, hold for the tile.
    void doubt(unsigned int reasons);
    /// Call when they do not hold any more.
    void settle(unsigned int reasons);
    /// Call when these reasons hold for the tile, or for something below it, and for all tiles above.
    void doubtUpwards(unsigned int reasons) {
        for (osg::ref_ptr<InstalledTile> at = reasons != 0 ? latest() : nullptr; at; at = at->above())
            at->doubt(reasons);
    }
    /// Whether one of these reasons holds.
    [[nodiscard]] bool has(unsigned int reasons) const {
        return (_reasons.load(std::memory_order_relaxed) & reasons) != 0;
    }

    /// Whether the callback may cull this node: the bin was made for it and contains everything below it.
    [[nodiscard]] bool mayCull(const osg::Node* node) const {
        return isFor(node) && !has(Outgrown | NeverCulled) && !_database->isRemoved();
    }
    /// Whether the horizon must not rely on the tile.
    [[nodiscard]] bool isSeeThrough() const { return has(SeeThrough | MeshMoved); }
    /// Whether the mesh fills its place and cannot be seen through, is as it was, and all that the tile draws by
    /// itself, and levels below leave no gap.
    [[nodiscard]] bool isCertain() const {
        return !has(NotFilled | SeeThrough | MeshMoved | MeshChanged | GapBelow | MoreThanMesh);
    }

    /// Assigns the tile a slot in a family. The tile's callback calls fillSlot().
    void joinFamily(TileBlock& block, std::size_t slot);
    [[nodiscard]] bool hasFamily() const { return _block.valid(); }
    /// The tile is culled by its own callback alone from now on.
    void leaveFamily();
    /// Copies the tile's bin and bounds into its family's slot, if it has a family.
    void fillSlot(const TileBlock::Slot& tile, const TileBlock::Bins& bins);
    /// Until the slot is filled again, the tile is tested by its own callback.
    void emptySlot();

    /// What the tile's own mesh covers. It holds until the mesh changes.
    void setCover(const core::MeshCover& cover);
    /// Where the tile belongs: the rectangle of its mesh when it was installed. Empty: not known.
    [[nodiscard]] const core::GeodeticBin& place() const { return _place; }

    /// Sets the lowest altitudes of the tile's own mesh, by cells; null: they cannot be found. Where one is not known
    /// none is kept.
    void setPlates(std::shared_ptr<const core::GroundPlates> plates);
    /// Returns: null when they are unknown or the mesh has changed since. Plates do not change: other threads may keep
    /// them.
    [[nodiscard]] const std::shared_ptr<const core::GroundPlates>& plates() const {
        static const std::shared_ptr<const core::GroundPlates> unknown;
        return has(MeshChanged) ? unknown : _plates;
    }
    /// Returns: true the first time, unless setPlates() was called before.
    [[nodiscard]] bool askForPlates() {
        return _numberOfPlates == 0 && !_isAskedForPlates.exchange(true, std::memory_order_relaxed);
    }
    /// An identifier of the plates, never used twice. 0: none were set.
    [[nodiscard]] std::uint64_t numberOfPlates() const { return _numberOfPlates; }

protected:
    ~InstalledTile() override;

private:
    // Requires: the lock.
    void tellFamily();

    const osg::ref_ptr<InstalledDatabase> _database;
    const osg::Node* _culled = nullptr;
    osg::observer_ptr<osg::NodeCallback> _callback;
    osg::ref_ptr<InstalledTile> _successor;
    std::atomic<unsigned int> _reasons{NotFilled};
    bool _isSlotFilled = false;
    std::atomic<bool> _isAskedForPlates{false};
    osg::ref_ptr<TileBlock> _block;
    std::size_t _slot = 0;
    std::shared_ptr<const core::GroundPlates> _plates;
    std::uint64_t _numberOfPlates = 0;
    core::GeodeticBin _place;
};

}  // namespace osgAnalyticBin
