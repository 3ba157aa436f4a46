// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osgGA/CameraManipulator>

namespace osgAnalyticBin::viewer {

/// Where a viewer starts: the whole globe with room around it; or, of a database that covers a part of the globe, that
/// part from the south and above.
struct HomeView {
    osg::Vec3d eye;
    osg::Vec3d center;
    osg::Vec3d up;
};

/// `projection`: of a perspective camera, for which the view is as near as it can be.
[[nodiscard]] HomeView homeViewOf(osg::Node& scene, const osg::Matrixd& projection);

}  // namespace osgAnalyticBin::viewer
