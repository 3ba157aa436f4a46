// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Indices of maps. Oracle: the heights that the map was made of, and the triangles of its tiles.

#include "BinconvRuns.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/TileFinder.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>
#include <osgDB/WriteFile>

#include <PagedFlight.h>
#include <PlanarMap.h>
#include <cmath>
#include <filesystem>
#include <support/Random.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

using core::Interval;

class MapIndex : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        _map.isTerrain = std::string(GetParam()) == "terrain";
        _file = _folder / "map.osgb";
        ASSERT_TRUE(osgDB::writeNodeFile(*_map.build(_folder.path()), _file));
        EXPECT_EQ(runIndex(_file).text, "");
        _index = indexOf(_file);
    }

    TemporaryFolder _folder;
    PlanarMap _map;
    std::string _file;
    osg::ref_ptr<BinIndex> _index;
};

TEST_P(MapIndex, HoldsTheHeightsOfAllTiles) {
    EXPECT_EQ(_index->tileCount(), 1u + 4u + 16u + 64u);
    const auto expectHolds = [](const Interval& outer, double lower, double upper, double room) {
        EXPECT_LE(outer.lower, lower);
        EXPECT_GT(outer.lower, lower - room);
        EXPECT_GE(outer.upper, upper);
        EXPECT_LT(outer.upper, upper + room);
    };
    constexpr double kUnits = core::Ellipsoid::kMapUnitsInRadian;
    // all levels have the peaks and pits of the finest; skirts of the border hang below
    const double skirt = 0.02 * std::sqrt(0.5) * _map.size;
    for (const auto& [file, tiles] : _index->files()) {
        for (const BinIndex::Entry& tile : tiles) {
            ASSERT_TRUE(tile.bin.valid()) << file;
            EXPECT_LT(tile.bin.margin(), 3.0);
            expectHolds(tile.bin.bin().altitude(), 0.0, 2600.0, skirt + 1.0);
        }
    }
    const core::GeodeticBin& root = _index->find("", 0)->bin.bin();
    expectHolds({kUnits * root.longitude().lower, kUnits * root.longitude().upper}, _map.origin.x(),
                _map.origin.x() + _map.size, 0.01);
    expectHolds({kUnits * root.latitude().lower, kUnits * root.latitude().upper}, _map.origin.y(),
                _map.origin.y() + _map.size, 0.01);
}

TEST_P(MapIndex, AgreesWithItsMapAndIsNotTakenForAGlobe) {
    EXPECT_EQ(runBinconv("--quiet --check " + test::quoted(_file)).code, 0);
    expectFailure(runBinconv("--quiet " + test::quoted(_file) + ' ' + test::quoted(_folder / "copy.osgb")),
                  "is a map, whose bins cannot be stored");
    // the same meshes below another coordinate system are other tiles
    const auto tiles = findTiles(*_map.mesh(0, 0, 0));
    EXPECT_TRUE(tiles.empty());
    const osg::ref_ptr<osg::CoordinateSystemNode> root = _map.build(_folder.path());
    FoundTile tile = findTiles(*root).front();
    const std::uint64_t inMap = tileFingerprint(tile);
    EXPECT_EQ(_index->find("", 0)->fingerprint, inMap);
    tile.frame.ellipsoid = new osg::EllipsoidModel;
    EXPECT_NE(tileFingerprint(tile), inMap);
}

TEST_P(MapIndex, IsPrintedInMetres) {
    const std::string command = "--print " + test::quoted(_file + ".bins");
    const Outcome printed = runBinconv(command);
    EXPECT_EQ(printed.code, 0) << printed.text;
    EXPECT_NE(printed.text.find("8000 .. 64000 m in a map, some 4 levels"), std::string::npos) << printed.text;
    std::filesystem::remove(_file);
    const Outcome alone = runBinconv(command);
    EXPECT_EQ(alone.code, 0) << alone.text;
    EXPECT_NE(alone.text.find("unknown without \"map.osgb\""), std::string::npos) << alone.text;
}

// Without the index, tiles are as high as all terrain on earth.
TEST_P(MapIndex, CullsAsDeclaredHeightsDoWithoutAny) {
    const osg::ref_ptr<osg::Group> plain = _map.build(_folder.path());
    const osg::ref_ptr<osg::Group> indexed = _map.build(_folder.path());
    ASSERT_EQ(installBins(*indexed, optionsOf("occlusion=off"), _file), 1u);
    PagedFlight spheres(*plain), bins(*indexed);
    Random random(4820);
    std::size_t withSpheres = 0, withBins = 0;
    for (int i = 0; i < 40; ++i) {
        const auto place = [&](double height) {
            return _map.origin + osg::Vec3d(_map.size * random.uniform(), _map.size * random.uniform(), height);
        };
        const osg::Vec3d eye = place(random.uniform(3000.0, 8000.0));
        const CullView view = CullView::lookAt(eye, place(0.0), {0, 0, 1}, random.uniform(10.0, 60.0));
        ASSERT_TRUE(spheres.load(view));
        ASSERT_TRUE(bins.load(view));
        EXPECT_LE(bins.drawn().size(), spheres.drawn().size());
        withSpheres += spheres.drawn().size();
        withBins += bins.drawn().size();
    }
    EXPECT_GT(withBins, 100u);
    EXPECT_LT(withBins, withSpheres);
}

INSTANTIATE_TEST_SUITE_P(Makes, MapIndex, ::testing::Values("terrain", "polygonal"),
                         [](const auto& suite) { return std::string(suite.param); });

}  // namespace
}  // namespace osgAnalyticBin::test
