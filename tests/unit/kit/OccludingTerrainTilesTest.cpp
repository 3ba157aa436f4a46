// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgTerrain tiles that hide others. Meshes: TerrainOcclusionTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"
#include "DatabaseFixture.h"
#include "RidgeGlobe.h"
#include "TileFixture.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/PagedLOD>
#include <osg/Shape>
#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/Layer>
#include <osgTerrain/Terrain>
#include <osgTerrain/ValidDataOperator>

#include <algorithm>
#include <functional>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using osgTerrain::TerrainTile;

osg::ref_ptr<TerrainTile> makePlain(double south, double north, double west, double east, unsigned int posts,
                                    float height = 0.0f) {
    return makeTerrainTile(extentsDeg(south, north, west, east), posts, posts,
                           [height](unsigned int, unsigned int) { return height; });
}

// A globe of osgTerrain tiles. Along the equator stand tiles of 0.2 degrees: a plain, and in the third tile a ridge,
// which tile 4 lies behind. The eye is above the middle of tile 0.
struct TerrainGlobe {
    explicit TerrainGlobe(float heightOfFarTile = 0.0f) {
        terrain->setEllipsoidModel(new osg::EllipsoidModel);
        for (int i = 0; i < 32; ++i) {
            const double south = -90.0 + 45.0 * (i / 8), west = -180.0 + 45.0 * (i % 8);
            if (i != 20) terrain->addChild(makePlain(south, south + 45.0, west, west + 45.0, 65));
        }
        terrain->addChild(makePlain(0.2, 45.0, 0.0, 45.0, 65));
        for (int i = 0; i < 225; ++i) {
            row.push_back(makePlain(0.0, 0.2, 0.2 * i, 0.2 * i + 0.2, 9,
                                    i == 2   ? 8000.0f
                                    : i == 4 ? heightOfFarTile
                                             : 0.0f));
            terrain->addChild(row.back());
        }
    }

    [[nodiscard]] bool drawsFarTile(double nearPlane = 1.0) {
        CullView view = CullView::lookAt(ecefDeg(0.1, 0.1, 1000.0), ecefDeg(0.1, 1.0, 1000.0), {1, 0, 0}, 30.0);
        view.projection = osg::Matrixd::perspective(30.0, 1.0, nearPlane, 1e8);
        update(*terrain);
        return cull(*terrain, view, *visitor, ++frame).drawn.count(drawableOf(*row[4])) > 0;
    }
    [[nodiscard]] BinCounts counts() const { return BinStatistics::of(*visitor).getCounts(); }

    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    std::vector<osg::ref_ptr<TerrainTile>> row;
    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    unsigned int frame = 0;
};

TEST(OccludingTerrainTiles, HideNothingOnceTheyHaveLostTheirTechnique) {
    TerrainGlobe globe;
    installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
    for (int i = 0; i < 2; ++i) EXPECT_FALSE(globe.drawsFarTile());
    globe.row[2]->setTerrainTechnique(nullptr);
    EXPECT_TRUE(globe.drawsFarTile());
}

TEST(OccludingTerrainTiles, GetTheirPlatesInUpdatesWhereTheyAreLeftToThemselves) {
    TerrainGlobe globe;
    installBins(*globe.terrain, withOcclusion(OcclusionUse::Auto));
    int awaited = 0;
    for (; awaited < 100 && globe.drawsFarTile(); ++awaited) continue;
    EXPECT_GE(awaited, 1);
    EXPECT_LT(awaited, 100);
}

TEST(OccludingTerrainTiles, FollowTheVerticalScale) {
    TerrainGlobe globe;
    installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
    const auto framesUntil = [&](bool isDrawn) {
        int frames = 0;
        while (frames < 100 && globe.drawsFarTile() != isDrawn) ++frames;
        return frames;
    };
    EXPECT_EQ(framesUntil(false), 0);
    // a ridge of 80 m hides nothing: at once, and from then on
    globe.terrain->setVerticalScale(0.01f);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(globe.drawsFarTile()) << i;
    globe.terrain->setVerticalScale(1.0f);
    EXPECT_LT(framesUntil(false), 100);
    // depressions hide nothing
    globe.terrain->setVerticalScale(-1.0f);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(globe.drawsFarTile()) << i;
}

// A layer in which one height stands for none.
void makeHole(TerrainGlobe& globe) {
    auto& layer = static_cast<osgTerrain::HeightFieldLayer&>(*globe.row[2]->getElevationLayer());
    layer.getHeightField()->setHeight(4, 4, -9999.0f);
    layer.setValidDataOperator(new osgTerrain::NoDataValue(-9999.0f));
}

