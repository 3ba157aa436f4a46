// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The callback in a real osgUtil::CullVisitor without a window; what is compared is the set of tiles that the traversal
// reaches. Oracles: dense samples of each bin against the frustum's planes (never culled when a sample is inside),
// relations (a moved globe, a local frame, masks on and off), OSG's own tests for small features and occluders.
// The verdict against a single plane is tested in core/.

#include "CameraGlobe.h"
#include "CullFixture.h"

#include <osgAnalyticBin/BinStatistics.h>

#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <support/Random.h>
#include <thread>

namespace osgAnalyticBin {
namespace {

using core::GeodeticBin;
using test::CullView;

using test::kEarthRadius;
using test::osgVector;

CullView randomGlobeView(test::Random& random) {
    const osg::Vec3d eye = test::randomEyeAbove(random, 2e4);
    const osg::Vec3d target = osgVector(random.direction()) * kEarthRadius;
    const osg::Vec3d up = osgVector(random.direction());
    return CullView::lookAt(eye, target, up, random.uniform(2.0, 90.0));
}

struct SmallGlobe {
    explicit SmallGlobe(const CullOptions& options = {}) : bins(test::startTiles()) {
        for (std::size_t i = 0; i < bins.size(); ++i) {
            root->addChild(test::makeTile(std::to_string(i), bins[i], visited, options));
        }
    }

    std::set<std::string> reached(osg::Node& scene, const CullView& view) {
        visited.clear();
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        test::cull(scene, view, *visitor);
        return visited;
    }

    osg::ref_ptr<osg::Group> root = new osg::Group;
    std::vector<AnalyticBin> bins;
    std::set<std::string> visited;
};

bool anyInside(const std::vector<osg::Vec3d>& points, const std::vector<osg::Plane>& planes) {
    return std::any_of(points.begin(), points.end(), [&](const osg::Vec3d& p) {
        return std::all_of(planes.begin(), planes.end(),
                           [&](const osg::Plane& plane) { return plane.distance(p) >= 0.0; });
    });
}

TEST(AnalyticBinCullCallback, NeverCullsATileWithAVisibleSample) {
    SmallGlobe globe;
    std::vector<std::vector<osg::Vec3d>> points;
    for (const AnalyticBin& bin : globe.bins) points.push_back(test::samples(bin, 13));
    test::Random random(10);
    int culled = 0;
    for (int i = 0; i < 300; ++i) {
        const CullView view = randomGlobeView(random);
        const std::set<std::string> reached = globe.reached(*globe.root, view);
        const std::vector<osg::Plane> planes = view.sidePlanes();
        for (std::size_t t = 0; t < points.size(); ++t) {
            if (reached.count(std::to_string(t))) continue;
            ++culled;
            ASSERT_FALSE(anyInside(points[t], planes)) << "view " << i << ", tile " << t;
        }
    }
    EXPECT_GT(culled, 300 * 128 / 4);  // and it does cull
}

TEST(AnalyticBinCullCallback, CullsWhatTheSphereKeeps) {
    SmallGlobe globe;
    test::Random random(11);
    const osg::EllipsoidModel wgs84;
    int byBins = 0;
    int bySpheres = 0;
    for (int i = 0; i < 200; ++i) {
        const CullView view = randomGlobeView(random);
        byBins += static_cast<int>(globe.reached(*globe.root, view).size());
        osg::Polytope frustum(view.sidePlanes());
        for (const AnalyticBin& bin : globe.bins) bySpheres += frustum.contains(bin.boundingSphere(wgs84)) ? 1 : 0;
    }
    EXPECT_LT(byBins, 0.9 * bySpheres) << byBins << " of " << bySpheres;
}

TEST(AnalyticBinCullCallback, AGlobeUnderATransformIsCulledLikeAGlobeAtRest) {
    SmallGlobe globe;
    const osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    mover->setCullingActive(false);
    mover->addChild(globe.root);
    test::Random random(12);
    for (int i = 0; i < 60; ++i) {
        CullView view = randomGlobeView(random);
        const std::set<std::string> atRest = globe.reached(*globe.root, view);
        const osg::Matrixd motion = osg::Matrixd::rotate(random.uniform(0, 6), 0.3, 0.5, -0.8) *
                                    osg::Matrixd::scale(0.5, 0.5, 0.5) * osg::Matrixd::translate(1e7, -3e6, 5e5);
        mover->setMatrix(motion);
        view.modelView = osg::Matrixd::inverse(motion) * view.modelView;
        EXPECT_EQ(globe.reached(*mover, view), atRest) << "view " << i;
    }
}

TEST(AnalyticBinCullCallback, ATileInALocalFrameIsCulledLikeOneInEcef) {
    const std::vector<AnalyticBin> bins = test::startTiles();
    SmallGlobe globe;
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Group> locals = new osg::Group;
    const osg::EllipsoidModel wgs84;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        osg::Matrixd localToEcef;
        const core::Geodetic center = bins[i].bin().center();
        wgs84.computeLocalToWorldTransformFromLatLongHeight(center.latitude, center.longitude, 0.0, localToEcef);
        osg::ref_ptr<osg::MatrixTransform> tile = new osg::MatrixTransform(localToEcef);
        osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback(bins[i], wgs84);
        callback->setLocalToEcef(localToEcef);
        callback->setNestedCallback(new test::VisitRecorder(std::to_string(i), visited));
        tile->setCullCallback(callback.get());
        tile->setCullingActive(false);
        locals->addChild(tile);
    }
    test::Random random(13);
    for (int i = 0; i < 60; ++i) {
        const CullView view = randomGlobeView(random);
        const std::set<std::string> inEcef = globe.reached(*globe.root, view);
        visited.clear();
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        test::cull(*locals, view, *visitor);
        EXPECT_EQ(visited, inEcef) << "view " << i;
    }
}

// Notes the mask of undecided planes that a cull traversal finds at a node.
class MaskRecorder : public osg::NodeCallback {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        mask = nv->asCullStack()->getCurrentCullingSet().getFrustum().getCurrentMask();
        traverse(node, nv);
    }
    unsigned int mask = ~0u;
};

