// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases of a map: how their tiles are culled. Oracle: all that the levels of detail choose, by a traversal without
// frustum culling, and points of its triangles against the frustum's planes.

#include "PagedFlight.h"
#include "PlanarMap.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>
#include <osg/TriangleFunctor>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <support/Random.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using test::CullView;
using test::optionsOf;
using test::PlanarMap;

// Notes the drawables that a traversal comes to, whatever becomes of their own boxes.
class Reached : public osgUtil::CullVisitor {
public:
    using osgUtil::CullVisitor::apply;
    void apply(osg::Drawable& drawable) override {
        drawables.insert(&drawable);
        osgUtil::CullVisitor::apply(drawable);
    }
    std::set<osg::Drawable*> drawables;
};

std::set<osg::Drawable*> reached(osg::Node& scene, const CullView& view, BinCounts* counts = nullptr) {
    const osg::ref_ptr<Reached> visitor = new Reached;
    test::cull(scene, view, *visitor);
    if (counts) *counts = BinStatistics::of(*visitor).getCounts();
    return visitor->drawables;
}

struct PointSink {
    std::vector<osg::Vec3d>* points = nullptr;
    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) const {
        for (int i = 0; i <= 3; ++i)
            for (int j = 0; j <= 3 - i; ++j)
                points->push_back((osg::Vec3d(a) * i + osg::Vec3d(b) * j + osg::Vec3d(c) * (3 - i - j)) / 3.0);
    }
};

std::vector<osg::Vec3d> pointsOf(osg::Drawable& drawable) {
    std::vector<osg::Vec3d> points;
    osg::TriangleFunctor<PointSink> functor;
    functor.points = &points;
    drawable.accept(functor);
    const osg::Matrixd toWorld = drawable.getWorldMatrices().at(0);
    for (osg::Vec3d& point : points) point = point * toWorld;
    return points;
}

// Over the map, beside it or below it; perspective or orthographic.
CullView randomView(test::Random& random, const PlanarMap& map) {
    const auto place = [&](double beside) {
        return map.origin +
               osg::Vec3d(random.uniform(-beside, 1.0 + beside), random.uniform(-beside, 1.0 + beside), 0) * map.size;
    };
    const osg::Vec3d eye =
        place(0.3) + osg::Vec3d(0, 0, 1) * (random.logUniform(10.0, 40000.0) - random.uniform(0.0, 3000.0));
    const osg::Vec3d target = place(0.1) + osg::Vec3d(0, 0, 1) * random.uniform(-2000.0, 4000.0);
    const osg::Vec3d up(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1));
    CullView view = CullView::lookAt(eye, target, up, random.uniform(5.0, 60.0));
    if (random.chance(0.3)) {
        const double half = random.logUniform(300.0, 30000.0);
        view.projection = osg::Matrixd::ortho(-half, half, -half, half, 1.0, 1e8);
    }
    return view;
}

struct Tally {
    std::size_t seen = 0;
    std::size_t withBins = 0;
    std::size_t withSpheres = 0;
    std::size_t beyondEdge = 0;
};

using Shown = std::map<osg::Drawable*, std::vector<osg::Vec3d>>;

// Returns: how many of the drawables are seen; each of them has to be kept.
std::size_t checkKept(const Shown& shown, const std::set<osg::Drawable*>& kept, const CullView& view) {
    const std::vector<osg::Plane> planes = view.sidePlanes();
    std::size_t number = 0;
    for (const auto& [drawable, points] : shown) {
        if (!test::holdAny(planes, points)) continue;
        ++number;
        EXPECT_TRUE(kept.count(drawable));
    }
    return number;
}

// From the same eye, through a long lens at the lowest or the highest point of one tile: just into the picture.
CullView closeUp(test::Random& random, const Shown& shown, const osg::Vec3d& eye) {
    const auto& points = std::next(shown.begin(), random.integer(0, static_cast<int>(shown.size()) - 1))->second;
    const auto [lowest, highest] = std::minmax_element(
        points.begin(), points.end(), [](const osg::Vec3d& a, const osg::Vec3d& b) { return a.z() < b.z(); });
    const bool isLow = random.chance(0.5);
    const osg::Vec3d point = isLow ? *lowest : *highest;
    const double fov = random.logUniform(0.05, 2.0);
    const double beside = 0.95 * std::tan(osg::DegreesToRadians(0.5 * fov)) * (point - eye).length();
    return CullView::lookAt(eye, point + osg::Vec3d(0, 0, isLow ? -beside : beside), osg::Vec3d(0, 0, 1), fov);
}

