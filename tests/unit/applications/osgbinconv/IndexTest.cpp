// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What osgbinconv puts into an index, for databases of four makes and for maps. Oracles: samples of the triangles that
// OpenSceneGraph draws, tile by tile; the heights that a map was made of.

#include "Binconv.h"

#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <osgDB/FileNameUtils>

#include <PlanarMap.h>

namespace osgAnalyticBin::test {
namespace {

// A tile of a database, as OpenSceneGraph reads it.
struct DrawnTile {
    std::string file;
    std::size_t ordinal = 0;
    // Indices of all tiles above it, the nearest first.
    std::vector<std::size_t> ancestors;
    // Metres that its skirts hang down.
    double skirt = 0.0;
    double low = 0.0;
    double high = 0.0;
    std::uint64_t fingerprint = 0;
    // All vertices that it draws itself, those of skirts included.
    std::vector<glm::dvec3> samples;
};

std::vector<EcefTriangle> trianglesOf(const FoundTile& tile) {
    std::vector<EcefTriangle> result;
    for (const auto& mesh : tile.meshes) {
        const auto* terrain = dynamic_cast<const osgTerrain::TerrainTile*>(mesh.get());
        const DrawnTriangles drawn =
            terrain ? drawnTriangles(*terrain, 1.0f) : drawnTriangles(*mesh, tile.frame.localToEcef);
        result.insert(result.end(), drawn.surface.begin(), drawn.surface.end());
        result.insert(result.end(), drawn.skirts.begin(), drawn.skirts.end());
    }
    return result;
}

DrawnTile drawn(const FoundTile& tile, const std::vector<std::size_t>& ancestors) {
    DrawnTile result;
    result.file = tile.frame.file;
    result.ordinal = tile.ordinal;
    result.ancestors = ancestors;
    AnalyticBin bin;
    for (const auto& mesh : tile.meshes) {
        const TileSurface surface = tileSurface(*mesh, *tile.frame.ellipsoid, tile.frame.localToEcef);
        bin.expandBy(surface.bin);
        result.skirt = std::max(result.skirt, surface.skirt);
    }
    result.low = bin.bin().altitude().lower;
    result.high = bin.bin().altitude().upper;
    result.fingerprint = surfaceFingerprint(*tile.meshes.front(), tile.frame.localToEcef);
    result.samples = samplesOf(trianglesOf(tile), 1);
    return result;
}

// Whether there is such a database: samples of VirtualPlanetBuilder's may be missing.
bool isAtHand(const std::string& kind) {
    return kind == "synthetic" || kind == "bindem" || std::filesystem::exists(SAMPLE_DATA "/vpb/" + kind);
}

class Index : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (!isAtHand(GetParam())) GTEST_SKIP() << GetParam() << " is not there";
        _database = makeDatabase(GetParam(), _folder);
        expectSuccess(runIndex(_database));
        _index = indexOf(_database);
        readTiles(_database, {}, {});
        ASSERT_FALSE(_tiles.empty());
    }

    // All tiles of a file and of those below it, each file read by its name.
    void readTiles(const std::string& path, const TileFrame& frame, const std::vector<std::size_t>& above) {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(path);
        ASSERT_TRUE(node) << path;
        for (const FoundTile& tile : findTiles(*node, frame)) {
            _tiles.push_back(drawn(tile, above));
            std::vector<std::size_t> line{_tiles.size() - 1};
            line.insert(line.end(), above.begin(), above.end());
            for (const std::string& file : tile.pagedFiles) {
                TileFrame below = tile.frame;
                below.file = file;
                below.isBelowTile = true;
                readTiles(osgDB::getFilePath(_database) + "/" + file, below, line);
            }
        }
    }

    [[nodiscard]] const BinIndex::Entry& entryOf(const DrawnTile& tile) const {
        const BinIndex::Entry* entry = _index->find(tile.file, tile.ordinal);
        static const BinIndex::Entry kNone;
        EXPECT_TRUE(entry) << tile.file;
        return entry ? *entry : kNone;
    }

    // The entry is the tile's own, and holds what it draws; so do those of all tiles above it.
    void expectHolds(const DrawnTile& tile) const {
        const BinIndex::Entry& own = entryOf(tile);
        EXPECT_EQ(own.fingerprint, tile.fingerprint) << tile.file;
        EXPECT_NE(tile.fingerprint, 0u);
        EXPECT_TRUE(own.bin.valid());
        EXPECT_LE(own.ownLow, tile.low);
        EXPECT_GT(own.ownLow, tile.low - 0.1);
        ASSERT_FALSE(tile.samples.empty());
        ASSERT_LE(metresOutside(own.bin, tile.samples, _wgs84), own.bin.margin()) << tile.file;
        for (const std::size_t above : tile.ancestors) {
            const AnalyticBin& bin = entryOf(_tiles[above]).bin;
            EXPECT_TRUE(bin.contains(own.bin)) << tile.file;
            ASSERT_LE(metresOutside(bin, tile.samples, _wgs84), bin.margin())
                << tile.file << " in " << _tiles[above].file;
        }
    }

