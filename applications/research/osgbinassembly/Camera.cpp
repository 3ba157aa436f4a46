// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Camera.h"

#include <osg/Polytope>

#include <random>

namespace osgAnalyticBin::assembly {

std::vector<osg::Plane> Camera::sidePlanes() const {
    osg::Polytope frustum;
    frustum.setToUnitFrustum(false, false);
    frustum.transformProvidingInverse(modelView * projection);
    return frustum.getPlaneList();
}

std::vector<Camera> randomCameras(std::size_t count, double halfExtent, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto between = [&](double lower, double upper) {
        return lower + (upper - lower) * (static_cast<double>(random()) / static_cast<double>(std::mt19937::max()));
    };
    std::vector<Camera> cameras;
    while (cameras.size() < count) {
        const osg::Vec3d eye(between(-halfExtent, halfExtent), between(-halfExtent, halfExtent), between(1.0, 60.0));
        const osg::Vec3d target(between(-halfExtent, halfExtent), between(-halfExtent, halfExtent), between(0.0, 12.0));
        const osg::Vec3d ahead = target - eye;
        // Not straight down, where "up" would have no meaning.
        if (osg::Vec2d(ahead.x(), ahead.y()).length() < 1.0) continue;
        cameras.push_back({osg::Matrixd::lookAt(eye, target, osg::Vec3d(0.0, 0.0, 1.0)),
                           osg::Matrixd::perspective(between(10.0, 50.0), 16.0 / 9.0, 0.1, 1e4)});
    }
    return cameras;
}

}  // namespace osgAnalyticBin::assembly
