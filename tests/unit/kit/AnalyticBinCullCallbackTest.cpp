// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The callback in a real osgUtil::CullVisitor without a window, what is counted there, and what becomes of an
// osg::ClusterCullingCallback meanwhile. Oracles: the set of tiles that the traversal reaches; relations (a moved
// globe, a local frame). That no tile is culled that is seen: ProjectionTest.cpp. Verdicts on single planes: core/.

#include "KitTest.h"

#include <osg/UserDataContainer>

#include <typeinfo>

namespace osgAnalyticBin::test {
namespace {

using core::GeodeticBin;

// Looks at the middle of the globe.
CullView atMiddle(double altitude, double fovDeg = 40.0) {
    return CullView::lookAt({kEarthRadius + altitude, 0, 0}, {0, 0, 0}, {0, 0, 1}, fovDeg);
}

struct CountedGlobe : CameraGlobe {
    using CameraGlobe::CameraGlobe;

    std::set<std::size_t> reached(osg::Node& scene, const CullView& view, float pixels = 2.0f) {
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        visitor->setSmallFeatureCullingPixelSize(pixels);
        cull(scene, view, *visitor);
        counts = BinStatistics::of(*visitor).getCounts();
        return takeLooks().at(0).reached;
    }

    BinCounts counts;
};

TEST(AnalyticBinCullCallback, CullsAGlobeThatATransformMovesTurnsAndScalesLikeOneAtRest) {
    CountedGlobe globe(horizonOptions());
    const osg::ref_ptr<osg::MatrixTransform> mover = makeTransform({}, {&globe.root()});
    mover->setCullingActive(false);
    Random random(31);
    for (int i = 0; i < 60; ++i) {
        const osg::Vec3d eye = randomEyeAbove(random, 1e3), target = osgVector(random.direction()) * kEarthRadius;
        CullView view = CullView::lookAt(eye, target, osgVector(random.direction()), random.uniform(2.0, 90.0));
        const std::set<std::size_t> atRest = globe.reached(globe.root(), view);
        // A line of sight stays a line under any affine map: unequal scales do no harm.
        const osg::Vec3d scale = i % 2 ? osg::Vec3d(0.5, 0.5, 0.5) : osg::Vec3d(0.5, 2.0, 1.25);
        const osg::Matrixd motion = osg::Matrixd::rotate(random.uniform(0, 6), 0.3, 0.5, -0.8) *
                                    osg::Matrixd::scale(scale) * osg::Matrixd::translate(1e7, -3e6, 5e5);
        mover->setMatrix(motion);
        view.modelView = osg::Matrixd::inverse(motion) * view.modelView;
        EXPECT_EQ(globe.reached(*mover, view), atRest) << "view " << i;
    }
}

TEST(AnalyticBinCullCallback, DoubtIsVisible) {
    const CullView away = CullView::lookAt({kEarthRadius + 1e6, 0, 0}, {1e9, 0, 0}, {0, 0, 1}, 40.0);
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    const auto add = [&](const char* name, AnalyticBinCullCallback* callback) {
        const osg::ref_ptr<osg::Group> tile = new osg::Group;
        tile->setCullingActive(false);
        callback->setNestedCallback(new VisitRecorder(name, visited));
        tile->setCullCallback(callback);
        root->addChild(tile);
    };
    const osg::EllipsoidModel wgs84;
    const AnalyticBin bin(GeodeticBin::fromDegrees({-1, 1}, {-1, 1}, {0, 100}));
    add("culled", new AnalyticBinCullCallback(bin, wgs84));
    add("invalid bin", new AnalyticBinCullCallback(AnalyticBin(), wgs84));
    add("no culling", new AnalyticBinCullCallback(bin, wgs84, by(Method::None)));
    // rounding gives the flat one some inverse
    const osg::Matrixd turn = osg::Matrixd::rotate(0.7, 1, 2, 3);
    osg::Matrixd projective, unknown;
    projective(0, 3) = 1e-7;
    unknown(3, 1) = std::nan("");
    const std::pair<const char*, osg::Matrixd> frames[] = {
        {"singular frame", osg::Matrixd::scale(0, 1, 1)},
        {"flat frame", turn * osg::Matrixd::scale(1, 1, 0) * osg::Matrixd::inverse(turn)},
        {"projective frame", projective},
        {"unknown frame", unknown}};
    for (const auto& [name, frame] : frames) {
        auto* const callback = new AnalyticBinCullCallback(bin, wgs84);
        callback->setLocalToEcef(frame);
        add(name, callback);
    }
    add("no radius", new AnalyticBinCullCallback(bin, osg::EllipsoidModel(std::nan(""), 6.4e6)));
    (void)cull(*root, away);
    EXPECT_EQ(visited, (std::set<std::string>{"invalid bin", "no culling", "no radius", "singular frame", "flat frame",
                                              "projective frame", "unknown frame"}));
}

TEST(HorizonCulling, ADatabaseDeclaresItAndTheUserHasTheLastWord) {
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    setStoredBin(*tile, AnalyticBin(GeodeticBin::fromDegrees({0, 1}, {0, 1}, {0, 100})));
    const auto root = makeGlobe({tile});
    root->setUpdateCallback(new InstallBinsCallback(horizonOptions()));
    const auto installed = [&](const CullOptions& options) {
        installBins(*root, options);
        return dynamic_cast<AnalyticBinCullCallback&>(*tile->getCullCallback()).getCullOptions();
    };
    EXPECT_EQ(installed({}).horizonUse, HorizonUse::Given);
    EXPECT_EQ(installed({}).horizon, -kOccluderDepth);
    EXPECT_EQ(installed(optionsOf("horizon=off")).horizonUse, HorizonUse::Off);
    EXPECT_EQ(installed(optionsOf("horizon=-9")).horizon, -9.0);
}

// The counts say what became of a tile, not what its bin alone said: small features are outside.
TEST(CulledCounts, AreThoseOfTheTilesThatAreReachedAlsoOfSmallFeatures) {
    CountedGlobe globe;
    CullView view = CullView::lookAt({5 * kEarthRadius, 0, 0}, {0, 0, 0}, {0, 0, 1}, 50.0);
    view.projection = osg::Matrixd::perspective(50.0, 1.0, 1e5, 1e8);
    const auto counted = [&](float pixels) {
        const std::size_t reached = globe.reached(globe.root(), view, pixels).size();
        EXPECT_EQ(globe.counts.tested, 128u);
        EXPECT_EQ(globe.counts.inside + globe.counts.straddling, reached);
        EXPECT_EQ(globe.counts.outside, 128u - reached);
        return globe.counts;
    };
    const BinCounts all = counted(2.0f);
    ASSERT_GT(all.inside, 0u);
    view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
    EXPECT_EQ(counted(2.0f).outside, all.outside) << "none is smaller than two pixels";
    int partly = 0;
    for (float pixels = 20.0f; pixels < 200.0f; pixels += 5.0f) {
        const unsigned int outside = counted(pixels).outside;
        if (outside > all.outside && outside < 128u) ++partly;
    }
    EXPECT_GT(partly, 2);
    EXPECT_EQ(counted(1e6f).outside, 128u);
}

TEST(BinStatistics, CountsEachTraversalOfAVisitorOnce) {
    CountedGlobe globe;
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    EXPECT_EQ(BinStatistics::find(*visitor), nullptr);
    for (unsigned int frame = 1; frame <= 3; ++frame) {
        cull(globe.root(), atMiddle(1e6), *visitor, frame);
        ASSERT_NE(BinStatistics::find(*visitor), nullptr);
        EXPECT_EQ(BinStatistics::find(*visitor)->getCounts().frame, frame);
        EXPECT_EQ(BinStatistics::find(*visitor)->getCounts().tested, 128u);
    }
    // visitors share nothing, not even clones
    const osg::ref_ptr<osgUtil::CullVisitor> a = visitor, b = a->clone();
    const BinCounts before = BinStatistics::find(*a)->getCounts();
    EXPECT_EQ(BinStatistics::find(*b), nullptr);
    cull(globe.root(), atMiddle(1e7), *b);
    EXPECT_EQ(BinStatistics::find(*a)->getCounts().inside, before.inside);
    EXPECT_NE(BinStatistics::find(*b)->getCounts().inside, before.inside);
    // they may cull in two threads: nothing is put into what OSG has them share
    EXPECT_NE(b->getUserDataContainer(), a->getUserDataContainer());
    EXPECT_EQ(a->getUserDataContainer()->getNumUserObjects(), 1u);
}

// A tile whose PagedLOD and drawable have callbacks that cull whatever the eye, between callbacks of the user.
struct ClusterTile {
    ClusterTile() {
        mesh = makeMeshTile(extentsDeg(0, 20, 0, 20), 0.0);
        drawable = mesh->getChild(0)->asGeode()->getDrawable(0);
        paged = makePaged(mesh, "none.osgb", 1.0f);
        first->setNestedCallback(makeCluster());
        first->getNestedCallback()->setNestedCallback(new VisitRecorder("last", names));
        paged->setCullCallback(first);
        drawable->setCullCallback(makeCluster());
        root->addChild(paged);
    }

