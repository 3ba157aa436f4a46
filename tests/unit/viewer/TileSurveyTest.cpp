// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a camera's cull traversal came to. Oracles: the counters and the render graph of a traversal that was not
// watched; tiles whose verdict can be told by hand.

#include "DatabaseFixture.h"
#include "ViewerScene.h"

#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <gtest/gtest.h>
#include <osg/PolygonMode>

#include <algorithm>

namespace osgAnalyticBin {
namespace {

using test::ViewerScene;

const SurveyedTile* tileAt(const TileSurvey& survey, double latitudeDeg, double longitudeDeg) {
    const core::Geodetic place{osg::DegreesToRadians(latitudeDeg), osg::DegreesToRadians(longitudeDeg), 0.0};
    const auto found = std::find_if(survey.tiles().begin(), survey.tiles().end(),
                                    [&](const SurveyedTile& tile) { return tile.bin.contains(place); });
    return found == survey.tiles().end() ? nullptr : &*found;
}

CullOptions with(Method method) {
    CullOptions options;
    options.method = method;
    options.horizonUse = HorizonUse::Given;
    options.horizon = -12000.0;
    return options;
}

TEST(TileSurvey, KnowsWhereBinsStandAndTellsVerdictsThatAreKnown) {
    ViewerScene scene(with(Method::Quadratic));
    // two radii above the middle of the tile 0 .. 45 north, 0 .. 45 east, which the frustum holds whole
    scene.lookFrom(22.5, 22.5, 12e6, 0.0, 60.0);
    const TileSurvey survey(scene.camera(), scene.frameStamp());
    ASSERT_EQ(survey.tiles().size(), 32u);
    const osg::Matrixd identity;
    for (const SurveyedTile& tile : survey.tiles()) {
        ASSERT_TRUE(tile.hasBin && tile.ellipsoid && tile.bin.valid());
        for (int i = 0; i < 16; ++i) EXPECT_NEAR(tile.ecefToWorld.ptr()[i], identity.ptr()[i], 1e-6);
    }
    ASSERT_TRUE(tileAt(survey, 20, 20) && tileAt(survey, -20, -160));
    EXPECT_EQ(tileAt(survey, 20, 20)->verdict, TileVerdict::Inside);
    EXPECT_TRUE(tileAt(survey, 20, 20)->isDrawn);
    EXPECT_FALSE(tileAt(survey, 20, 20)->isCulled);
    // at the antipodes
    EXPECT_EQ(tileAt(survey, -20, -160)->verdict, TileVerdict::Hidden);
    EXPECT_TRUE(tileAt(survey, -20, -160)->isCulled);
    EXPECT_FALSE(tileAt(survey, -20, -160)->isDrawn);

    // from low above a corner of four tiles, with a narrow view to the ground
    scene.lookFrom(0.0, 0.0, 100e3, 0.0, 20.0);
    const TileSurvey low(scene.camera(), scene.frameStamp());
    for (const auto& [latitude, longitude] : {std::pair(-20.0, -20.0), {-20.0, 20.0}, {20.0, -20.0}, {20.0, 20.0}}) {
        ASSERT_TRUE(tileAt(low, latitude, longitude));
        EXPECT_EQ(tileAt(low, latitude, longitude)->verdict, TileVerdict::Straddling);
    }
    EXPECT_EQ(tileAt(low, 20, 70)->verdict, TileVerdict::Outside);
    EXPECT_EQ(low.counts().kept, 4u);
}

TEST(TileSurvey, SeesThroughWireframeAsTheCameraDoes) {
    ViewerScene scene(with(Method::Quadratic));
    scene.lookFrom(22.5, 22.5, 12e6, 0.0, 60.0);
    EXPECT_GT(TileSurvey(scene.camera(), scene.frameStamp()).counts().hidden, 0u);
    scene.camera().getOrCreateStateSet()->setAttribute(
        new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
    EXPECT_EQ(TileSurvey(scene.camera(), scene.frameStamp()).counts().hidden, 0u);
}

TEST(TileSurvey, CountsWhatATraversalThatIsNotWatchedDraws) {
    for (const Method method : {Method::Quadratic, Method::Exact, Method::Sphere, Method::None}) {
        ViewerScene scene(with(method));
        for (const double pitch : {0.0, 40.0, 70.0}) {
            scene.lookFrom(15.0, 40.0, 800e3, pitch, 45.0);
            const TileCounts counts = TileSurvey(scene.camera(), scene.frameStamp()).counts();
            EXPECT_EQ(counts.drawn, scene.cull().size()) << methodName(method) << ' ' << pitch;
            EXPECT_LE(counts.drawn, counts.kept);
            EXPECT_EQ(counts.tested, 32u);
            EXPECT_EQ(method == Method::None, counts.kept == 32u);
        }
    }
}

TEST(TileSurvey, OfAFrozenCameraIsThatOfWhereItFroze) {
    ViewerScene scene(with(Method::Quadratic));
    scene.lookFrom(15.0, 40.0, 800e3, 60.0, 45.0);
    const TileSurvey before(scene.camera(), scene.frameStamp());
    CameraCulling::of(scene.camera()).freeze(CameraCulling::cullingView(scene.camera()));
    scene.lookFrom(-60.0, 140.0, 5e6, 0.0, 45.0);
    const TileSurvey frozen(scene.camera(), scene.frameStamp());
    ASSERT_EQ(frozen.tiles().size(), before.tiles().size());
    for (std::size_t i = 0; i < before.tiles().size(); ++i) {
        EXPECT_EQ(frozen.tiles()[i].verdict, before.tiles()[i].verdict);
        EXPECT_EQ(frozen.tiles()[i].isDrawn, before.tiles()[i].isDrawn);
    }
}

// The kit puts a group above each of them.
TEST(TileSurvey, KnowsTheBinsOfLeavesThatAreTransforms) {
    ViewerScene scene(with(Method::Quadratic));
    const auto leaf = test::makeMeshTile(test::extentsDeg(-90, -45, -180, -135), 0.0);
    auto& tile = dynamic_cast<osg::PagedLOD&>(*scene.database().asGroup()->getChild(0));
    ASSERT_TRUE(osgDB::writeNodeFile(*test::makeGroup({leaf}), tile.getDatabasePath() + tile.getFileName(1)));
    test::putBelow(tile, test::readBelow(tile));
    scene.lookFrom(-67.5, -157.5, 100e3, 0.0, 60.0);
    const TileSurvey survey(scene.camera(), scene.frameStamp());
    EXPECT_TRUE(std::any_of(survey.tiles().begin(), survey.tiles().end(), [](const SurveyedTile& surveyed) {
        const osg::Group* const group = surveyed.node->asGroup();
        return group && !group->asTransform() && group->getNumChildren() == 1 && group->getChild(0)->asTransform();
    }));
    for (const SurveyedTile& surveyed : survey.tiles()) EXPECT_TRUE(surveyed.hasBin);
}

}  // namespace
}  // namespace osgAnalyticBin
