// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TileFrame.h>

#include <osg/CoordinateSystemNode>
#include <osg/Group>
#include <osg/Referenced>
#include <osg/observer_ptr>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

/// What tiles and their callbacks know of the database that they belong to: its ground, and how to ask for something in
/// the next update traversal. Threads: any number at once.
class InstalledDatabase : public osg::Referenced {
public:
    /// `ellipsoid`: that of the database, unless its tiles turn out to stand in a map.
    explicit InstalledDatabase(const osg::EllipsoidModel* ellipsoid) : _ellipsoid(ellipsoid) {}

    /// The database's ellipsoid, or mapPlane() once a tile of a map has a bin.
    [[nodiscard]] const osg::EllipsoidModel* ellipsoid() const { return isMap() ? mapPlane() : _ellipsoid.get(); }
    /// A database is either a globe or a map (mapPlane()): the first call decides which. Returns: whether a tile on
    /// this ellipsoid may have a bin.
    [[nodiscard]] bool decideGround(const osg::EllipsoidModel& ellipsoid) {
        const Ground wanted = isMapPlane(ellipsoid) ? Ground::Map : Ground::Globe;
        Ground known = Ground::Open;
        return _ground.compare_exchange_strong(known, wanted, std::memory_order_relaxed) || known == wanted;
    }

    /// Whether bins were removed: tiles that still have them are not culled by them.
    [[nodiscard]] bool isRemoved() const { return _isRemoved.load(std::memory_order_relaxed); }

    /// Call when a tile was found that is not fitted to the present shape.
    void requestRefit() const {
        _isRefitWanted.store(true, std::memory_order_relaxed);
        requestUpdate();
    }

    /// Call when the children of a group with a family have changed. The next update rebuilds the family.
    void noteChanged(osg::Group& group) const {
        const std::lock_guard<std::mutex> lock(_changing);
        constexpr std::size_t kMostGroups = 4096;  // where no update traversal ever comes
        if (_changed.size() < kMostGroups) _changed.emplace_back(&group);
        requestUpdate();
    }

protected:
    using Groups = std::vector<osg::observer_ptr<osg::Group>>;

    ~InstalledDatabase() override = default;

    void noteRemoved() { _isRemoved.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool isMap() const { return _ground.load(std::memory_order_relaxed) == Ground::Map; }
    void requestUpdate() const { _isUpdateWanted.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool isUpdateWanted() const { return _isUpdateWanted.load(std::memory_order_relaxed); }
    /// For the update traversal: what was asked for is done now.
    void beginUpdate() { _isUpdateWanted.store(false, std::memory_order_relaxed); }
    [[nodiscard]] bool takeRefit() { return _isRefitWanted.exchange(false, std::memory_order_relaxed); }
    [[nodiscard]] Groups takeChanged() {
        const std::lock_guard<std::mutex> lock(_changing);
        return std::exchange(_changed, {});
    }

private:
    enum class Ground { Open, Globe, Map };

    const osg::ref_ptr<const osg::EllipsoidModel> _ellipsoid;
    std::atomic<Ground> _ground{Ground::Open};
    std::atomic<bool> _isRemoved{false};
    mutable std::atomic<bool> _isUpdateWanted{false};
    mutable std::atomic<bool> _isRefitWanted{false};
    mutable std::mutex _changing;  // guards the groups
    mutable Groups _changed;
};

}  // namespace osgAnalyticBin