// Flies over the installed database and its plain twin.
void fly(osg::Group& installed, osg::Group& plain, const PlanarMap& map, test::Random& random, Tally& tally) {
    test::PagedFlight binFlight(installed);
    test::PagedFlight sphereFlight(plain);
    for (int trial = 0; trial < 30; ++trial) {
        const CullView view = randomView(random, map);
        CullView all = view;
        all.cullingMode = osg::CullSettings::NO_CULLING;
        ASSERT_TRUE(binFlight.load(all));
        ASSERT_TRUE(sphereFlight.load(all));
        binFlight.frames(all, 2);
        sphereFlight.frames(all, 2);
        BinCounts counts;
        Shown shown;
        for (osg::Drawable* drawable : reached(installed, all)) shown[drawable] = pointsOf(*drawable);
        const std::set<osg::Drawable*> kept = reached(installed, view, &counts);
        const std::set<osg::Drawable*> keptBySpheres = reached(plain, view);
        EXPECT_EQ(shown.size(), reached(plain, all).size());
        EXPECT_GT(counts.tested, 0u);
        tally.seen += checkKept(shown, kept, view);
        const osg::Vec3d eye = osg::Matrixd::inverse(view.modelView).getTrans();
        for (int i = 0; i < 10; ++i) {
            const CullView close = closeUp(random, shown, eye);
            (void)checkKept(shown, reached(installed, close), close);
        }
        tally.withBins += kept.size();
        tally.withSpheres += keptBySpheres.size();
        tally.beyondEdge += counts.beyondEdge;
    }
}

// With skirts=all, because eyes below the map see whole skirts.
Tally flownTally(const PlanarMap& map, const std::string& options) {
    const test::TemporaryFolder folder;
    const auto installed = map.build(folder.path());
    const auto plain = map.build(folder.path());
    EXPECT_EQ(installBins(*installed, optionsOf(options)), 1u);
    for (osg::Group* root : {installed.get(), plain.get()}) {
        auto* terrain = dynamic_cast<osgTerrain::Terrain*>(root);
        if (terrain) terrain->setVerticalScale(static_cast<float>(map.verticalScale));
    }
    Tally tally;
    test::Random random(815);
    fly(*installed, *plain, map, random, tally);
    EXPECT_GT(tally.seen, 50u);
    ::testing::Test::RecordProperty("withBins", static_cast<int>(tally.withBins));
    ::testing::Test::RecordProperty("withSpheres", static_cast<int>(tally.withSpheres));
    ::testing::Test::RecordProperty("seen", static_cast<int>(tally.seen));
    return tally;
}

// Tiles that are kept in vain.
void expectFewerThanWithSpheres(const Tally& tally) {
    EXPECT_LT(5 * (tally.withBins - tally.seen), 4 * (tally.withSpheres - tally.seen));
}

TEST(PlanarDatabase, TerrainTilesAreCulledWellAndNeverWhenSeen) {
    const Tally tally = flownTally(PlanarMap(), "skirts=all,heights=0..2600");
    expectFewerThanWithSpheres(tally);
    EXPECT_GT(tally.beyondEdge, 0u);
}

TEST(PlanarDatabase, MeshesAreCulledWellAndNeverWhenSeen) {
    PlanarMap map;
    map.isTerrain = false;
    const Tally tally = flownTally(map, "skirts=all,heights=0..2600");
    expectFewerThanWithSpheres(tally);
}

TEST(PlanarDatabase, FollowsTheVerticalScale) {
    PlanarMap map;
    map.verticalScale = 3.0;
    const Tally tally = flownTally(map, "skirts=all,heights=0..2600");
    EXPECT_LT(tally.withBins, tally.withSpheres);
}

TEST(PlanarDatabase, UndeclaredHeightsHoldTerrainInFeet) {
    PlanarMap map;
    map.heightUnit = 0.3048;
    map.origin.z() = 0.0;
    (void)flownTally(map, "skirts=all");
    map.isTerrain = false;
    (void)flownTally(map, "skirts=all");
}

}  // namespace
}  // namespace osgAnalyticBin