    static osg::ClusterCullingCallback* makeCluster() {
        auto* cluster = new osg::ClusterCullingCallback(osg::Vec3(), osg::Vec3(-1, 0, 0), 0.9f);
        cluster->setRadius(5.0f);
        return cluster;
    }

    // What a cull traversal reaches: "first", "last", "drawn".
    std::set<std::string> reached() {
        names.clear();
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        CullView view = CullView::lookAt(ecefDeg(10, 10, 5e6), {0, 0, 0}, {0, 0, 1}, 60.0);
        view.cullingMode |= osg::CullSettings::CLUSTER_CULLING;
        const CullResult result = cull(*root, view, *visitor);
        if (result.drawn.count(drawable)) names.insert("drawn");
        EXPECT_TRUE(visitor->getCullingMode() & osg::CullSettings::CLUSTER_CULLING);
        return names;
    }

    std::set<std::string> names;
    const osg::ref_ptr<VisitRecorder> first = new VisitRecorder("first", names);
    osg::ref_ptr<osg::MatrixTransform> mesh;
    osg::ref_ptr<osg::Drawable> drawable;
    osg::ref_ptr<osg::PagedLOD> paged;
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
};

const std::set<std::string> kAll{"first", "last", "drawn"};
const std::set<std::string> kClusterCulled{"first"};

TEST(ClusterCulling, RestsWhileBinsAreInstalled) {
    ClusterTile tile;
    ASSERT_EQ(tile.reached(), kClusterCulled);
    const osg::ref_ptr<osg::Callback> cluster = tile.first->getNestedCallback();
    for (int i = 0; i < 2; ++i) {
        installBins(*tile.root);
        EXPECT_EQ(tile.reached(), kAll);
        EXPECT_EQ(tile.first->getNestedCallback(), cluster);
    }
    installBins(*tile.root, by(Method::None));
    EXPECT_EQ(tile.reached(), kAll);
    installBins(*tile.root, by(Method::Sphere));
    EXPECT_EQ(tile.reached(), kClusterCulled);
    EXPECT_EQ(tile.paged->getCullCallback(), tile.first);
}

TEST(ClusterCulling, RestsInTheMeshOfALeaf) {
    ClusterTile tile;
    const auto leaf = makeGroup({tile.mesh});
    setStoredBin(*leaf, AnalyticBin(extentsDeg(0, 20, 0, 20).withAltitude({-100000.0, 100.0})));
    tile.root->replaceChild(tile.paged, leaf);
    ASSERT_EQ(tile.reached().count("drawn"), 0u);
    for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(installBins(*tile.root), 1u);
        EXPECT_EQ(tile.reached().count("drawn"), 1u);
    }
    removeBins(*tile.root);
    EXPECT_EQ(tile.reached().count("drawn"), 0u);
}

TEST(ClusterCulling, StaysWhereItIsToBeKept) {
    ClusterTile tile;
    installBins(*tile.root, optionsOf("cluster=keep"));
    EXPECT_EQ(tile.reached(), kClusterCulled);
    EXPECT_EQ(typeid(*tile.first->getNestedCallback()), typeid(osg::ClusterCullingCallback));
}

TEST(ClusterCulling, IsSavedAsWhatItWas) {
    const TemporaryFolder folder;
    ClusterTile tile;
    installBins(*tile.root);
    ASSERT_EQ(tile.reached(), kAll);
    for (const char* name : {"/tile.osgb", "/tile.osgt"}) {
        ASSERT_TRUE(osgDB::writeNodeFile(*tile.mesh, folder.path() + name));
        const osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(folder.path() + name);
        ASSERT_TRUE(read);
        osg::Drawable& drawable = *read->asGroup()->getChild(0)->asGeode()->getDrawable(0);
        ASSERT_NE(drawable.getCullCallback(), nullptr);
        const osg::Callback& callback = *drawable.getCullCallback();
        ASSERT_EQ(typeid(callback), typeid(osg::ClusterCullingCallback));
        const auto& cluster = dynamic_cast<const osg::ClusterCullingCallback&>(callback);
        EXPECT_EQ(cluster.getNormal(), osg::Vec3(-1, 0, 0));
        EXPECT_EQ(cluster.getDeviation(), 0.9f);
        EXPECT_EQ(cluster.getRadius(), 5.0f);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
