// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include <osg/Depth>
#include <osg/LineWidth>
#include <osg/MatrixTransform>

#include <algorithm>
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

// From where a sphere fills the picture in the direction in which that is narrower.
double distanceTo(double radius, const osg::Matrixd& projection) {
    const double tangent = 1.0 / std::max(projection(0, 0), projection(1, 1));
    return radius * std::sqrt(1.0 + 1.0 / (tangent * tangent));
}

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

HomeView homeViewOf(osg::Node& scene, const osg::Matrixd& projection) {
    const osg::BoundingSphere bound = scene.getBound();
    const osg::Vec3d middle = bound.center();
    const double radius = bound.radius();
    const flight::Globe globe = flight::globeOf(scene);
    const osg::Vec3d globeCenter = globe.localToWorld.getTrans();
    const double globeRadius = globe.ellipsoid->getRadiusPolar();
    const bool isGeocentric = (middle - globeCenter).length() + radius > 0.5 * globeRadius;
    if (isGeocentric && radius > 0.9 * globeRadius) {
        // over Europe and Africa: most people look there first
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

osg::ref_ptr<osg::Geometry> makeIndexed(osg::Vec3Array& vertices, GLenum primitives,
                                        const std::vector<unsigned int>& indices, const osg::Vec4& colour,
                                        int renderBin) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(&vertices);
    const osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
    (*colours)[0] = colour;
    geometry->setColorArray(colours);
    geometry->addPrimitiveSet(
        new osg::DrawElementsUInt(primitives, static_cast<unsigned int>(indices.size()), indices.data()));
    osg::StateSet& state = *geometry->getOrCreateStateSet();
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    state.setAttributeAndModes(new osg::LineWidth(1.5F));
    state.setRenderBinDetails(renderBin, "RenderBin");
    return geometry;
}

osg::ref_ptr<osg::Node> placed(const osg::Matrixd& toWorld, std::initializer_list<osg::ref_ptr<osg::Geometry>> parts) {
    osg::ref_ptr<osg::MatrixTransform> node = new osg::MatrixTransform(toWorld);
    for (const auto& part : parts) node->addChild(part);
    return node;
}

}  // namespace osgAnalyticBin::viewer
