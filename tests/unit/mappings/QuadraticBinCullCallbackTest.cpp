// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The callback for any mapping, in a real cull traversal. Oracles: dense samples of each bin against the frustum's
// planes; the same scene under a transform; OSG's own small-feature test. The verdict against a single plane is tested
// in core/, what it shares with AnalyticBinCullCallback in that callback's test.

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/mappings/AutodiffMapping.h>
#include <osgAnalyticBin/mappings/QuadraticBinCullCallback.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <algorithm>
#include <kit/CullFixture.h>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

using test::CullView;

osg::Vec3d vec(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// The wall of a pipe: angle, radius, and height along the axis.
struct Pipe {
    glm::dvec3 origin{0.0}, x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};

    static Pipe along(const glm::dvec3& axis, const glm::dvec3& aside, const glm::dvec3& origin) {
        const glm::dvec3 y = glm::normalize(glm::cross(axis, aside));
        return {origin, glm::cross(y, axis), y, axis};
    }
    template <class T>
    core::Vec3<T> operator()(T angle, T radius, T height) const {
        using std::cos;
        using std::sin;
        const T a = radius * cos(angle), b = radius * sin(angle);
        return {a * x.x + b * y.x + height * z.x + origin.x, a * x.y + b * y.y + height * z.y + origin.y,
                a * x.z + b * y.z + height * z.z + origin.z};
    }
};

// A node that a callback culls, and whose visits are noted.
osg::ref_ptr<osg::Group> makePart(QuadraticBinCullCallback* callback, const std::string& name,
                                  std::set<std::string>& visited) {
    osg::ref_ptr<osg::Group> part = new osg::Group;
    callback->setNestedCallback(new test::VisitRecorder(name, visited));
    part->setCullCallback(callback);
    part->setCullingActive(false);
    return part;
}

// Quarters of pipes at random places within 100 m, and samples of each.
struct Pipes {
    explicit Pipes(test::Random& random) {
        for (int i = 0; i < 200; ++i) {
            const core::AutodiffMapping mapping(
                Pipe::along(random.direction(), random.direction(), random.direction() * random.uniform(0.0, 100.0)));
            const core::ParameterBox box{{random.uniform(0.0, 6.0), 0.5, 0.0}, {0.785, 0.02, 4.0}};
            root->addChild(
                makePart(new QuadraticBinCullCallback(core::QuadraticBin(mapping, box)), std::to_string(i), visited));
            points.emplace_back();
            for (int k = 0; k < 1000; ++k) {
                const glm::dvec3 unit(k % 10 / 4.5 - 1.0, k / 10 % 10 / 4.5 - 1.0, k / 100 / 4.5 - 1.0);
                points.back().push_back(vec(mapping.value(box.center + unit * box.halfSize)));
            }
        }
    }

    std::set<std::string> reached(osg::Node& scene, const CullView& view) {
        visited.clear();
        test::cull(scene, view);
        return visited;
    }

    osg::ref_ptr<osg::Group> root = new osg::Group;
    std::set<std::string> visited;
    std::vector<std::vector<osg::Vec3d>> points;
};

CullView randomPartView(test::Random& random) {
    return CullView::lookAt(vec(random.direction() * random.uniform(1.0, 200.0)),
                            vec(random.direction() * random.uniform(1.0, 50.0)), vec(random.direction()),
                            random.uniform(5.0, 80.0));
}

bool isVisible(const osg::Vec3d& point, const std::vector<osg::Plane>& planes) {
    return std::all_of(planes.begin(), planes.end(), [&](const osg::Plane& p) { return p.distance(point) >= 0.0; });
}

TEST(QuadraticBinCullCallback, NeverCullsAVisibleSampleAndCullsMostOfTheRest) {
    test::Random random(400);
    Pipes pipes(random);
    std::size_t visible = 0, kept = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const CullView view = randomPartView(random);
        const std::vector<osg::Plane> planes = view.sidePlanes();
        const std::set<std::string> reached = pipes.reached(*pipes.root, view);
        kept += reached.size();
        for (std::size_t i = 0; i < pipes.points.size(); ++i) {
            const auto& points = pipes.points[i];
            const bool seen = std::any_of(points.begin(), points.end(),
                                          [&](const osg::Vec3d& point) { return isVisible(point, planes); });
            visible += seen;
            ASSERT_TRUE(!seen || reached.count(std::to_string(i)) == 1) << "part " << i << " in view " << trial;
        }
    }
    // Plane by plane, a part across an edge of the frustum is kept.
    EXPECT_LE(static_cast<double>(kept), 1.15 * static_cast<double>(visible));
}

TEST(QuadraticBinCullCallback, FollowsTransforms) {
    test::Random random(401);
    Pipes pipes(random);
    const osg::Matrixd moved = osg::Matrixd::rotate(1.0, osg::Vec3d(1.0, 2.0, 3.0)) *
                               osg::Matrixd::scale(3.0, 3.0, 3.0) * osg::Matrixd::translate(1000.0, -2000.0, 500.0);
    const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(moved);
    transform->addChild(pipes.root);
    for (int trial = 0; trial < 50; ++trial) {
        const CullView view = randomPartView(random);
        CullView movedView = view;
        movedView.modelView = osg::Matrixd::inverse(moved) * view.modelView;
        EXPECT_EQ(pipes.reached(*transform, movedView), pipes.reached(*pipes.root, view));
    }
}

TEST(QuadraticBinCullCallback, WithoutABinNothingIsCulled) {
    std::set<std::string> visited;
    const auto node = makePart(new QuadraticBinCullCallback, "node", visited);
    test::cull(*node, CullView::lookAt({0, 0, 10}, {0, 0, 20}, {0, 1, 0}, 10.0));
    EXPECT_EQ(visited.size(), 1u);
}

TEST(QuadraticBinCullCallback, KeepsSmallFeatureCulling) {
    const core::AutodiffMapping mapping{Pipe()};
    const core::QuadraticBin bin(mapping, {{0.0, 0.001, 0.0}, {0.1, 0.0001, 0.001}});
    CullView view = CullView::lookAt({1000, 0, 0}, {0, 0, 0}, {0, 0, 1}, 60.0);
    for (const bool hasSphere : {true, false}) {
        std::set<std::string> visited;
        const osg::BoundingSphere sphere = hasSphere ? osg::BoundingSphere({0, 0, 0}, 0.002f) : osg::BoundingSphere();
        const auto node = makePart(new QuadraticBinCullCallback(bin, sphere), "node", visited);
        view.cullingMode = osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING | osg::CullSettings::SMALL_FEATURE_CULLING;
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        test::cull(*node, view, *visitor);
        EXPECT_EQ(visited.empty(), hasSphere);
        ASSERT_NE(BinStatistics::find(*visitor), nullptr);
        EXPECT_EQ(BinStatistics::find(*visitor)->getCounts().tested, 1u);
    }
}

TEST(QuadraticBinCullCallback, ACopyCullsTheSame) {
    const core::AutodiffMapping mapping{Pipe()};
    const core::QuadraticBin bin(mapping, {{0.0, 1.0, 0.0}, {0.1, 0.1, 1.0}});
    const osg::ref_ptr<QuadraticBinCullCallback> original = new QuadraticBinCullCallback(bin);
    const osg::ref_ptr<QuadraticBinCullCallback> copy = new QuadraticBinCullCallback(*original);
    ASSERT_TRUE(copy->getBin().has_value());
    EXPECT_EQ(copy->getBin()->remainder(), bin.remainder());
}

}  // namespace
}  // namespace osgAnalyticBin