osg::ref_ptr<osg::Group> makeRecordedChild(osg::Group& parent, osg::ref_ptr<MaskRecorder>& recorder) {
    osg::ref_ptr<osg::Group> child = new osg::Group;
    recorder = new MaskRecorder;
    child->setCullCallback(recorder.get());
    child->setCullingActive(false);
    parent.addChild(child);
    return child;
}

TEST(AnalyticBinCullCallback, ClearsDecidedPlanesForTheSubgraphOnly) {
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    const AnalyticBin inside(GeodeticBin::fromDegrees({-1, 1}, {-1, 1}, {0, 100}));
    const AnalyticBin straddling(GeodeticBin::fromDegrees({-1, 1}, {-20, 20}, {0, 100}));
    osg::ref_ptr<MaskRecorder> below[2];
    osg::ref_ptr<MaskRecorder> beside;
    int i = 0;
    for (const AnalyticBin& bin : {inside, straddling}) {
        const osg::ref_ptr<osg::Group> tile = test::makeTile("tile" + std::to_string(i), bin, visited);
        root->addChild(tile);
        makeRecordedChild(*tile, below[i++]);
    }
    makeRecordedChild(*root, beside);
    const CullView view = CullView::lookAt({kEarthRadius + 1e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    test::cull(*root, view, *visitor);
    EXPECT_EQ(below[0]->mask, 0u);           // inside all planes
    EXPECT_EQ(below[1]->mask & 0x3u, 0x3u);  // across left and right
    EXPECT_EQ(below[1]->mask & 0xcu, 0u);    // between bottom and top
    EXPECT_EQ(beside->mask, 0xfu);           // what follows is untouched
}

TEST(AnalyticBinCullCallback, TheSameTilesAreReachedWithMasksOnAndOff) {
    // Two generations: children under their parents (masks inherited) against children alone (all planes tested).
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Group> nested = new osg::Group;
    const osg::ref_ptr<osg::Group> flat = new osg::Group;
    int id = 0;
    for (const AnalyticBin& bin : test::startTiles()) {
        const osg::ref_ptr<osg::Group> parent = test::makeTile("parent", bin, visited);
        nested->addChild(parent);
        for (const GeodeticBin& quarter : bin.bin().quarters()) {
            const std::string name = std::to_string(id++);
            parent->addChild(test::makeTile(name, AnalyticBin(quarter), visited));
            flat->addChild(test::makeTile(name, AnalyticBin(quarter), visited));
        }
    }
    test::Random random(14);
    for (int i = 0; i < 100; ++i) {
        const CullView view = randomGlobeView(random);
        std::set<std::string> sets[2];
        int k = 0;
        for (const auto& scene : {nested, flat}) {
            visited.clear();
            const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
            test::cull(*scene, view, *visitor);
            visited.erase("parent");
            sets[k++] = visited;
        }
        EXPECT_EQ(sets[0], sets[1]) << "view " << i;
    }
}

TEST(AnalyticBinCullCallback, KeepsSmallFeatureCulling) {
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(
        test::makeTile("small", AnalyticBin(GeodeticBin::fromDegrees({0, 0.001}, {0, 0.001}, {0, 10})), visited));
    root->addChild(test::makeTile("large", AnalyticBin(GeodeticBin::fromDegrees({0, 5}, {0, 5}, {0, 10})), visited));
    CullView view = CullView::lookAt({kEarthRadius + 5e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    test::cull(*root, view, *visitor);
    EXPECT_EQ(visited, (std::set<std::string>{"large", "small"}));
    visited.clear();
    view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
    test::cull(*root, view, *visitor, 2);
    EXPECT_EQ(visited, std::set<std::string>{"large"});
}

TEST(AnalyticBinCullCallback, HonoursTheCullingModeWithoutFrustumCulling) {
    SmallGlobe globe;
    CullView view = CullView::lookAt({kEarthRadius + 1e5, 0, 0}, {0, 0, 0}, {0, 0, 1}, 10.0);
    EXPECT_LT(globe.reached(*globe.root, view).size(), 10u);
    view.cullingMode = osg::CullSettings::NO_CULLING;
    EXPECT_EQ(globe.reached(*globe.root, view).size(), 128u);
}

TEST(AnalyticBinCullCallback, HonoursNearAndFarPlanes) {
    SmallGlobe globe;
    CullView view = CullView::lookAt({kEarthRadius + 1e5, 0, 0}, {0, 0, 0}, {0, 0, 1}, 60.0);
    view.projection = osg::Matrixd::perspective(60.0, 1.0, 1.0, 3e6);  // ends inside the earth
    const std::size_t sides = globe.reached(*globe.root, view).size();
    view.cullingMode = osg::CullSettings::VIEW_FRUSTUM_CULLING;
    EXPECT_LT(globe.reached(*globe.root, view).size(), sides);
}

TEST(AnalyticBinCullCallback, DoubtIsVisible) {
    const CullView away = CullView::lookAt({kEarthRadius + 1e6, 0, 0}, {1e9, 0, 0}, {0, 0, 1}, 40.0);
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    CullOptions none;
    none.method = Method::None;
    const AnalyticBin bin(GeodeticBin::fromDegrees({-1, 1}, {-1, 1}, {0, 100}));
    root->addChild(test::makeTile("culled", bin, visited));
    root->addChild(test::makeTile("invalid bin", AnalyticBin(), visited));
    root->addChild(test::makeTile("no culling", bin, visited, none));
    osg::ref_ptr<osg::Group> singular = test::makeTile("singular frame", bin, visited);
    dynamic_cast<AnalyticBinCullCallback&>(*singular->getCullCallback()).setLocalToEcef(osg::Matrixd::scale(0, 1, 1));
    root->addChild(singular);
    root->addChild(test::makeTile("no radius", bin, visited, {}, osg::EllipsoidModel(std::nan(""), 6.4e6)));
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    test::cull(*root, away, *visitor);
    EXPECT_EQ(visited, (std::set<std::string>{"invalid bin", "no culling", "no radius", "singular frame"}));
}

TEST(AnalyticBinCullCallback, TheEllipsoidIsTheScenesOwn) {
    const osg::EllipsoidModel moon(1738100.0, 1736000.0);
    const AnalyticBin bin(GeodeticBin::fromDegrees({-1, 1}, {-1, 1}, {0, 100}));
    std::set<std::string> visited;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(test::makeTile("moon", bin, visited, {}, moon));
    root->addChild(test::makeTile("earth", bin, visited));
    // From within the earth past the moon's surface: the earth's tile is behind the eye.
    const CullView view = CullView::lookAt({3e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 30.0);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    test::cull(*root, view, *visitor);
    EXPECT_EQ(visited, std::set<std::string>{"moon"});
}

TEST(BinStatistics, CountsEachTraversalOnce) {
    SmallGlobe globe;
    const CullView view = CullView::lookAt({kEarthRadius + 1e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    EXPECT_EQ(BinStatistics::find(*visitor), nullptr);
    for (unsigned int frame = 1; frame <= 3; ++frame) {
        globe.visited.clear();
        test::cull(*globe.root, view, *visitor, frame);
        const BinStatistics* statistics = BinStatistics::find(*visitor);
        ASSERT_NE(statistics, nullptr);
        const BinCounts counts = statistics->getCounts();
        EXPECT_EQ(counts.frame, frame);
        EXPECT_EQ(counts.tested, 128u);
        EXPECT_EQ(counts.inside + counts.straddling, globe.visited.size());
        EXPECT_EQ(counts.outside, 128u - globe.visited.size());
    }
}

TEST(BinStatistics, VisitorsShareNothingNotEvenClones) {
    SmallGlobe globe;
    const osg::ref_ptr<osgUtil::CullVisitor> a = new osgUtil::CullVisitor;
    test::cull(*globe.root, CullView::lookAt({kEarthRadius + 1e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0), *a);
    const BinCounts before = BinStatistics::find(*a)->getCounts();
    const osg::ref_ptr<osgUtil::CullVisitor> b = a->clone();
    EXPECT_EQ(BinStatistics::find(*b), nullptr);
    test::cull(*globe.root, CullView::lookAt({kEarthRadius + 1e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0), *b);
    EXPECT_EQ(BinStatistics::find(*a)->getCounts().inside, before.inside);
    EXPECT_NE(BinStatistics::find(*b)->getCounts().inside, before.inside);
    // they may cull in two threads: nothing is put into what OSG has them share
    EXPECT_NE(b->getUserDataContainer(), a->getUserDataContainer());
    EXPECT_EQ(a->getUserDataContainer()->getNumUserObjects(), 1u);
}

// Counts without a set: several threads may write to it.
class VisitCounter : public osg::NodeCallback {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        ++count;
        traverse(node, nv);
    }
    std::atomic<unsigned int> count{0};
};

TEST(AnalyticBinCullCallback, SeveralCullTraversalsMayRunAtOnce) {
    const osg::ref_ptr<VisitCounter> counter = new VisitCounter;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    for (const AnalyticBin& bin : test::startTiles()) {
        osg::ref_ptr<osg::Group> tile = new osg::Group;
        osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback(bin, osg::EllipsoidModel());
        callback->setNestedCallback(counter.get());
        tile->setCullCallback(callback.get());
        tile->setCullingActive(false);
        root->addChild(tile);
    }
    root->getBound();  // as the viewer does before it starts its threads
    constexpr unsigned int kFrames = 200;
    std::vector<BinCounts> counts(4);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < counts.size(); ++t) {
        threads.emplace_back([&, t] {
            const CullView view =
                CullView::lookAt({kEarthRadius + 1e6 * double(t + 1), 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
            const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
            for (unsigned int frame = 1; frame <= kFrames; ++frame) test::cull(*root, view, *visitor, frame);
            counts[t] = BinStatistics::find(*visitor)->getCounts();
        });
    }
    for (std::thread& thread : threads) thread.join();
    unsigned int kept = 0;
    for (const BinCounts& c : counts) {
        EXPECT_EQ(c.tested, 128u);
        kept += kFrames * (c.inside + c.straddling);
    }
    EXPECT_EQ(counter->count, kept);
}

}  // namespace
}  // namespace osgAnalyticBin
