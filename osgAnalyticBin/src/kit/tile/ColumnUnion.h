// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingSphere>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <mutex>

namespace osgAnalyticBin {

/// A sphere about the columns of all tiles below a group, so that the search for the lowest surface passes over the
/// group as a whole. It never shrinks: where a tile was removed the terrain may have a hole. Frame: ECEF, metres.
/// Threads: addDoubts() at any time; the rest where no cull traversal runs.
class ColumnUnion final : public osg::Referenced {
public:
    /// Whether the sphere holds the columns of all that is shown below the group.
    [[nodiscard]] bool isSure() const { return _doubts.load(std::memory_order_relaxed) == 0; }
    [[nodiscard]] const osg::BoundingSphered& sphere() const { return _sphere; }

    /// Expands this union, and those above it, by a tile's column. Rounding: see SelectionWalk.
    void expandBy(const osg::BoundingSphered& column);

    /// Counts what may be outside of the sphere, here and above. Negative: it is inside again.
    void addDoubts(int number);

    /// Says which union holds this one; null: none any more, and the doubts are no longer counted there.
    void setAbove(ColumnUnion* above);
    [[nodiscard]] ColumnUnion* above() const { return _above.get(); }

protected:
    ~ColumnUnion() override;

private:
    // Requires: the lock.
    void countDoubts(int number);

    static inline std::mutex _connecting;  // guards what is above, of all unions
    std::atomic<int> _doubts{0};
    osg::BoundingSphered _sphere;
    osg::ref_ptr<ColumnUnion> _above;
};

}  // namespace osgAnalyticBin
