// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What was found behind a ridge serves the next views, and never longer than it holds.

#include "../../../osgAnalyticBin/src/occlusion/OcclusionSearch.h"
#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// What was found serves the next views as well. It must not outlast the place that it was found for.
TEST(TerrainOcclusion, IsFoundAgainWhereTheEyeHasMoved) {
    // the lowest eye that sees the tile behind the ridge, by what is found for one view alone
    double lowest = 1000.0, highest = 40000.0;
    while (highest > 1.0001 * lowest) {
        InstalledRidge globe;
        const double middle = 0.5 * (lowest + highest);
        (globe.drawsFarTile(RidgeGlobe::alongRow(middle)) ? highest : lowest) = middle;
    }
    InstalledRidge globe;
    for (const double step : {1.0, 5.0, 20.0, 60.0, 200.0, 500.0}) {
        for (int start = 0; start < 20; ++start) {
            for (int i = 0; i < 20; ++i) {
                const double altitude = highest + (0.5 + i - 10 - 0.05 * start) * step;
                const bool isDrawn = globe.drawsFarTile(RidgeGlobe::alongRow(altitude));
                EXPECT_TRUE(isDrawn || altitude < 1.002 * highest) << altitude << " by steps of " << step;
                // not much is lost by looking ahead
                EXPECT_TRUE(!isDrawn || altitude > 0.8 * highest) << altitude << " by steps of " << step;
            }
        }
    }
}

