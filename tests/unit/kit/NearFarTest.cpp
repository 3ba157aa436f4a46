// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Near and far planes that OSG computes from what is kept. Oracle: the meshes' vertices in the picture, before the
// horizon: none may be cut off by a plane that was computed with bins, unless OSG without any culling cuts it as well;
// and what is culled must not widen the range.

#include "CameraGlobe.h"

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>

#include <cmath>
#include <support/Random.h>
#include <support/View.h>

namespace osgAnalyticBin {
namespace {

using osg::CullSettings;
using test::CameraGlobe;
using test::CullView;
using test::kEarthRadius;
using test::kOccluderDepth;

constexpr int kPosts = 9;
// What OSG's own arithmetic in floats may cut off, in metres.
constexpr double kFloatDepth = 4.0;

// A mesh on the bin with a random height at every post.
osg::ref_ptr<osg::Geode> makeMesh(const AnalyticBin& bin, test::Random& random) {
    const osg::EllipsoidModel wgs84;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    const auto& box = bin.bin();
    for (int y = 0; y < kPosts; ++y) {
        for (int x = 0; x < kPosts; ++x) {
            osg::Vec3d p;
            wgs84.convertLatLongHeightToXYZ(box.latitude().lower + box.latitude().width() * y / (kPosts - 1),
                                            box.longitude().lower + box.longitude().width() * x / (kPosts - 1),
                                            random.uniform(0.0, 8000.0), p.x(), p.y(), p.z());
            vertices->push_back(osg::Vec3(p));
            if (x + 1 == kPosts || y + 1 == kPosts) continue;
            const auto at = [&](int dx, int dy) { return static_cast<GLushort>((y + dy) * kPosts + x + dx); };
            for (const GLushort i : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)}) {
                triangles->push_back(i);
            }
        }
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices.get());
    geometry->addPrimitiveSet(triangles.get());
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry.get());
    geode->setCullingActive(false);  // as an installer leaves the nodes of a tile
    return geode;
}

struct MeshedGlobe {
    explicit MeshedGlobe(const CullOptions& options) : globe(options) {
        test::Random random(100);
        const std::vector<AnalyticBin> bins = test::startTiles();
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const osg::ref_ptr<osg::Geode> mesh = makeMesh(bins[i], random);
            const auto* array =
                static_cast<const osg::Vec3Array*>(mesh->getDrawable(0)->asGeometry()->getVertexArray());
            vertices.insert(vertices.end(), array->begin(), array->end());
            globe.tile(i).addChild(mesh);
        }
    }

    osg::Matrixd projectionFor(const CullView& view) {
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        const test::CullResult result = test::cull(globe.root(), view, *visitor);
        drawn = result.drawn.size();
        return result.projection;
    }

    CameraGlobe globe;
    std::vector<osg::Vec3> vertices;
    std::size_t drawn = 0;
};

CullOptions withoutCulling() {
    CullOptions options;
    options.method = Method::None;
    return options;
}

// Depths of the first and the last point in the clip space of a projection.
struct Range {
    double nearest, farthest;
};

Range rangeOf(const osg::Matrixd& projection) {
    const osg::Matrixd unproject = osg::Matrixd::inverse(projection);
    return {-(osg::Vec3d(0, 0, -1) * unproject).z(), -(osg::Vec3d(0, 0, 1) * unproject).z()};
}

bool isInSight(const osg::Vec3d& point, const CullView& view) {
    const osg::Matrixd toWorld = osg::Matrixd::inverse(view.modelView);
    const auto real = [](const osg::Vec3d& v) {
        return test::RealVector{test::Real{v.x()}, test::Real{v.y()}, test::Real{v.z()}};
    };
    if (view.projection(2, 3) == 0.0) {
        const osg::Vec3d towardEye = osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), toWorld);
        return test::halfLineMissesOccluder(test::earth(), kOccluderDepth, real(point), real(towardEye));
    }
    return test::segmentMissesOccluder(test::earth(), kOccluderDepth, real(point), real(osg::Vec3d() * toWorld));
}

class NearFar : public testing::TestWithParam<CullSettings::ComputeNearFarMode> {};

TEST_P(NearFar, CutNothingOffThatIsSeen) {
    for (const bool horizon : {false, true}) {
        MeshedGlobe bins(horizon ? test::horizonOptions() : CullOptions());
        MeshedGlobe all(withoutCulling());
        test::Random random(101);
        double tighter = 0.0;
        std::size_t checked = 0;
        constexpr int kViews = 60;
        for (int i = 0; i < kViews; ++i) {
            const glm::dvec3 from = random.direction() * (kEarthRadius + random.logUniform(3e4, 2e7));
            const glm::dvec3 to = random.direction() * kEarthRadius;
            const glm::dvec3 up = random.direction();
            CullView view = CullView::lookAt({from.x, from.y, from.z}, {to.x, to.y, to.z}, {up.x, up.y, up.z},
                                             random.uniform(10, 90));
            if (i % 4 == 3) {
                const double size = random.logUniform(1e5, 4e6);
                view.projection = osg::Matrixd::ortho(-size, size, -size, size, 1.0, 1e8);
            }
            view.computeNearFar = GetParam();
            const Range range = rangeOf(bins.projectionFor(view));
            const Range loose = rangeOf(all.projectionFor(view));
            EXPECT_LE(bins.drawn, all.drawn);
            if (bins.drawn == 0) continue;
            for (const osg::Vec3& vertex : bins.vertices) {
                const osg::Vec4d clip = osg::Vec4d(osg::Vec3d(vertex), 1.0) * view.modelView * view.projection;
                if (!(std::abs(clip.x()) < clip.w() && std::abs(clip.y()) < clip.w())) continue;
                const double depth = -(osg::Vec3d(vertex) * view.modelView).z();
                if (depth < 0.0 || (horizon && !isInSight(vertex, view))) continue;
                ++checked;
                const bool cutAnyway = depth < loose.nearest;  // OSG keeps near above a share of far
                EXPECT_TRUE(depth >= range.nearest - kFloatDepth || cutAnyway)
                    << "view " << i << ": " << depth << " before " << range.nearest;
                EXPECT_LE(depth, range.farthest + kFloatDepth) << "view " << i;
            }
            tighter += range.farthest < 0.9 * loose.farthest ? 1 : 0;
        }
        EXPECT_GT(checked, 5000u);
        EXPECT_GT(tighter, 0.1 * kViews);
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, NearFar,
                         testing::Values(CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES,
                                         CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES,
                                         CullSettings::COMPUTE_NEAR_USING_PRIMITIVES));

TEST(NearFarOff, DoNotComputeLeavesTheProjectionAlone) {
    MeshedGlobe bins{CullOptions()};
    const CullView view = CullView::lookAt({3e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
    EXPECT_EQ(bins.projectionFor(view), view.projection);
    EXPECT_EQ(bins.drawn, 128u);
}

}  // namespace
}  // namespace osgAnalyticBin
