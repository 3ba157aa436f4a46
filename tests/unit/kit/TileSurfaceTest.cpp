// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle of surfaces: samples of the triangles that osgTerrain::GeometryTechnique itself makes of a tile, taken back to
// latitude, longitude and altitude.

#include "TileSurfaceCases.h"

namespace osgAnalyticBin::test::surfaces {
namespace {

osg::ref_ptr<osgTerrain::TerrainTile> randomTile(const TileCase& c, Random& random) {
    const double low = random.uniform(-11000.0, 8000.0), high = random.uniform(low, 8800.0);
    return makeTerrainTile(c.extents, c.columns, c.rows, [&](unsigned int, unsigned int) {
        return static_cast<float>(random.chance(0.2) ? low : random.uniform(low, high));
    });
}

osg::ref_ptr<osgTerrain::TerrainTile> makePlainTile() {
    return makeTerrainTile(GeodeticBin::fromDegrees({0, 45}, {0, 90}, {0, 0}), 8, 8,
                           [](unsigned int, unsigned int) { return 100.0f; });
}

TEST(TileSurface, HoldsEveryTriangleOfATerrainTileTightly) {
    Random random(1);
    for (const TileCase& c : tileCases()) {
        for (const float scale : {1.0f, 3.0f, 0.25f, 10.0f, -2.0f}) {
            const auto tile = randomTile(c, random);
            const TileSurface surface = surfaceOf(*tile);
            ASSERT_TRUE(surface.bin.valid()) << c.name;
            EXPECT_TRUE(surface.isScalable);
            EXPECT_EQ(surface.skirt, 0.0);
            const auto samples = samplesOf(drawnTriangles(*tile, scale).surface, scale == 1.0f ? 6 : 3);
            ASSERT_FALSE(samples.empty());
            const AnalyticBin bin = surface.bin.exaggerated(static_cast<double>(scale));
            const double margin = bin.margin();
            EXPECT_LE(metresOutside(bin, samples, kEllipsoid), margin) << c.name << " scale " << scale;
            if (scale != 1.0f) continue;
            const core::Interval seen = altitudesOf(samples);
            EXPECT_LE(bin.bin().altitude().upper, seen.upper + margin) << c.name;
            // the lowest post need not stand where chords sag most
            EXPECT_LE(seen.lower - bin.bin().altitude().lower, bin.sag() + margin) << c.name;
            EXPECT_EQ(bin.bin().longitude(), c.extents.longitude()) << c.name;
            // chords run poleward by at most a sixteenth of the squared width of a column, in radians, at 45 degrees
            const double column = c.extents.longitude().width() / (c.columns - 1), run = 0.07 * column * column + 1e-12;
            EXPECT_LE(bin.bin().latitude().upper - c.extents.latitude().upper, run);
            EXPECT_LE(c.extents.latitude().lower - bin.bin().latitude().lower, run);
            EXPECT_LE(margin, 2.0);
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
}

TEST(TileSurface, KnowsATileWithoutHeights) {
    const auto tile = makePlainTile();
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

// Before they are scaled or after.
TEST(TileSurface, KnowsTheSkirtsOfTerrainTiles) {
    Random random(6);
    for (const TileCase& c : tileCases()) {
        for (const float skirt : {40.0f, 4000.0f, 1e6f}) {
            const auto tile = randomTile(c, random);
            heightsOf(*tile).setSkirtHeight(skirt);
            const TileSurface surface = surfaceOf(*tile);
            EXPECT_EQ(surface.skirt, static_cast<double>(skirt));
            for (const float scale : {2.0f, 1.0f, 0.25f, 0.0f, -1.0f}) {
                const DrawnTriangles drawn = drawnTriangles(*tile, scale);
                ASSERT_FALSE(drawn.skirts.empty());
                const AnalyticBin bin = surface.bin.exaggerated(static_cast<double>(scale));
                EXPECT_LE(metresOutside(bin, samplesOf(drawn.surface, 1), kEllipsoid), bin.margin()) << c.name;
                for (const AnalyticBin& whole :
                     {bin.withSkirts(surface.skirt),
                      surface.bin.withSkirts(surface.skirt).exaggerated(static_cast<double>(scale))})
                    EXPECT_LE(metresOutside(whole, samplesOf(drawn.skirts, 3), kEllipsoid), whole.margin())
                        << c.name << " scale " << scale << " skirt " << skirt;
            }
        }
    }
}

struct OwnLocator : osgTerrain::Locator {
    explicit OwnLocator(const osgTerrain::Locator& other) : osgTerrain::Locator(other) {}
};
struct OwnLayer : osgTerrain::HeightFieldLayer {
    explicit OwnLayer(osgTerrain::HeightFieldLayer& other) : osgTerrain::HeightFieldLayer(other.getHeightField()) {
        setLocator(other.getLocator());
    }
};
struct OwnTechnique : osgTerrain::GeometryTechnique {};

// Classes of the application's may place what they like, and have any heights.
TEST(TileSurface, IsUnknownWhereTheTileIsBroken) {
    using Layer = osgTerrain::HeightFieldLayer;
    using Limits = std::numeric_limits<float>;
    const std::function<void(osgTerrain::TerrainTile&, Layer&)> breaks[] = {
        [](auto&, auto& layer) { layer.getHeightField()->setHeight(3, 3, Limits::quiet_NaN()); },
        [](auto&, auto& layer) { layer.getHeightField()->setHeight(3, 3, Limits::infinity()); },
        [](auto&, auto& layer) { layer.getHeightField()->getHeightList().resize(63); },
        [](auto&, auto& layer) { layer.getLocator()->setCoordinateSystemType(osgTerrain::Locator::GEOGRAPHIC); },
        [](auto&, auto& layer) { layer.getLocator()->setTransform(osg::Matrixd::rotate(0.5, 0, 0, 1)); },
        [](auto&, auto& layer) { layer.getLocator()->setTransformAsExtents(0, 0, 90, 45); },  // degrees
        [](auto&, auto& layer) { layer.setLocator(new OwnLocator(*layer.getLocator())); },
        [](auto& tile, auto&) { tile.setTerrainTechnique(new OwnTechnique); },
        [](auto& tile, auto& layer) { tile.setElevationLayer(new OwnLayer(layer)); }};
    for (std::size_t i = 0; i < std::size(breaks); ++i) {
        const auto tile = makePlainTile();
        ASSERT_TRUE(surfaceOf(*tile).bin.valid());
        breaks[i](*tile, static_cast<Layer&>(*tile->getElevationLayer()));
        EXPECT_FALSE(surfaceOf(*tile).bin.valid()) << i;
    }
    EXPECT_FALSE(tileSurface(*makePlainTile(), *kModel, osg::Matrixd::translate(1, 0, 0)).bin.valid());
    EXPECT_FALSE(tileSurface(*makePlainTile(), osg::EllipsoidModel(1737400.0, 1736000.0), osg::Matrixd()).bin.valid());
}

TEST(TileSurface, NeitherTraversesNorChangesATerrainTile) {
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    const auto tile = makePlainTile();
    ASSERT_TRUE(surfaceOf(*tile).bin.valid());
    EXPECT_NE(surfaceFingerprint(*tile, osg::Matrixd()), 0u);
    EXPECT_EQ(tile->getTerrainTechnique(), nullptr);
    terrain->addChild(tile);
    (void)drawnTriangles(*terrain);
    EXPECT_EQ(tile->getTerrain(), terrain.get());
}

osg::ref_ptr<osgTerrain::TerrainTile> makeTile() {
    return makeTerrainTile(core::GeodeticBin::fromDegrees({0, 45}, {0, 90}, {0, 0}), 17, 13,
                           [](unsigned int i, unsigned int j) { return static_cast<float>(100 * i + j); });
}

osg::ref_ptr<osg::Geometry> makeMesh() {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec2Array> texCoords = new osg::Vec2Array;
    const osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (int i = 0; i < 50; ++i) {
        vertices->push_back(osg::Vec3(6378137.0f, 7.0f * static_cast<float>(i), static_cast<float>(i * i)));
        texCoords->push_back(osg::Vec2(0.02f * static_cast<float>(i), 0.5f));
        for (int k = 0; k < 3; ++k) triangles->push_back(static_cast<GLushort>((i + k) % 50));
    }
    geometry->setVertexArray(vertices);
    geometry->setTexCoordArray(0, texCoords);
    geometry->addPrimitiveSet(triangles);
    return geometry;
}

std::uint64_t fingerprintOf(osg::Node& node) {
    return surfaceFingerprint(node, osg::Matrixd());
}

// Indexes keep fingerprints: a change of the function is a change of their format.
TEST(SurfaceFingerprint, StaysAsItIs) {
    EXPECT_EQ(fingerprintOf(*makeTile()), 3446540989968547260u);
    EXPECT_EQ(fingerprintOf(*makeMesh()), 1996310240858576859u);
    const osg::ref_ptr<osg::Group> empty = new osg::Group;
    EXPECT_NE(fingerprintOf(*empty), 0u);
}

TEST(SurfaceFingerprint, TellsEveryPostOfATerrainTile) {
    std::set<std::uint64_t> seen{fingerprintOf(*makeTile())};
    const auto expectNew = [&seen](const std::function<void(osgTerrain::TerrainTile&, osg::HeightField&)>& change) {
        const auto tile = makeTile();
        auto& layer = static_cast<osgTerrain::HeightFieldLayer&>(*tile->getElevationLayer());
        change(*tile, *layer.getHeightField());
        EXPECT_TRUE(seen.insert(fingerprintOf(*tile)).second);
    };
    using Tile = osgTerrain::TerrainTile;
    for (unsigned int i = 0; i < 17; ++i)
        for (unsigned int j = 0; j < 13; ++j)
            expectNew([=](Tile&, auto& heights) { heights.setHeight(i, j, -heights.getHeight(i, j) - 0.001f); });
    expectNew([](Tile& tile, auto&) { tile.getElevationLayer()->getLocator()->setTransformAsExtents(0, 0, 1, 1); });
    expectNew([](Tile&, auto& heights) { heights.setSkirtHeight(1.0f); });
    for (const float noData : {-1.0f, 3.0f, 4.0f}) {
        expectNew([=](Tile& tile, auto&) {
            tile.getElevationLayer()->setValidDataOperator(new osgTerrain::NoDataValue(noData));
        });
    }
    expectNew([](Tile& tile, auto&) {
        tile.getElevationLayer()->getLocator()->setEllipsoidModel(new osg::EllipsoidModel(6378137.0, 6356752.0));
    });
    EXPECT_TRUE(seen.insert(surfaceFingerprint(*makeTile(), osg::Matrixd::translate(0, 0, 1))).second);
}

TEST(SurfaceFingerprint, TellsEveryVertexAndIndexOfAMesh) {
    std::set<std::uint64_t> seen{fingerprintOf(*makeMesh())};
    for (unsigned int i = 0; i < 50; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto mesh = makeMesh();
            float& value = verticesOf(*mesh)[i][axis];
            value = std::nextafter(value, 1e9f);
            EXPECT_TRUE(seen.insert(fingerprintOf(*mesh)).second);
        }
        const auto mesh = makeMesh();
        static_cast<osg::DrawElementsUShort&>(*mesh->getPrimitiveSet(0))[3 * i] = 49;
        EXPECT_EQ(seen.insert(fingerprintOf(*mesh)).second, i != 49);
    }
}

TEST(SurfaceFingerprint, TellsWhereABillboardsDrawablesStand) {
    const osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
    for (int i = 0; i < 3; ++i) billboard->addDrawable(makeMesh(), osg::Vec3(1.0f, 2.0f, 3.0f));
    std::set<std::uint64_t> seen{fingerprintOf(*billboard)};
    for (unsigned int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            billboard->getPositionList()[i][axis] += 1.0f;
            EXPECT_TRUE(seen.insert(fingerprintOf(*billboard)).second);
        }
    }
    static_cast<osg::Vec3Array&>(*billboard->getDrawable(2)->asGeometry()->getVertexArray())[0].x() += 1.0f;
    EXPECT_TRUE(seen.insert(fingerprintOf(*billboard)).second);
}

TEST(SurfaceFingerprint, TellsSignsThatChangeTogether) {
    std::set<std::uint64_t> seen{fingerprintOf(*makeMesh())};
    for (unsigned int i = 0; i < 50; ++i) {
        for (unsigned int j = i + 1; j < 50; ++j) {
            const auto mesh = makeMesh();
            auto& vertices = verticesOf(*mesh);
            vertices[i] = -vertices[i];
            vertices[j] = -vertices[j];
            EXPECT_TRUE(seen.insert(fingerprintOf(*mesh)).second) << i << " " << j;
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test::surfaces
