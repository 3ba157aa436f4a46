// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include "Nodes.h"

#include <osg/Depth>
#include <osg/LineWidth>
#include <osg/MatrixTransform>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace osgAnalyticBin::viewer {

namespace {

// From where a sphere fills the picture in the direction in which that is narrower.
double distanceTo(double radius, const osg::Matrixd& projection) {
    const double tangent = 1.0 / std::max(projection(0, 0), projection(1, 1));
    return radius * std::sqrt(1.0 + 1.0 / (tangent * tangent));
}

constexpr int kStepsOfSide = 64;
// of no verdict
const osg::Vec4 kSideColour(1.0F, 0.5F, 1.0F, 0.13F);
const osg::Vec4 kEdgeColour(1.0F, 0.5F, 1.0F, 1.0F);

// Points all round the frustum's border, where its rays end.
std::vector<osg::Vec3d> borderOf(const CullingView& view, const std::optional<flight::Globe>& globe, double reach,
                                 const osg::Vec3d& eye) {
    const osg::Matrixd toWorld = osg::Matrixd::inverse(view.view * view.projection);
    constexpr std::array<std::array<double, 2>, 5> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
    std::vector<osg::Vec3d> border;
    for (std::size_t side = 0; side + 1 < kCorners.size(); ++side) {
        for (int step = 0; step < kStepsOfSide; ++step) {
            const double t = double(step) / kStepsOfSide;
            const double x = kCorners[side][0] * (1.0 - t) + kCorners[side + 1][0] * t;
            const double y = kCorners[side][1] * (1.0 - t) + kCorners[side + 1][1] * t;
            osg::Vec3d direction = osg::Vec3d(x, y, 0.0) * toWorld - eye;
            direction.normalize();
            const auto ground = globe ? globe->intersection(eye, direction) : std::nullopt;
            border.push_back(ground ? *ground : eye + direction * reach);
        }
    }
    return border;
}

// The distance to the tangent point on the globe, and a little more.
double reachOver(const flight::Globe& globe, const osg::Vec3d& eye) {
    const double radius = globe.ellipsoid->getRadiusEquator();
    const double height = std::max(globe.geodetic(eye).altitude, 0.0);
    return 1.15 * std::sqrt(height * (2.0 * radius + height));
}

}  // namespace

void computeBounds(osg::Node& node) {
    support::forAllNodes(node, [](osg::Node& each) { (void)each.getBound(); });
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

osg::ref_ptr<osg::Node> makeFrustum(const CullingView& view, const std::optional<flight::Globe>& globe, double reach) {
    const osg::Vec3d eye = osg::Vec3d() * osg::Matrixd::inverse(view.view);
    const std::vector<osg::Vec3d> border = borderOf(view, globe, globe ? reachOver(*globe, eye) : reach, eye);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    vertices->push_back(osg::Vec3());
    for (const osg::Vec3d& point : border) vertices->push_back(osg::Vec3(point - eye));
    std::vector<unsigned int> sides, edges;
    const auto count = static_cast<unsigned int>(border.size());
    for (unsigned int i = 0; i < count; ++i) {
        const unsigned int next = (i + 1) % count;
        sides.insert(sides.end(), {0, i + 1, next + 1});
        edges.insert(edges.end(), {i + 1, next + 1});
        if (i % kStepsOfSide == 0) edges.insert(edges.end(), {0, i + 1});
    }
    return placed(osg::Matrixd::translate(eye), {makeIndexed(*vertices, GL_TRIANGLES, sides, kSideColour, 15),
                                                 makeIndexed(*vertices, GL_LINES, edges, kEdgeColour, 21)});
}

}  // namespace osgAnalyticBin::viewer
