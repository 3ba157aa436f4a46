// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullFixture.h"

#include <osg/FrameStamp>
#include <osg/Node>
#include <osgDB/DatabasePager>
#include <osgUtil/UpdateVisitor>

namespace osgAnalyticBin::test {

/// A flight over a paged scene without a window: OSG's own DatabasePager and cull traversals, in the order in which
/// osgViewer runs them, single threaded but for the pager. Time is simulated: a frame takes a sixtieth of a second.
class PagedFlight {
public:
    /// `targetMaximum`: number of PagedLODs above which the pager drops what is out of view.
    explicit PagedFlight(osg::Node& scene, unsigned int targetMaximum = 300);
    ~PagedFlight();
    PagedFlight(const PagedFlight&) = delete;
    PagedFlight& operator=(const PagedFlight&) = delete;

    void frame(const CullView& view);
    void frames(const CullView& view, int count);

    /// Frames until the condition holds; it is asked after each. Returns: false when it does not within a minute.
    bool framesUntil(const CullView& view, const std::function<bool()>& condition);

    /// Frames until everything in view is there.
    bool load(const CullView& view);

    /// Names of files that the last frame asked for.
    [[nodiscard]] const std::set<std::string>& wanted() const;

    /// What the last frame drew: center, in the eye's frame, and radius of each drawable.
    [[nodiscard]] const std::multiset<std::string>& drawn() const;

    /// Simulated seconds.
    [[nodiscard]] double time() const { return _stamp->getReferenceTime(); }

private:
    class Requests;
    class Recorder;

    osg::Node& _scene;
    osg::ref_ptr<osgDB::DatabasePager> _pager;
    osg::ref_ptr<Requests> _requests;
    osg::ref_ptr<Recorder> _recorder;
    osg::ref_ptr<osgUtil::UpdateVisitor> _update = new osgUtil::UpdateVisitor;
    osg::ref_ptr<osg::FrameStamp> _stamp = new osg::FrameStamp;
};

/// From 300 km above the equator, down at 45 degrees to the east (1) or west (-1).
[[nodiscard]] CullView lookDown(double side);

/// Number of PagedLODs below the node that have a paged child at present.
[[nodiscard]] std::size_t loadedTiles(osg::Node& scene);

}  // namespace osgAnalyticBin::test
