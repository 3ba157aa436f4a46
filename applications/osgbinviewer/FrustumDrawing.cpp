// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexedGeometry.h"
#include "ViewTools.h"

#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LineWidth>
#include <osg/MatrixTransform>

#include <array>
#include <cmath>
#include <vector>

namespace osgAnalyticBin::viewer {

namespace {

constexpr int kStepsOfSide = 64;
const osg::Vec4 kSideColour(0.2F, 0.9F, 1.0F, 0.13F);
const osg::Vec4 kEdgeColour(0.3F, 1.0F, 1.0F, 1.0F);

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
            const auto ground = globe ? intersection(*globe, eye, direction) : std::nullopt;
            border.push_back(ground ? *ground : eye + direction * reach);
        }
    }
    return border;
}

// The distance to the tangent point on the globe, and a little more.
double reachOver(const flight::Globe& globe, const osg::Vec3d& eye) {
    const double radius = globe.ellipsoid->getRadiusEquator();
    const double height = std::max(geodetic(globe, eye).altitude, 0.0);
    return 1.15 * std::sqrt(height * (2.0 * radius + height));
}

osg::ref_ptr<osg::Geometry> makePart(osg::Vec3Array& vertices, GLenum primitives, const osg::Vec4& colour,
                                     const std::vector<unsigned int>& indices) {
    osg::ref_ptr<osg::Geometry> geometry = makeIndexed(vertices, primitives, indices, colour);
    osg::StateSet& state = *geometry->getOrCreateStateSet();
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    state.setAttributeAndModes(new osg::CullFace, osg::StateAttribute::OFF);
    state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    state.setAttributeAndModes(new osg::LineWidth(2.0F));
    state.setRenderBinDetails(primitives == GL_LINES ? 21 : 15, "RenderBin");
    return geometry;
}

}  // namespace

osg::ref_ptr<osg::Node> makeFrustum(const CullingView& view, const std::optional<flight::Globe>& globe, double reach) {
    const osg::Vec3d eye = osg::Vec3d() * osg::Matrixd::inverse(view.view);
    const std::vector<osg::Vec3d> border = borderOf(view, globe, globe ? reachOver(*globe, eye) : reach, eye);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    vertices->push_back(osg::Vec3());
    for (const osg::Vec3d& point : border) vertices->push_back(osg::Vec3(point - eye));
    std::vector<unsigned int> sides;
    std::vector<unsigned int> edges;
    const auto count = static_cast<unsigned int>(border.size());
    for (unsigned int i = 0; i < count; ++i) {
        const unsigned int next = (i + 1) % count;
        sides.insert(sides.end(), {0, i + 1, next + 1});
        edges.insert(edges.end(), {i + 1, next + 1});
        if (i % kStepsOfSide == 0) edges.insert(edges.end(), {0, i + 1});
    }
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(makePart(*vertices, GL_TRIANGLES, kSideColour, sides));
    geode->addDrawable(makePart(*vertices, GL_LINES, kEdgeColour, edges));
    osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform(osg::Matrixd::translate(eye));
    placed->addChild(geode);
    return placed;
}

}  // namespace osgAnalyticBin::viewer
