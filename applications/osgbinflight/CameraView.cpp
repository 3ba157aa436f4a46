// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraView.h"

#include "Nodes.h"

#include <osgAnalyticBin/TileFinder.h>

#include <osg/Transform>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

#include <cmath>
#include <vector>

namespace osgAnalyticBin::flight {

namespace {

// Sine of the angle to the vertical below which the horizon has no "up": 0.006 degrees.
constexpr double kStraight = 1e-4;

osg::Vec3d northAt(const core::Geodetic& p, const Globe& globe) {
    if (isMapPlane(*globe.ellipsoid)) return {0.0, 1.0, 0.0};
    return {-std::sin(p.latitude) * std::cos(p.longitude), -std::sin(p.latitude) * std::sin(p.longitude),
            std::cos(p.latitude)};
}

// Where the first tile stands in a map, if it does.
std::optional<Globe> mapOf(osg::Node& scene) {
    const std::vector<FoundTile> tiles = findTiles(scene);
    const bool isMap = !tiles.empty() && tiles.front().frame.ellipsoid && isMapPlane(*tiles.front().frame.ellipsoid);
    if (!isMap) return std::nullopt;
    const FoundTile& tile = tiles.front();
    osg::NodePath path =
        tile.node->getParentalNodePaths(scene.getNumParents() > 0 ? scene.getParent(0) : nullptr).front();
    path.pop_back();
    return Globe{mapPlane(), osg::Matrixd::inverse(tile.frame.localToEcef) * osg::computeLocalToWorld(path)};
}

osg::Vec3d directionToWorld(const osg::Vec3d& direction, const Globe& globe) {
    osg::Vec3d world = osg::Matrixd::transform3x3(direction, globe.localToWorld);
    world.normalize();
    return world;
}

}  // namespace

osg::Vec3d Globe::toWorld(const core::Geodetic& position) const {
    return toOsg(radii().toEcef(position)) * localToWorld;
}

core::Geodetic Globe::geodetic(const osg::Vec3d& world) const {
    return radii().toGeodetic(toGlm(world * osg::Matrixd::inverse(localToWorld)));
}

osg::Vec3d Globe::vertical(const core::Geodetic& position) const {
    return directionToWorld(toOsg(radii().up(position.latitude, position.longitude)), *this);
}

std::optional<osg::Vec3d> Globe::intersection(const osg::Vec3d& eye, const osg::Vec3d& direction) const {
    const osg::Matrixd toGlobe = osg::Matrixd::inverse(localToWorld);
    const double a = ellipsoid->getRadiusEquator();
    const double b = ellipsoid->getRadiusPolar();
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

std::optional<osg::Vec3d> firstHit(osg::Node& scene, const osg::Vec3d& from, const osg::Vec3d& to) {
    const osg::ref_ptr<osgUtil::LineSegmentIntersector> line = new osgUtil::LineSegmentIntersector(from, to);
    osgUtil::IntersectionVisitor visitor(line);
    scene.accept(visitor);
    if (!line->containsIntersections()) return std::nullopt;
    return line->getFirstIntersection().getWorldIntersectPoint();
}

std::optional<Globe> findGlobe(osg::Node& scene) {
    std::optional<Globe> found;
    support::visitNodes(scene, [&](osg::Node& node, osg::NodeVisitor& visitor) {
        const auto* const globe = dynamic_cast<osg::CoordinateSystemNode*>(&node);
        if (!found && globe && globe->getEllipsoidModel() && hasValidRadii(*globe->getEllipsoidModel()))
            found = Globe{globe->getEllipsoidModel(), osg::computeLocalToWorld(visitor.getNodePath())};
        return !found;
    });
    return found;
}

Globe globeOf(osg::Node& scene) {
    if (const auto map = mapOf(scene)) return *map;
    if (const auto globe = findGlobe(scene)) return *globe;
    return defaultGlobe();
}

osg::Vec3d upWithoutRoll(const Globe& globe, const core::Geodetic& eye, const osg::Vec3d& sight) {
    const osg::Vec3d vertical = globe.vertical(eye);
    const bool isStraight = (sight ^ vertical).length() < kStraight;
    return isStraight ? directionToWorld(northAt(eye, globe), globe) : vertical;
}

osg::Matrixd viewMatrixOf(const CameraPose& pose, const Globe& globe) {
    const osg::Vec3d eye = globe.toWorld(pose.eye);
    const osg::Vec3d look = globe.toWorld(pose.look);
    osg::Vec3d direction = look - eye;
    direction.normalize();
    const osg::Vec3d up = upWithoutRoll(globe, pose.eye, direction);
    osg::Matrixd view = osg::Matrixd::lookAt(eye, look, osg::Quat(pose.roll, direction) * up);
    view.postMultTranslate(osg::Vec3d(-pose.eyeRight, 0.0, 0.0));
    return view;
}

osg::Matrixd projectionMatrixOf(const CameraPose& pose, const Globe& globe, double aspect) {
    constexpr double kNear = 1.0, kFar = 1e8;  // until OSG computes them
    const double nearPlane = pose.hasPlanes() ? pose.nearPlane : kNear,
                 farPlane = pose.hasPlanes() ? pose.farPlane : kFar;
    const double lookDistance = (globe.toWorld(pose.look) - globe.toWorld(pose.eye)).length();
    const double top = nearPlane * std::tan(pose.verticalFov / 2.0);
    const double right = top * aspect;
    const double aside = pose.eyeRight * nearPlane / lookDistance;
    return osg::Matrixd::frustum(-right - aside, right - aside, -top, top, nearPlane, farPlane);
}

void placeCamera(osg::Camera& camera, const CameraPose& pose, const Globe& globe) {
    camera.setViewMatrix(viewMatrixOf(pose, globe));
    camera.setProjectionMatrix(projectionMatrixOf(pose, globe, camera.getViewport()->aspectRatio()));
    camera.setComputeNearFarMode(pose.hasPlanes() ? osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR
                                                  : osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
}

}  // namespace osgAnalyticBin::flight
