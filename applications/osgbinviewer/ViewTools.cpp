// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include <cmath>

namespace osgAnalyticBin::viewer {

namespace {

class BoundsComputer : public osg::NodeVisitor {
public:
    BoundsComputer() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }

    void apply(osg::Node& node) override {
        traverse(node);
        (void)node.getBound();
    }
};

}  // namespace

void computeBounds(osg::Node& node) {
    BoundsComputer computer;
    node.accept(computer);
}

std::optional<osg::Vec3d> intersection(const flight::Globe& globe, const osg::Vec3d& eye, const osg::Vec3d& direction) {
    const osg::Matrixd toGlobe = osg::Matrixd::inverse(globe.localToWorld);
    const double a = globe.ellipsoid->getRadiusEquator();
    const double b = globe.ellipsoid->getRadiusPolar();
    const auto toUnit = [&](const osg::Vec3d& v) { return osg::Vec3d(v.x() / a, v.y() / a, v.z() / b); };
    const osg::Vec3d start = toUnit(eye * toGlobe);
    const osg::Vec3d along = toUnit(osg::Matrixd::transform3x3(direction, toGlobe));
    const double half = start * along;
    const double discriminant = half * half - along.length2() * (start.length2() - 1.0);
    if (!(discriminant >= 0.0)) return std::nullopt;
    const double distance = (-half - std::sqrt(discriminant)) / along.length2();
    if (!(distance > 0.0)) return std::nullopt;
    return eye + direction * distance;
}

osg::Vec3d vertical(const flight::Globe& globe, const osg::Vec3d& position) {
    const osg::Vec3d ecef = position * osg::Matrixd::inverse(globe.localToWorld);
    osg::Vec3d up = osg::Matrixd::transform3x3(globe.ellipsoid->computeLocalUpVector(ecef.x(), ecef.y(), ecef.z()),
                                               globe.localToWorld);
    up.normalize();
    return up;
}

core::Geodetic geodetic(const flight::Globe& globe, const osg::Vec3d& position) {
    const osg::Vec3d ecef = position * osg::Matrixd::inverse(globe.localToWorld);
    core::Geodetic found{};
    globe.ellipsoid->convertXYZToLatLongHeight(ecef.x(), ecef.y(), ecef.z(), found.latitude, found.longitude,
                                               found.altitude);
    return found;
}

}  // namespace osgAnalyticBin::viewer
