// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osg/Camera>
#include <osg/Drawable>
#include <osg/FrameStamp>
#include <osg/Matrixd>
#include <osg/Node>

#include <map>
#include <set>
#include <string>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

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
