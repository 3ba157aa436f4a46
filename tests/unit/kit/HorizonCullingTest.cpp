// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The horizon and the frustum's edges in a real cull traversal: what they are used for. That they hide nothing that is
// in the picture: ProjectionTest.cpp. The tests of a bin themselves are tested in core/.

#include "CameraGlobe.h"
#include "CullFixture.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

using core::GeodeticBin;
using test::CullView;
using test::horizonOptions;
using test::kEarthRadius;
using test::kOccluderDepth;
using test::osgVector;

struct CountedGlobe {
    explicit CountedGlobe(const CullOptions& options) : bins(test::startTiles()) {
        for (std::size_t i = 0; i < bins.size(); ++i) {
            root->addChild(test::makeTile(std::to_string(i), bins[i], visited, options));
        }
    }

    std::set<std::string> reached(osg::Node& scene, const CullView& view) {
        visited.clear();
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        test::cull(scene, view, *visitor);
        const BinStatistics* statistics = BinStatistics::find(*visitor);
        counts = statistics ? statistics->getCounts() : BinCounts();
        return visited;
    }

    osg::ref_ptr<osg::Group> root = new osg::Group;
    std::vector<AnalyticBin> bins;
    std::set<std::string> visited;
    BinCounts counts;
};

CullView randomView(test::Random& random, osg::Vec3d& eye) {
    eye = test::randomEyeAbove(random, 1e3);
    const osg::Vec3d target = osgVector(random.direction()) * kEarthRadius;
    const osg::Vec3d up = osgVector(random.direction());
    return CullView::lookAt(eye, target, up, random.uniform(5.0, 90.0));
}

TEST(HorizonCulling, HoldsForAGlobeThatATransformMovesTurnsAndScales) {
    CountedGlobe globe(horizonOptions());
    const osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    mover->setCullingActive(false);
    mover->addChild(globe.root);
    test::Random random(31);
    for (int i = 0; i < 60; ++i) {
        osg::Vec3d eye;
        CullView view = randomView(random, eye);
        const std::set<std::string> atRest = globe.reached(*globe.root, view);
        // A line of sight stays a line under any affine map: unequal scales do no harm.
        const osg::Vec3d scale = i % 2 ? osg::Vec3d(0.5, 0.5, 0.5) : osg::Vec3d(0.5, 2.0, 1.25);
        const osg::Matrixd motion = osg::Matrixd::rotate(random.uniform(0, 6), 0.3, 0.5, -0.8) *
                                    osg::Matrixd::scale(scale) * osg::Matrixd::translate(1e7, -3e6, 5e5);
        mover->setMatrix(motion);
        view.modelView = osg::Matrixd::inverse(motion) * view.modelView;
        EXPECT_EQ(globe.reached(*mover, view), atRest) << "view " << i;
    }
}

TEST(HorizonCulling, IsOffWhereItIsNotAskedFor) {
    const CullView view = CullView::lookAt({3e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
    CountedGlobe undeclared({});
    undeclared.reached(*undeclared.root, view);
    EXPECT_EQ(undeclared.counts.hidden, 0u);
}

TEST(HorizonCulling, HidesNothingThatIsDrawnInFrontOfAll) {
    const CullView view = CullView::lookAt({3e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
    CountedGlobe globe(horizonOptions());
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->setCullingActive(false);
    scene->addChild(globe.root);
    globe.reached(*scene, view);
    EXPECT_GT(globe.counts.hidden, 0u);
    scene->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    globe.reached(*scene, view);
    EXPECT_EQ(globe.counts.hidden, 0u);
}

TEST(HorizonCulling, ADatabaseDeclaresItAndTheUserHasTheLastWord) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    setStoredBin(*tile, AnalyticBin(GeodeticBin::fromDegrees({0, 1}, {0, 1}, {0, 100})));
    root->addChild(tile);
    root->setUpdateCallback(new InstallBinsCallback(horizonOptions()));
    const auto installed = [&](const CullOptions& options) {
        installBins(*root, options);
        return dynamic_cast<AnalyticBinCullCallback&>(*tile->getCullCallback()).getCullOptions();
    };
    EXPECT_EQ(installed({}).horizonUse, HorizonUse::Given);
    EXPECT_EQ(installed({}).horizon, -kOccluderDepth);
    CullOptions off;
    off.horizonUse = HorizonUse::Off;
    EXPECT_EQ(installed(off).horizonUse, HorizonUse::Off);
    CullOptions other = horizonOptions();
    other.horizon = -9.0;
    EXPECT_EQ(installed(other).horizon, -9.0);
}

TEST(EdgeCulling, CullsTilesBeyondTheEdgesOfANarrowFrustumAndNoneInSight) {
    CullOptions off;
    off.edges = false;
    CountedGlobe with({});
    CountedGlobe without(off);
    test::Random random(32);
    unsigned int separated = 0;
    for (int i = 0; i < 200; ++i) {
        osg::Vec3d eye;
        const CullView view = randomView(random, eye);
        const std::set<std::string> reached = with.reached(*with.root, view);
        separated += with.counts.beyondEdge;
        const std::set<std::string> more = without.reached(*without.root, view);
        EXPECT_EQ(without.counts.beyondEdge, 0u);
        EXPECT_EQ(reached.size() + with.counts.beyondEdge, more.size());
    }
    EXPECT_GT(separated, 20u);
}

}  // namespace
}  // namespace osgAnalyticBin
