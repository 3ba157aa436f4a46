// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Camera>
#include <osg/Matrixd>
#include <osg/Node>
#include <osgViewer/View>
#include <osgViewer/ViewerBase>

#include <cstddef>
#include <vector>

namespace osgAnalyticBin::test {

using Threading = osgViewer::ViewerBase::ThreadingModel;

/// osgViewer's own, those that it calls automatic left out.
inline constexpr Threading kThreadingModels[] = {Threading::SingleThreaded, Threading::CullDrawThreadPerContext,
                                                 Threading::DrawThreadPerContext,
                                                 Threading::CullThreadPerCameraDrawThreadPerContext};

[[nodiscard]] const char* nameOf(Threading threading);

/// Whose a rig's cameras are.
enum class Layout {
    Views,  ///< each of a view of one CompositeViewer, with a context of its own
    Slaves  ///< all of one Viewer, side by side in one context
};

/// A whole osgViewer that draws a scene with its DatabasePager into pbuffers of 64 x 64 pixels for each camera.
/// Needs a display: see canDraw().
class ViewerRig {
public:
    ViewerRig(osg::Node& scene, Threading threading, Layout layout, int cameras);
    ~ViewerRig();
    ViewerRig(const ViewerRig&) = delete;
    ViewerRig& operator=(const ViewerRig&) = delete;

    /// Whether a graphics context can be made here.
    [[nodiscard]] static bool canDraw();

    [[nodiscard]] osgViewer::ViewerBase& viewer() { return *_viewer; }

    /// The first view, or the only one.
    [[nodiscard]] osgViewer::View& view() { return *_views.front(); }

    /// Those that draw.
    [[nodiscard]] const std::vector<osg::Camera*>& cameras() const { return _cameras; }

    /// Number of PagedLODs above which the pager drops what is out of view.
    void setMostPagedLods(unsigned int count);

    /// Where the first camera looks from; the others stand there too, and look elsewhere.
    void look(const osg::Matrixd& view);

    /// One frame at this simulated time (seconds), first half: events and updates, as osgViewer runs them. What an
    /// application changes between frames it changes after this.
    void update(double time);

    /// Second half: culling and drawing.
    void render();

private:
    std::vector<osgViewer::View*> _views;  // the viewer keeps them
    osg::ref_ptr<osgViewer::ViewerBase> _viewer;
    std::vector<osg::Camera*> _cameras;
};

/// A view from a place on WGS 84 (degrees, metres), turned by `heading` and `pitch` (degrees; pitch 0 looks straight
/// down, 90 to the horizon).
[[nodiscard]] osg::Matrixd viewFrom(double latitude, double longitude, double altitude, double heading, double pitch);

/// Number of PagedLODs below a node that more than their first child is loaded of.
[[nodiscard]] std::size_t pagedIn(osg::Node& scene);

}  // namespace osgAnalyticBin::test