// Compares a camera that turns with a new search for each view.
TEST(TerrainOcclusion, HidesNothingMoreWhereTheCameraTurns) {
    Random random(1712);
    int hidden = 0;
    for (int flight = 0; flight < 10; ++flight) {
        InstalledRidge globe(8000.0, 5);
        const double fov = random.uniform(2.0, 12.0), start = random.uniform(-0.2, 0.4);
        double north = random.uniform(-0.2, 0.4);
        for (int i = 0; i < 20; ++i) {
            north += random.sign() * random.logUniform(1e-4, 0.1);
            const CullView view =
                CullView::lookAt(ecefDeg(start, 0.1, 1000.0), ecefDeg(start + north, 1.1, 1000.0), {1, 0, 0}, fov);
            if (globe.drawsFarTile(view)) continue;
            InstalledRidge alone(8000.0, 5);
            EXPECT_FALSE(alone.drawsFarTile(view)) << "flight " << flight << ", view " << i;
            hidden += alone.counts().occluded > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(hidden, 20);
}

// No view waits for a search, and never two in succession are drawn without one.
TEST(TerrainOcclusion, IsSearchedForBesideTheDrawingIfLeftToItself) {
    RidgeGlobe globe;
    installBins(*globe.root, optionsOf("occlusion=auto"));
    for (int i = 0; i < 20 && globe.drawsFarTile(); ++i) update(*globe.root);
    const auto turned = [](double north) {
        return CullView::lookAt(ecefDeg(0.1, 0.1, 1000.0), ecefDeg(0.1 + north, 1.0, 1000.0), {1, 0, 0}, 30.0);
    };
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(globe.drawsFarTile(turned(0.0))) << i;
    EXPECT_TRUE(globe.drawsFarTile(turned(0.2)));
    EXPECT_STREQ(BinStatistics::of(*globe.visitor).notCovered(), "a search for this view, which is under way");
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(globe.drawsFarTile(turned(0.2))) << i;
    Random random(3011);
    int whole = 0;
    for (int i = 0; i < 100; ++i) {
        whole = globe.drawsFarTile(turned(random.uniform(-0.2, 0.2))) ? whole + 1 : 0;
        EXPECT_LE(whole, 1) << i;
    }
    // a jump
    EXPECT_FALSE(globe.drawsFarTile(RidgeGlobe::alongRow(1500.0)));
}

// The views with which what is found anew begins to serve. A search takes longer than all other culling.
std::vector<int> beginningsIn(InstalledRidge& globe, const std::function<CullView(int)>& view) {
    const BinStatistics& statistics = BinStatistics::of(*globe.visitor);
    std::shared_ptr<const CoveredPicture> last;
    std::vector<int> beginnings;
    for (int i = 0; i < 200; ++i) {
        (void)globe.drawsFarTile(view(i));
        if (statistics.covered() != last) beginnings.push_back(i);
        last = statistics.covered();
    }
    return beginnings;
}

std::vector<int> beginningsIn(const std::function<CullView(int)>& view) {
    InstalledRidge globe;
    return beginningsIn(globe, view);
}

CullView eastward(double east, double altitude) {
    return CullView::lookAt(ecefDeg(0.1, east, altitude), ecefDeg(0.1, east + 0.9, altitude), {1, 0, 0}, 30.0);
}

TEST(TerrainOcclusion, ServesManyViewsOfAStraightFlightAndOfATurn) {
    for (const double altitude : {200.0, 1000.0, 1717.0})
        EXPECT_LE(beginningsIn([&](int i) { return eastward(0.1 + 1e-5 * i, altitude); }).size(), 10u) << altitude;
    // as a camera turns, corners of its view come forward, and so does what the near plane may cut
    const auto turned = [](int i) {
        return CullView::lookAt(ecefDeg(0.1, 0.1, 1000.0), ecefDeg(0.15 - 1e-3 * i, 1.0, 1000.0), {1, 0, 0}, 30.0);
    };
    EXPECT_LE(beginningsIn(turned).size(), 40u);
}

// One visitor culls for a camera in the scene, too, such as a mirror.
TEST(TerrainOcclusion, ServesManyViewsOfEachOfSeveralCameras) {
    InstalledRidge globe;
    std::vector<osg::ref_ptr<osg::Node>> content;
    std::vector<osg::ref_ptr<osg::Camera>> mirrors;
    for (int i = 0; i < 3; ++i) {
        mirrors.push_back(new osg::Camera);
        mirrors.back()->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        mirrors.back()->setRenderOrder(osg::Camera::PRE_RENDER);
        mirrors.back()->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        mirrors.back()->setViewport(0, 0, 512, 512);
        mirrors.back()->addChild(globe.root);
        content.emplace_back(mirrors.back());
    }
    content.emplace_back(globe.root);
    globe.scene = makeGroup(content);
    const auto view = [&](int i) {
        for (int mirror = 0; mirror < 3; ++mirror) {
            const CullView aside = eastward(0.1 + 1e-5 * i + 1e-3 * mirror, 1000.0);
            mirrors[static_cast<std::size_t>(mirror)]->setViewMatrix(aside.modelView);
            mirrors[static_cast<std::size_t>(mirror)]->setProjectionMatrix(aside.projection);
        }
        return eastward(0.1 + 1e-5 * i, 1000.0);
    };
    EXPECT_LE(beginningsIn(globe, view).size(), 10u);
    EXPECT_GT(globe.counts().occluded, 0u);
}

// What was found ahead of need grows old before it is needed: meshes may have changed without a word.
TEST(TerrainOcclusion, ServesNoViewsThatAreLongAfterItsSearch) {
    // of a camera that stops
    const auto beginningsOf = [](int stop) {
        return beginningsIn([stop](int i) { return eastward(0.1 + 1e-4 * std::min(i, stop), 1000.0); });
    };
    // the first two searches are made when they are needed
    const std::vector<int> moving = beginningsOf(200), stopped = beginningsOf(moving.at(2) - 1);
    EXPECT_GT(stopped.at(2), moving[2] + 20);
    EXPECT_LE(stopped.at(3), moving[2] + 64);
}

// The next search is made in another thread, and what is found is used when it is needed, not when it is ready.
TEST(TerrainOcclusion, IsTheSameInEachFlight) {
    const auto hiddenInFlight = [] {
        InstalledRidge globe;
        std::vector<unsigned int> hidden;
        for (int i = 0; i < 200; ++i) {
            const double east = 0.1 + 1e-5 * i, north = 0.1 + 2e-4 * i;
            (void)globe.drawsFarTile(
                CullView::lookAt(ecefDeg(0.1, east, 500.0 + i), ecefDeg(north, 1.0, 500.0), {1, 0, 0}, 30.0));
            hidden.push_back(globe.counts().occluded);
        }
        return hidden;
    };
    const std::vector<unsigned int> first = hiddenInFlight();
    EXPECT_GT(*std::max_element(first.begin(), first.end()), 0u);
    EXPECT_EQ(hiddenInFlight(), first);
}

TEST(TerrainOcclusion, OutlastsTilesThatHidNothingOrAreOutOfView) {
    using Finding = FoundOcclusion::Finding;
    enum class Result { Nothing, Less, All };
    const core::Ellipsoid ellipsoid(6378137.0, 6356752.3142);
    // the half-space north of the equator
    core::PlaneSet view;
    view.push_back({{0.0, 0.0, 1.0}, 0.0});
    std::uint64_t plates = 0;
    const auto tile = [&](double south, double north, double margin = 0.0) {
        return FoundOcclusion::Tile{nullptr, nullptr, true, ++plates, extentsDeg(south, north, 1, 2),
                                    margin,  0.0,     10.0};
    };
    FoundOcclusion first;
    first.tiles = {tile(1, 2), tile(2, 3), tile(-3, -2), tile(3, 4)};
    first.number = {0, 1, 2, 3};
    first.findings = {Finding::Seen, Finding::Hidden, Finding::Seen, Finding::Seen};
    // the buffer has no earth, so that a second test does not find it hidden
    first.hidden = {{1, {100.0, {0.0, 0.1}, {0.0, 0.1}, 100.0, false}}};
    // from the south, looking north
    first.eye = {{7e6, 0.0, -5e6}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
    first.nearReach = 1000.0;
    first.earth.emplace(7e6, core::Interval{-1.0, 1.0});
    // what the tiles that come draw near the eye; null: not known
    std::shared_ptr<const core::EcefMesh> mesh;
    // numbers: of the first tiles
    const auto whatOutlasts = [&](const std::vector<std::size_t>& shown, const FoundOcclusion& from,
                                  const std::vector<FoundOcclusion::Tile>& come = {}) {
        FoundOcclusion found = from;
        for (const std::size_t i : shown) found.shown.push_back(found.tiles[i]);
        found.shown.insert(found.shown.end(), come.begin(), come.end());
        const bool holds = found.follow(view, ellipsoid, [&](std::size_t i) {
            EXPECT_GE(i, shown.size());
            return mesh;
        });
        EXPECT_EQ(found.tiles.size(), found.number.size());
        EXPECT_EQ(found.tiles == found.shown, holds);
        if (!holds) return Result::Nothing;
        for (std::size_t i = 0; i < found.tiles.size(); ++i)
            EXPECT_EQ(found.number[i], i < shown.size() ? from.number[shown[i]] : FoundOcclusion::kCame);
        const bool isLess = found.findings[1] == Finding::Seen;
        EXPECT_TRUE(found.isOutdated || !isLess);
        return isLess ? Result::Less : Result::All;
    };
    EXPECT_EQ(whatOutlasts({0, 2, 3}, first), Result::All);
    EXPECT_EQ(whatOutlasts({0, 1, 3}, first), Result::All);
    EXPECT_EQ(whatOutlasts({0, 3}, first), Result::All);
    EXPECT_EQ(whatOutlasts({1, 2, 3}, first), Result::Less);
    EXPECT_EQ(whatOutlasts({0, 1, 2}, first), Result::Less);
    // what may reach into the view by its margin, or by the bulge of its sides
    for (const auto& near : {tile(-1, -0.001, 200.0), tile(-1, 1e-4)}) {
        FoundOcclusion reaching = first;
        reaching.tiles[2] = near;
        EXPECT_EQ(whatOutlasts({0, 1, 3}, reaching), Result::Less);
    }
    // others come: beside what has gone out of view, or in its place
    EXPECT_EQ(whatOutlasts({0, 1, 2, 3}, first, {tile(5, 6)}), Result::All);
    EXPECT_EQ(whatOutlasts({0, 1, 3}, first, {tile(-2, 1)}), Result::All);
    EXPECT_EQ(whatOutlasts({0, 1, 3}, first, {tile(-4, 1)}), Result::Less);
    EXPECT_EQ(whatOutlasts({0, 1, 3}, first, {tile(5, 6), tile(-2.1, 1)}), Result::Less);
    EXPECT_EQ(whatOutlasts({1, 2, 3}, first, {tile(1, 1.5)}), Result::Less);
    // in views that follow, too
    FoundOcclusion later = first;
    later.shown = {first.tiles[0], first.tiles[3]};
    const auto noMesh = [](std::size_t) { return nullptr; };
    EXPECT_TRUE(later.follow(view, ellipsoid, noMesh));
    later.shown.clear();
    EXPECT_EQ(whatOutlasts({0, 1}, later, {tile(-4, 1)}), Result::Less);
    EXPECT_EQ(whatOutlasts({0, 1}, later, {tile(-2, 1)}), Result::All);
    // until its place is in view again
    later.shown = later.tiles;
    EXPECT_TRUE(later.follow(view, ellipsoid, noMesh));
    EXPECT_EQ(later.leftView.size(), 1u);
    EXPECT_TRUE(later.follow(core::PlaneSet(), ellipsoid, noMesh));
    EXPECT_EQ(later.leftView.size(), 0u);
    EXPECT_TRUE(later.isOutdated);
    const auto outlasts = [&](const std::vector<std::size_t>& shown, const FoundOcclusion& from,
                              const std::vector<FoundOcclusion::Tile>& come) {
        return whatOutlasts(shown, from, come) != Result::Nothing;
    };
    // too near for what is known of the near plane
    FoundOcclusion close = first;
    const auto standAt = [&close](double north, double east) {
        const osg::Vec3d above = ecefDeg(north, east, 2000.0);
        close.eye.origin = {above.x(), above.y(), above.z()};
    };
    standAt(5.5, 1.5);
    EXPECT_TRUE(outlasts({0, 1, 2, 3}, close, {tile(8, 9)}));
    EXPECT_FALSE(outlasts({0, 1, 2, 3}, close, {tile(5, 6)}));
    // unless its mesh is: below the eye, where it may be seen in front of the near plane; at the eye; or out of reach
    const auto meshAhead = [&close](double ahead, double below) {
        const auto made = std::make_shared<core::EcefMesh>();
        const glm::dvec3 middle = close.eye.origin + ahead * close.eye.y - below * close.eye.z;
        for (const glm::dvec3& corner : {middle, middle + 9.0 * close.eye.x, middle + 9.0 * close.eye.y}) {
            made->x.push_back(corner.x);
            made->y.push_back(corner.y);
            made->z.push_back(corner.z);
        }
        made->triangles = {0, 1, 2};
        return made;
    };
    close.span.across = {-1.0, 1.0};
    mesh = meshAhead(100.0, 50.0);
    EXPECT_EQ(whatOutlasts({0, 1, 2, 3}, close, {tile(5, 6)}), Result::Less);
    mesh = meshAhead(-2.0, -1.0);
    EXPECT_EQ(whatOutlasts({0, 1, 2, 3}, close, {tile(5, 6)}), Result::Nothing);
    mesh = meshAhead(5000.0, 50.0);
    EXPECT_EQ(whatOutlasts({0, 1, 2, 3}, close, {tile(5, 6)}), Result::All);
    mesh = nullptr;
    close.eyes = {0.0, 300e3, 0.0};
    EXPECT_FALSE(outlasts({0, 1, 2, 3}, close, {tile(8, 9)}));
    // the near plane cuts as far ahead on the sides of the picture as in the middle, and nothing beside it
    close.eyes = {0.0, 0.0, 0.0};
    close.nearReach = 300e3;
    standAt(5.5, -1.2);
    EXPECT_FALSE(outlasts({0, 1, 2, 3}, close, {tile(8, 9)}));
    close.earth.emplace(7e6, core::Interval{-0.1, 0.1});
    EXPECT_TRUE(outlasts({0, 1, 2, 3}, close, {tile(8, 9)}));
}

// A search that is begun in one view serves the view that it is begun for, however fast the eye moves.
TEST(TerrainOcclusion, IsSearchedForTheViewsThatFollow) {
    const core::Frame from{{6.4e6, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
    for (const double clearance : {1.0, 100.0, 10e3}) {
        for (const glm::dvec3& step : {glm::dvec3(0.0), glm::dvec3(0.1, 5.0, 2.0), glm::dvec3(1.0, 1.0, -8.0)}) {
            for (const int first : {0, 1, 2}) {
                FoundOcclusion found;
                found.lastClearance = clearance;
                found.aimAlong(from, step, first);
                EXPECT_TRUE(found.holds(from.origin + static_cast<double>(first) * step)) << clearance << ' ' << first;
            }
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