TEST(OccludingTerrainTiles, AreWholeGridsAsOsgMakesThem) {
    struct OtherTechnique : osgTerrain::GeometryTechnique {};
    const std::vector<std::function<void(TerrainGlobe&)>> others{
        makeHole,
        [](TerrainGlobe& globe) { globe.terrain->setEqualizeBoundaries(true); },
        [](TerrainGlobe& globe) { globe.terrain->setSampleRatio(0.5f); },
        [](TerrainGlobe& globe) { globe.terrain->setTerrainTechniquePrototype(new OtherTechnique); },
        [](TerrainGlobe& globe) { globe.row[2]->setTerrainTechnique(new OtherTechnique); },
        [](TerrainGlobe& globe) { globe.row[2]->setBlendingPolicy(TerrainTile::ENABLE_BLENDING); },
    };
    for (std::size_t i = 0; i < others.size(); ++i) {
        TerrainGlobe globe;
        others[i](globe);
        installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
        for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(globe.drawsFarTile()) << i;
    }
    for (const std::size_t i : {1u, 2u}) {
        TerrainGlobe globe;
        installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
        EXPECT_FALSE(globe.drawsFarTile());
        others[i](globe);
        for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(globe.drawsFarTile()) << i;
    }
}

// With a technique that the application vouches for, the horizon is used if the eye is surely above what is drawn. A
// ridge hides nothing, because nobody knows its exact height.
TEST(OccludingTerrainTiles, OfATechniqueThatIsVouchedForAreTheHorizonAlone) {
    struct OtherTechnique : osgTerrain::GeometryTechnique {};
    TerrainGlobe globe;
    globe.terrain->setTerrainTechniquePrototype(new OtherTechnique);
    CullOptions options = withOcclusion(OcclusionUse::On);
    installBins(*globe.terrain, options);
    const auto hiddenFrom = [&](double longitude, double altitude) {
        const auto view = CullView::lookAt(ecefDeg(0.107, longitude, altitude), ecefDeg(0.107, longitude + 0.1, 0.0),
                                           {1, 0, 0}, 60.0);
        for (int i = 0; i < 2; ++i) {
            update(*globe.terrain);
            (void)cull(*globe.terrain, view, *globe.visitor, ++globe.frame);
        }
        return globe.counts().hidden;
    };
    EXPECT_EQ(hiddenFrom(0.507, 9000.0), 0u);
    options.techniqueMargin = 300.0;
    setCullOptions(*globe.terrain, options);
    EXPECT_GT(hiddenFrom(0.507, 8310.0), 0u);
    EXPECT_EQ(hiddenFrom(0.507, 8290.0), 0u);
    // the ridge ends at 0.6 degrees, and may overhang the plain by 300 m
    EXPECT_GT(hiddenFrom(0.6 + 350.0 / 111320.0, 500.0), 0u);
    EXPECT_EQ(hiddenFrom(0.6 + 290.0 / 111320.0, 500.0), 0u);
    for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(globe.drawsFarTile());
}

// Nor behind the horizon: through a hole the eye sees the other side of the globe.
TEST(OccludingTerrainTiles, HideNothingWhereTheyHaveHoles) {
    TerrainGlobe whole, holed;
    makeHole(holed);
    for (TerrainGlobe* globe : {&whole, &holed}) {
        installBins(*globe->terrain, withOcclusion(OcclusionUse::Off));
        const auto view = CullView::lookAt(ecefDeg(0.1, 0.5, 2e5), ecefDeg(0.1, 0.5, 0.0), {0, 0, 1}, 60.0);
        for (int i = 0; i < 2; ++i) {
            update(*globe->terrain);
            (void)cull(*globe->terrain, view, *globe->visitor, ++globe->frame);
        }
    }
    EXPECT_GT(whole.counts().hidden, 0u);
    EXPECT_EQ(holed.counts().hidden, 0u);
}

// Through a plain that is cut away, the eye sees past the foot of the ridge into a pit.
TEST(OccludingTerrainTiles, HideNothingWhereTheNearPlaneCutsThemAway) {
    TerrainGlobe globe(-15000.0f);
    // with bins as deep as the pit, so that nothing but the near plane shows it
    for (std::size_t i = 0; i < 10; ++i) {
        const double west = 0.2 * static_cast<double>(i);
        setStoredBin(*globe.row[i],
                     AnalyticBin(extentsDeg(0.0, 0.2, west, west + 0.2).withAltitude({-2e4, 9e3}), 10.0));
    }
    installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
    EXPECT_FALSE(globe.drawsFarTile());
    EXPECT_FALSE(globe.drawsFarTile(500.0));
    EXPECT_TRUE(globe.drawsFarTile(6000.0));
    EXPECT_TRUE(globe.drawsFarTile(60000.0));
}

void setHeights(TerrainTile& tile, float height) {
    osg::HeightField& field = *static_cast<osgTerrain::HeightFieldLayer&>(*tile.getElevationLayer()).getHeightField();
    for (unsigned int i = 0; i < field.getNumColumns() * field.getNumRows(); ++i)
        field.setHeight(i % field.getNumColumns(), i / field.getNumColumns(), height);
}

