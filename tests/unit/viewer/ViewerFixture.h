// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <gtest/gtest.h>
#include <osg/Camera>
#include <osg/Drawable>
#include <osg/FrameStamp>
#include <osg/GraphicsContext>
#include <osg/Image>
#include <osg/Matrixd>
#include <osg/Node>
#include <osgViewer/Viewer>

#include <map>
#include <set>
#include <string>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin::test {

/// Pixels along an edge of makeSurface().
constexpr int kSurfaceSize = 128;

/// A pbuffer. Returns: nullptr where no graphics context can be made.
[[nodiscard]] osg::ref_ptr<osg::GraphicsContext> makeSurface();

/// A whole viewer that draws a synthetic globe into a pbuffer. Needs a display (Xvfb will do); skipped where no
/// graphics context can be made.
class DrawnViewer : public ::testing::Test {
protected:
    void SetUp() override;

    /// The globe with bins.
    [[nodiscard]] osg::ref_ptr<osg::Node> read(Method method) const;

    /// Lets a viewer draw a scene on a surface.
    static void setUp(osgViewer::Viewer& viewer, osg::GraphicsContext& surface, osg::Node& database);

    /// 300 km above the equator, looking down at 45 degrees to the east (1) or west (-1).
    static void look(osgViewer::Viewer& viewer, double side);

    static void drawUntilIdle(osgViewer::Viewer& viewer);

    void press(int key);

    [[nodiscard]] static TileCounts counts(osgViewer::Viewer& viewer);

    /// Of the next frame.
    [[nodiscard]] static osg::ref_ptr<osg::Image> picture(osgViewer::Viewer& viewer);

    /// What can be read below a node, in the order of its drawables.
    [[nodiscard]] static std::vector<std::string> texts(osg::Node& node);

    TemporaryFolder _folder;
    std::string _file;
    osgViewer::Viewer _viewer;
};

/// A camera without a window over the root tiles of a synthetic globe.
class ViewerScene {
public:
    explicit ViewerScene(const CullOptions& options = {});

    /// Looks from a place straight down or, with `pitchDeg`, so much above that towards north.
    void lookFrom(double latitudeDeg, double longitudeDeg, double altitude, double pitchDeg, double fovDeg);

    /// What one cull traversal of the camera leaves to draw, and where in eye space.
    [[nodiscard]] std::map<const osg::Drawable*, osg::Matrixd> cull();

    [[nodiscard]] osg::Camera& camera() { return *_camera; }
    [[nodiscard]] osg::Node& database() { return *_database; }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return *_stamp; }

    /// Near and far planes that the last cull() computed, metres.
    double nearPlane = 0.0;
    double farPlane = 0.0;

private:
    TemporaryFolder _folder;
    osg::ref_ptr<osg::Node> _database;
    osg::ref_ptr<osg::Camera> _camera;
    osg::ref_ptr<osg::FrameStamp> _stamp;
};

}  // namespace osgAnalyticBin::test
