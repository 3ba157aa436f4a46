// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::viewer {

namespace {

// From where a sphere fills the picture in the direction in which that is narrower.
double distanceTo(double radius, const osg::Matrixd& projection) {
    const double tangent = 1.0 / std::max(projection(0, 0), projection(1, 1));
    return radius * std::sqrt(1.0 + 1.0 / (tangent * tangent));
}

}  // namespace

HomeView homeViewOf(osg::Node& scene, const osg::Matrixd& projection) {
    const osg::BoundingSphere bound = scene.getBound();
    const osg::Vec3d middle = bound.center();
    const double radius = bound.radius();
    const flight::Globe globe = flight::globeOf(scene);
    const osg::Vec3d globeCenter = globe.localToWorld.getTrans();
    const double globeRadius = globe.ellipsoid->getRadiusPolar();
    const bool isGeocentric = (middle - globeCenter).length() + radius > 0.5 * globeRadius;
    if (isGeocentric && radius > 0.9 * globeRadius) {
        // over Europe and Africa, where most globes are looked at first
        osg::Vec3d outward = osg::Matrixd::transform3x3(osg::Vec3d(0.85, 0.15, 0.5), globe.localToWorld);
        outward.normalize();
        constexpr double kRoom = 1.15;
        return {globeCenter + outward * distanceTo(kRoom * globe.ellipsoid->getRadiusEquator(), projection),
                globeCenter, osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, 1.0), globe.localToWorld)};
    }
    osg::Vec3d up = isGeocentric ? middle - globeCenter : osg::Vec3d(0.0, 0.0, 1.0);
    up.normalize();
    osg::Vec3d north = isGeocentric ? osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, 1.0), globe.localToWorld)
                                    : osg::Vec3d(0.0, 1.0, 0.0);
    north -= up * (north * up);
    if (north.normalize() < 1e-6) north.set(0.0, 1.0, 0.0);
    constexpr double kFlat = 0.8;  // seen aslant, less than its sphere
    return {middle + (up - north) * (std::sqrt(0.5) * distanceTo(kFlat * radius, projection)), middle, up};
}

}  // namespace osgAnalyticBin::viewer
