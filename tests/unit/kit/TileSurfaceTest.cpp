// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle: samples of the triangles that osgTerrain::GeometryTechnique itself makes of a tile, taken back to latitude,
// longitude and altitude.

#include "KitTest.h"
#include "TileSurfaceCases.h"

namespace osgAnalyticBin::test::surfaces {
namespace {

osg::ref_ptr<osgTerrain::TerrainTile> randomTile(const TileCase& c, Random& random) {
    const double low = random.uniform(-11000.0, 8000.0);
    const double high = random.uniform(low, 8800.0);
    return makeTerrainTile(c.extents, c.columns, c.rows, [&](unsigned int, unsigned int) {
        return static_cast<float>(random.chance(0.2) ? low : random.uniform(low, high));
    });
}

osg::HeightField& heightsOf(osgTerrain::TerrainTile& tile) {
    return *static_cast<osgTerrain::HeightFieldLayer*>(tile.getElevationLayer())->getHeightField();
}

TEST(TileSurface, HoldsEveryTriangleOfATerrainTile) {
    Random random(1);
    for (const TileCase& c : tileCases()) {
        for (const float scale : {1.0f, 3.0f, 0.25f, 10.0f, -2.0f}) {
            const auto tile = randomTile(c, random);
            const TileSurface surface = surfaceOf(*tile);
            ASSERT_TRUE(surface.bin.valid()) << c.name;
            EXPECT_TRUE(surface.isScalable);
            EXPECT_EQ(surface.skirt, 0.0);
            const auto samples = samplesOf(drawnTriangles(*tile, scale).surface, 3);
            ASSERT_FALSE(samples.empty());
            const AnalyticBin bin = surface.bin.exaggerated(static_cast<double>(scale));
            EXPECT_LE(metresOutside(bin, samples, kEllipsoid), bin.margin()) << c.name << " scale " << scale;
        }
    }
}

// The technique stores vertices about the middle of the colours.
TEST(TileSurface, HoldsATerrainTileWhoseColoursStandElsewhere) {
    Random random(6);
    const osg::ref_ptr<osgTerrain::ImageLayer> image = new osgTerrain::ImageLayer;
    const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
    locator->setCoordinateSystemType(osgTerrain::Locator::GEOCENTRIC);
    locator->setTransformAsExtents(-osg::PI, -osg::PI_2, osg::PI, osg::PI_2);
    image->setLocator(locator);
    for (const TileCase& c : tileCases()) {
        const auto tile = randomTile(c, random);
        tile->setColorLayer(0, image);
        const TileSurface surface = surfaceOf(*tile);
        const auto samples = samplesOf(drawnTriangles(*tile, 1.0f).surface, 1);
        EXPECT_LE(metresOutside(surface.bin, samples, kEllipsoid), surface.bin.margin()) << c.name;
    }
}

TEST(TileSurface, IsTightAroundATerrainTile) {
    Random random(2);
    for (const TileCase& c : tileCases()) {
        const auto tile = randomTile(c, random);
        const TileSurface surface = surfaceOf(*tile);
        const core::Interval seen = altitudesOf(samplesOf(drawnTriangles(*tile, 1.0f).surface));
        const double margin = surface.bin.margin();
        EXPECT_LE(surface.bin.bin().altitude().upper, seen.upper + margin) << c.name;
        // the lowest post need not stand where chords sag most
        EXPECT_LE(seen.lower - surface.bin.bin().altitude().lower, surface.bin.sag() + margin) << c.name;
        EXPECT_EQ(surface.bin.bin().longitude(), c.extents.longitude()) << c.name;
        // half a column about its middle, squared, over four: the poleward run at 45 degrees
        const double column = c.extents.longitude().width() / (c.columns - 1);
        EXPECT_LE(surface.bin.bin().latitude().upper - c.extents.latitude().upper, 0.07 * column * column + 1e-12);
        EXPECT_LE(c.extents.latitude().lower - surface.bin.bin().latitude().lower, 0.07 * column * column + 1e-12);
        EXPECT_LE(margin, 2.0);
    }
}

TEST(TileSurface, KnowsHowLowEveryEdgeIs) {
    Random random(3);
    for (const TileCase& c : tileCases()) {
        const auto tile = randomTile(c, random);
        const TileSurface surface = surfaceOf(*tile);
        std::array<double, 4> seen;
        seen.fill(std::numeric_limits<double>::infinity());
        const core::Interval latitude = c.extents.latitude();
        const core::Interval longitude = c.extents.longitude();
        const double row = latitude.width() / (c.rows - 1);
        const double column = longitude.width() / (c.columns - 1);
        const auto altitude = [&](unsigned int i, unsigned int j) {
            return static_cast<double>(heightsOf(*tile).getHeight(i, j));
        };
        const auto chord = [&](double& low, unsigned int i, unsigned int j, unsigned int di, unsigned int dj) {
            const glm::dvec3 a =
                kEllipsoid.toEcef({latitude.lower + j * row, longitude.lower + i * column, altitude(i, j)});
            const glm::dvec3 b = kEllipsoid.toEcef(
                {latitude.lower + (j + dj) * row, longitude.lower + (i + di) * column, altitude(i + di, j + dj)});
            for (int k = 0; k <= 8; ++k) low = std::min(low, kEllipsoid.toGeodetic(a + k / 8.0 * (b - a)).altitude);
        };
        for (unsigned int i = 0; i + 1 < c.columns; ++i) {
            chord(seen[0], i, 0, 1, 0);
            chord(seen[2], i, c.rows - 1, 1, 0);
        }
        for (unsigned int j = 0; j + 1 < c.rows; ++j) {
            chord(seen[1], c.columns - 1, j, 0, 1);
            chord(seen[3], 0, j, 0, 1);
        }
        for (std::size_t edge = 0; edge < 4; ++edge) {
            EXPECT_LE(surface.edgeLow[edge], seen[edge] + 1e-3) << c.name << " edge " << edge;
            EXPECT_LE(seen[edge] - surface.edgeLow[edge], 1.1 * surface.bin.sag()) << c.name << " edge " << edge;
        }
    }
}

TEST(TileSurface, FollowsTheSampleRatio) {
    Random random(4);
    const TileCase c = tileCases().front();
    const auto tile = randomTile(c, random);
    for (const double ratio : {0.0, 0.1, 0.5, 2.0}) {
        const TileSurface surface = surfaceOf(*tile, ratio);
        const auto samples = samplesOf(drawnTriangles(*tile, 1.0f, static_cast<float>(ratio)).surface);
        EXPECT_LE(metresOutside(surface.bin, samples, kEllipsoid), surface.bin.margin()) << ratio;
    }
    EXPECT_GT(surfaceOf(*tile, 0.1).bin.sag(), 4.0 * surfaceOf(*tile).bin.sag());
}

TEST(TileSurface, PassesOverPostsWithoutData) {
    Random random(5);
    const TileCase c = tileCases()[5];
    const auto tile = randomTile(c, random);
    for (const unsigned int i : {0u, 5u, 17u, 200u, 300u}) heightsOf(*tile).getHeightList()[i] = -99999.0f;
    EXPECT_FALSE(surfaceOf(*tile).bin.valid()) << "no terrain is that deep";
    tile->getElevationLayer()->setValidDataOperator(new osgTerrain::NoDataValue(-99999.0f));
    const TileSurface surface = surfaceOf(*tile);
    ASSERT_TRUE(surface.bin.valid());
    EXPECT_GT(surface.bin.bin().altitude().lower, -20000.0);
    const auto samples = samplesOf(drawnTriangles(*tile, 1.0f).surface);
    EXPECT_LE(metresOutside(surface.bin, samples, kEllipsoid), surface.bin.margin());
    for (const double low : surface.edgeLow) EXPECT_LE(low, altitudesOf(samples).lower + surface.bin.sag());
}

TEST(TileSurface, KnowsATileWithoutHeights) {
    const auto tile = makeTerrainTile(GeodeticBin::fromDegrees({0, 45}, {0, 90}, {0, 0}), 8, 8,
                                      [](unsigned int, unsigned int) { return 0.0f; });
    const osg::ref_ptr<osgTerrain::ImageLayer> image = new osgTerrain::ImageLayer;
    image->setLocator(tile->getElevationLayer()->getLocator());
    tile->setElevationLayer(nullptr);
    EXPECT_FALSE(surfaceOf(*tile).bin.valid());
    tile->setColorLayer(0, image);
    const TileSurface surface = surfaceOf(*tile);
    ASSERT_TRUE(surface.bin.valid());
    const auto samples = samplesOf(drawnTriangles(*tile, 5.0f).surface);
    EXPECT_LE(metresOutside(surface.bin.exaggerated(5.0), samples, kEllipsoid), surface.bin.margin());
}

TEST(TileSurface, LeavesSkirtsOfTerrainTilesOut) {
    Random random(6);
    for (const TileCase& c : tileCases()) {
        const auto tile = randomTile(c, random);
        heightsOf(*tile).setSkirtHeight(4000.0f);
        const TileSurface surface = surfaceOf(*tile);
        EXPECT_EQ(surface.skirt, 4000.0);
        const DrawnTriangles drawn = drawnTriangles(*tile, 2.0f);
        ASSERT_FALSE(drawn.skirts.empty());
        const AnalyticBin bin = surface.bin.exaggerated(2.0);
        EXPECT_LE(metresOutside(bin, samplesOf(drawn.surface, 3), kEllipsoid), bin.margin()) << c.name;
        const core::Interval h = bin.bin().altitude();
        const AnalyticBin hung(bin.bin().withAltitude({h.lower - surface.skirt, h.upper}));
        EXPECT_LE(metresOutside(hung, samplesOf(drawn.skirts, 3), kEllipsoid), bin.margin()) << c.name;
    }
}

TEST(TileSurface, IsUnknownWhereTheTileIsBroken) {
    const auto fresh = [] {
        return makeTerrainTile(GeodeticBin::fromDegrees({0, 45}, {0, 90}, {0, 0}), 8, 8,
                               [](unsigned int, unsigned int) { return 100.0f; });
    };
    ASSERT_TRUE(surfaceOf(*fresh()).bin.valid());
    auto tile = fresh();
    heightsOf(*tile).setHeight(3, 3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_FALSE(surfaceOf(*tile).bin.valid());
    tile = fresh();
    heightsOf(*tile).setHeight(3, 3, std::numeric_limits<float>::infinity());
    EXPECT_FALSE(surfaceOf(*tile).bin.valid());
    tile = fresh();
    heightsOf(*tile).getHeightList().resize(63);
    EXPECT_FALSE(surfaceOf(*tile).bin.valid());
    tile = fresh();
    tile->getElevationLayer()->getLocator()->setCoordinateSystemType(osgTerrain::Locator::GEOGRAPHIC);
    EXPECT_FALSE(surfaceOf(*tile).bin.valid());
    tile = fresh();
    tile->getElevationLayer()->getLocator()->setTransform(osg::Matrixd::rotate(0.5, 0, 0, 1));
    EXPECT_FALSE(surfaceOf(*tile).bin.valid());
    tile = fresh();
    tile->getElevationLayer()->getLocator()->setTransformAsExtents(0, 0, 90, 45);
    EXPECT_FALSE(surfaceOf(*tile).bin.valid()) << "degrees";
    struct OwnLocator : osgTerrain::Locator {
        explicit OwnLocator(const osgTerrain::Locator& other) : osgTerrain::Locator(other) {}
    };
    tile = fresh();
    tile->getElevationLayer()->setLocator(new OwnLocator(*tile->getElevationLayer()->getLocator()));
    EXPECT_FALSE(surfaceOf(*tile).bin.valid()) << "it may place what it likes";
    struct OwnLayer : osgTerrain::HeightFieldLayer {
        explicit OwnLayer(osgTerrain::HeightFieldLayer& other) : osgTerrain::HeightFieldLayer(other.getHeightField()) {
            setLocator(other.getLocator());
        }
    };
    tile = fresh();
    tile->setElevationLayer(new OwnLayer(static_cast<osgTerrain::HeightFieldLayer&>(*tile->getElevationLayer())));
    EXPECT_FALSE(surfaceOf(*tile).bin.valid()) << "it may have any heights";
    tile = fresh();
    EXPECT_FALSE(tileSurface(*tile, *kModel, osg::Matrixd::translate(1, 0, 0)).bin.valid());
    const osg::ref_ptr<osg::EllipsoidModel> moon = new osg::EllipsoidModel(1737400.0, 1736000.0);
    EXPECT_FALSE(tileSurface(*tile, *moon, osg::Matrixd()).bin.valid());
}

TEST(TileSurface, NeitherTraversesNorChangesATerrainTile) {
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    const auto tile = makeTerrainTile(GeodeticBin::fromDegrees({0, 45}, {0, 90}, {0, 0}), 8, 8,
                                      [](unsigned int, unsigned int) { return 100.0f; });
    ASSERT_TRUE(surfaceOf(*tile).bin.valid());
    EXPECT_NE(surfaceFingerprint(*tile, osg::Matrixd()), 0u);
    EXPECT_EQ(tile->getTerrainTechnique(), nullptr);
    terrain->addChild(tile);
    (void)drawnTriangles(*terrain);
    EXPECT_EQ(tile->getTerrain(), terrain.get());
}

}  // namespace
}  // namespace osgAnalyticBin::test::surfaces