// A tile alone, and one below a PagedLOD, as databases have it.
void pageTile(TerrainGlobe& globe, std::size_t i) {
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(globe.row[i], "no.osgb");
    globe.terrain->replaceChild(globe.row[i], paged);
}

osg::ref_ptr<osgTerrain::ImageLayer> makeImageLayer(TerrainTile& tile, unsigned char alpha) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), 16, alpha);
    const osg::ref_ptr<osgTerrain::ImageLayer> layer = new osgTerrain::ImageLayer(image);
    layer->setLocator(tile.getElevationLayer()->getLocator());
    return layer;
}

TEST(OccludingTerrainTiles, HideNothingWhereTheTerrainHasThemBlended) {
    for (const bool isLater : {false, true}) {
        TerrainGlobe globe;
        if (!isLater) globe.terrain->setBlendingPolicy(TerrainTile::ENABLE_BLENDING);
        installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
        EXPECT_EQ(globe.drawsFarTile(), !isLater);
        globe.terrain->setBlendingPolicy(TerrainTile::ENABLE_BLENDING);
        for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(globe.drawsFarTile()) << isLater << frame;
    }
}

TEST(OccludingTerrainTiles, NeedHeightsAndImagesThatAreAsTheyWere) {
    using TileChange = std::function<void(TerrainTile&)>;
    const std::vector<TileChange> changes{
        [](TerrainTile& tile) { setHeights(tile, 0.0f); },
        [](TerrainTile& tile) { tile.setElevationLayer(makePlain(0.0, 0.2, 0.4, 0.6, 9)->getElevationLayer()); },
        [](TerrainTile& tile) { tile.setBlendingPolicy(TerrainTile::ENABLE_BLENDING); },
        [](TerrainTile& tile) { tile.setColorLayer(0, makeImageLayer(tile, 127)); },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        for (const bool isPaged : {false, true}) {
            TerrainGlobe globe;
            if (isPaged) pageTile(globe, 2);
            globe.row[2]->setColorLayer(0, makeImageLayer(*globe.row[2], 255));
            installBins(*globe.terrain, withOcclusion(OcclusionUse::On));
            EXPECT_FALSE(globe.drawsFarTile());
            changes[i](*globe.row[2]);
            globe.row[2]->setDirty(true);
            globe.row[2]->dirtyBound();
            for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(globe.drawsFarTile()) << i << isPaged << frame;
        }
    }
}

TEST(OccludingTerrainTiles, AreDrawnWhereTheyHaveRisenOutOfTheirBins) {
    const CullView view = CullView::lookAt(ecefDeg(0.1, 0.1, 6000.0), ecefDeg(0.1, 2.0, 8000.0), {1, 0, 0}, 2.0);
    for (const bool isPaged : {false, true}) {
        for (const float scale : {1.0f, 0.5f}) {
            TerrainGlobe globe;
            if (isPaged) pageTile(globe, 8);
            globe.terrain->setVerticalScale(scale);
            installBins(*globe.terrain, withOcclusion(OcclusionUse::Off));
            const auto isDrawn = [&] {
                update(*globe.terrain);
                const CullResult result = cull(*globe.terrain, view, *globe.visitor, ++globe.frame);
                return result.drawn.count(drawableOf(*globe.row[8])) > 0;
            };
            EXPECT_FALSE(isDrawn());
            setHeights(*globe.row[8], 8000.0f / scale);
            globe.row[8]->setDirty(true);
            globe.row[8]->dirtyBound();
            for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(isDrawn()) << isPaged << scale << frame;
        }
    }
}

// Over tiles that have sunk the eye sees what was behind its horizon.
TEST(OccludingTerrainTiles, ThatHaveSunkLowerTheHorizon) {
    const CullView view = CullView::lookAt(ecefDeg(0.1, 0.1, 1000.0), ecefDeg(0.1, 1.4, 0.0), {1, 0, 0}, 2.0);
    TerrainGlobe globe;
    installBins(*globe.terrain, withOcclusion(OcclusionUse::Off));
    const auto isDrawn = [&] {
        update(*globe.terrain);
        const CullResult result = cull(*globe.terrain, view, *globe.visitor, ++globe.frame);
        return result.drawn.count(drawableOf(*globe.row[9])) > 0;
    };
    EXPECT_FALSE(isDrawn());
    for (std::size_t i = 3; i < 9; ++i) {
        setHeights(*globe.row[i], -3000.0f);
        globe.row[i]->setDirty(true);
        globe.row[i]->dirtyBound();
    }
    for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(isDrawn()) << frame;
}

}  // namespace
}  // namespace osgAnalyticBin::test
