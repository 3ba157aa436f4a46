// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace osgAnalyticBin::viewer {

namespace {

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
    return placed(osg::Matrixd::translate(eye), {makeIndexed(*vertices, GL_TRIANGLES, sides, kSideColour, 15),
                                                 makeIndexed(*vertices, GL_LINES, edges, kEdgeColour, 21)});
}

}  // namespace osgAnalyticBin::viewer
