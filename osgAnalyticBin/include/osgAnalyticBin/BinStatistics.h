// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/Object>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace osg {
class NodeVisitor;
}

namespace osgAnalyticBin {

class CullTraversal;
struct CoveredPicture;

/// The verdicts of bins in one cull traversal.
struct BinCounts {
    /// Tested bins: the sum of the next three.
    std::uint32_t tested = 0;
    /// Tiles that were culled.
    std::uint32_t outside = 0;
    /// Tiles wholly in view, below which nothing more is tested.
    std::uint32_t inside = 0;
    /// Tiles that are kept although some plane is undecided.
    std::uint32_t straddling = 0;
    /// Bins outside because they are behind the horizon.
    std::uint32_t hidden = 0;
    /// Bins outside because they are beyond an edge of the frustum, but outside no single plane.
    std::uint32_t beyondEdge = 0;
    /// Bins outside because they are behind terrain.
    std::uint32_t occluded = 0;
    /// Frame number of the traversal.
    unsigned int frame = 0;
};

/// Why a bin is outside: one of the last counters before `frame`; null: by a plane.
using BinReason = std::uint32_t BinCounts::*;

/// The counters of one cull visitor. They live in the visitor's user data container, so that cull threads share
/// nothing: each visitor is used by one thread at a time. A new frame number starts from zero.
class OSGANALYTICBIN_EXPORT BinStatistics : public osg::Object {
public:
    BinStatistics() = default;
    /// Counters that start from zero: counts are not copied.
    BinStatistics(const BinStatistics& other, const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_Object(osgAnalyticBin, BinStatistics)

        /// The counters of the visitor, made at the first call.
        [[nodiscard]] static BinStatistics& of(osg::NodeVisitor& visitor);

    /// Returns: nullptr when the visitor has met no bin yet.
    [[nodiscard]] static const BinStatistics* find(const osg::NodeVisitor& visitor);

    /// Counts one tested tile.
    void count(core::Side side, unsigned int frame, BinReason reason = nullptr) noexcept;

    /// Counts several tested tiles of the frame that `counts` names; `tested` is not read.
    void add(const BinCounts& counts) noexcept;

    /// For visitors that watch which nodes they meet. With true, tiles are tested one by one and the visitor meets the
    /// culled ones too; without it, siblings are tested together and culled ones are not visited. The verdicts are the
    /// same.
    void setTileByTile(bool on) noexcept { _isTileByTile = on; }
    /// Default: false.
    [[nodiscard]] bool isTileByTile() const noexcept { return _isTileByTile; }

    /// The part of the picture that terrain covers. Only for the visitor's own thread. Returns: null if this frame had
    /// no search for tiles behind terrain.
    [[nodiscard]] const std::shared_ptr<const CoveredPicture>& covered() const noexcept { return _covered; }
    /// Sets what terrain covers in the frame with this number.
    void setCovered(std::shared_ptr<const CoveredPicture> covered, unsigned int frame) noexcept;

    /// The condition that is missing for terrain to hide tiles, in a few words, such as "occlusion=off". Only for the
    /// visitor's own thread. Returns: null if this frame had a search for tiles behind terrain, or no database.
    [[nodiscard]] const char* notCovered() const noexcept { return _covered ? nullptr : _notCovered; }
    /// Sets the condition in the frame with this number; the text has to stay.
    void setNotCovered(const char* condition, unsigned int frame) noexcept;

    /// Sets the counts to zero, for a visitor that traverses more than once in a frame.
    void reset() noexcept;

    /// The counts of the traversal last begun; safe to call from another thread, exact once the traversal is over.
    [[nodiscard]] BinCounts getCounts() const noexcept;

protected:
    ~BinStatistics() override = default;

private:
    friend class CullTraversal;

    void beginFrame(unsigned int frame) noexcept;

    std::array<std::atomic<std::uint32_t>, 6> _counters{};  // all but `tested` and `frame`
    std::atomic<unsigned int> _frame{0};
    const osg::NodeVisitor* _owner = nullptr;
    osg::ref_ptr<osg::Referenced> _traversal;  // what culling keeps with the visitor
    bool _isTileByTile = false;
    std::shared_ptr<const CoveredPicture> _covered;
    const char* _notCovered = nullptr;
};

}  // namespace osgAnalyticBin