    // No higher than the highest descendant, and no deeper than skirts.
    void expectTight() const {
        std::vector<double> high, low;
        for (const DrawnTile& tile : _tiles) {
            high.push_back(tile.high);
            low.push_back(tile.low - tile.skirt);
            for (const std::size_t above : tile.ancestors) {
                high[above] = std::max(high[above], high.back());
                low[above] = std::min(low[above], low.back());
            }
        }
        for (std::size_t i = 0; i < _tiles.size(); ++i) {
            const core::Interval& altitude = entryOf(_tiles[i]).bin.bin().altitude();
            EXPECT_LT(altitude.upper, high[i] + 0.1) << _tiles[i].file;
            EXPECT_GT(altitude.lower, low[i] - 0.1) << _tiles[i].file;
        }
    }

    const core::Ellipsoid _wgs84{osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR};
    TemporaryFolder _folder;
    std::string _database;
    osg::ref_ptr<BinIndex> _index;
    std::vector<DrawnTile> _tiles;
};

TEST_P(Index, HoldsWhatItsDatabaseDrawsAndLittleElse) {
    EXPECT_EQ(_index->tileCount(), _tiles.size());
    EXPECT_EQ(_index->source().name, std::filesystem::path(_database).filename());
    EXPECT_EQ(_index->source().size, std::filesystem::file_size(_database));
    for (const DrawnTile& tile : _tiles) expectHolds(tile);
    expectTight();
}

INSTANTIATE_TEST_SUITE_P(Makes, Index, ::testing::Values("synthetic", "bindem", "terrain", "polygonal"),
                         [](const auto& suite) { return std::string(suite.param); });

using core::Interval;

class MapIndex : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        _map.isTerrain = std::string(GetParam()) == "terrain";
        ASSERT_TRUE(osgDB::writeNodeFile(*_map.build(_folder.path()), _file));
        expectSuccess(runIndex(_file));
        _index = indexOf(_file);
    }

    const TemporaryFolder _folder;
    PlanarMap _map;
    const std::string _file = _folder / "map.osgb";
    osg::ref_ptr<BinIndex> _index;
};

TEST_P(MapIndex, HoldsTheHeightsOfAllTiles) {
    EXPECT_EQ(_index->tileCount(), 1u + 4u + 16u + 64u);
    const auto expectHolds = [](const Interval& outer, double unit, double lower, double upper, double room) {
        EXPECT_LE(unit * outer.lower, lower);
        EXPECT_GT(unit * outer.lower, lower - room);
        EXPECT_GE(unit * outer.upper, upper);
        EXPECT_LT(unit * outer.upper, upper + room);
    };
    // all levels have the peaks and pits of the finest; skirts hang below
    const double skirt = 0.02 * std::sqrt(0.5) * _map.size;
    for (const auto& [file, tiles] : _index->files()) {
        for (const BinIndex::Entry& tile : tiles) {
            ASSERT_TRUE(tile.bin.valid()) << file;
            EXPECT_LT(tile.bin.margin(), 3.0);
            expectHolds(tile.bin.bin().altitude(), 1.0, 0.0, 2600.0, skirt + 1.0);
        }
    }
    constexpr double kUnits = core::Ellipsoid::kMapUnitsInRadian;
    const core::GeodeticBin& root = _index->find("", 0)->bin.bin();
    expectHolds(root.longitude(), kUnits, _map.origin.x(), _map.origin.x() + _map.size, 0.01);
    expectHolds(root.latitude(), kUnits, _map.origin.y(), _map.origin.y() + _map.size, 0.01);
}

TEST_P(MapIndex, AgreesWithItsMapAndIsNotTakenForAGlobe) {
    EXPECT_EQ(runBinconv({"--quiet", "--check", _file}).code, 0);
    // the same meshes below another coordinate system are other tiles
    EXPECT_TRUE(findTiles(*_map.mesh(0, 0, 0)).empty());
    FoundTile tile = findTiles(*_map.build(_folder.path())).front();
    const std::uint64_t inMap = tileFingerprint(tile);
    EXPECT_EQ(_index->find("", 0)->fingerprint, inMap);
    tile.frame.ellipsoid = new osg::EllipsoidModel;
    EXPECT_NE(tileFingerprint(tile), inMap);
}

INSTANTIATE_TEST_SUITE_P(Makes, MapIndex, ::testing::Values("terrain", "polygonal"),
                         [](const auto& suite) { return std::string(suite.param); });

}  // namespace
}  // namespace osgAnalyticBin::test
