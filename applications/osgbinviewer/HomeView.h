// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osgGA/CameraManipulator>

namespace osgAnalyticBin::viewer {

/// Where a viewer starts: the whole globe, seen over the database's middle; or, of a database that covers a part of the
/// globe, that part from the south and above.
struct HomeView {
    osg::Vec3d eye;
    osg::Vec3d center;
    osg::Vec3d up;
};

[[nodiscard]] HomeView homeViewOf(osg::Node& scene);

}  // namespace osgAnalyticBin::viewer
