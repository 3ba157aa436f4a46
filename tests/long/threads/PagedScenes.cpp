// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PagedScenes.h"

#include "TileFixture.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/PagedLOD>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cmath>
#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin::test {

namespace {

constexpr int kColumns = 8;
constexpr int kRows = 4;
constexpr unsigned int kPosts = 9;

// Tiles of that many degrees by row and column from the south-west.
osg::ref_ptr<osgTerrain::TerrainTile> tileAt(int level, int row, int column) {
    const double width = 360.0 / kColumns / (1 << level);
    const double south = -90.0 + row * width;
    const double west = -180.0 + column * width;
    const auto extents = core::GeodeticBin::fromDegrees({south, south + width}, {west, west + width}, {0.0, 0.0});
    osg::ref_ptr<osgTerrain::TerrainTile> tile =
        makeTerrainTile(extents, kPosts, kPosts, [&](unsigned int i, unsigned int j) {
            const double x = (west + i * width / (kPosts - 1)) * 0.2;
            const double y = (south + j * width / (kPosts - 1)) * 0.3;
            return static_cast<float>(2000.0 * std::sin(x) * std::sin(y));
        });
    tile->setTileID(osgTerrain::TileID(level, column, row));
    return tile;
}

std::string quartersOf(int row, int column) {
    return "quarters_" + std::to_string(row) + "_" + std::to_string(column) + ".osgb";
}

bool writeQuarters(const std::string& folder, int row, int column) {
    const osg::ref_ptr<osg::Group> quarters = new osg::Group;
    for (int i = 0; i < 4; ++i) quarters->addChild(tileAt(1, 2 * row + i / 2, 2 * column + i % 2));
    return osgDB::writeNodeFile(*quarters, folder + "/" + quartersOf(row, column));
}

osg::ref_ptr<osg::PagedLOD> pagedTile(int row, int column) {
    const osg::ref_ptr<osgTerrain::TerrainTile> mesh = tileAt(0, row, column);
    const osg::BoundingSphere sphere =
        AnalyticBin(core::GeodeticBin::fromDegrees({-90.0 + 45.0 * row, -45.0 + 45.0 * row},
                                                   {-180.0 + 45.0 * column, -135.0 + 45.0 * column}, {0.0, 0.0}))
            .boundingSphere(osg::EllipsoidModel());
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    paged->setCenter(sphere.center());
    paged->setRadius(sphere.radius());
    const float cutoff = 2.0f * sphere.radius();
    paged->addChild(mesh, cutoff, 1e10f);
    paged->setFileName(1, quartersOf(row, column));
    paged->setRange(1, 0.0f, cutoff);
    return paged;
}

// Bins that end far below the tiles of the file.
bool belie(const std::string& file) {
    const osg::ref_ptr<osg::Node> content = osgDB::readRefNodeFile(file);
    if (!content) return false;
    for (unsigned int i = 0; i < content->asGroup()->getNumChildren(); ++i) {
        osg::Node& tile = *content->asGroup()->getChild(i);
        AnalyticBin bin = storedBin(tile);
        bin.setBin(bin.bin().withAltitude({-60000.0, -50000.0}));
        setStoredBin(tile, bin);
    }
    return osgDB::writeNodeFile(*content, file);
}

}  // namespace

std::string writeFalseDatabase(const std::string& folder) {
    const std::string root = writeSyntheticDatabase(folder);
    if (root.empty()) return {};
    for (const std::string& name : osgDB::getDirectoryContents(folder)) {
        const bool isBelowRoot = name.rfind("tiles_0_", 0) == 0;
        if (isBelowRoot && !belie(folder + "/" + name)) return {};
    }
    return root;
}

std::string writeTerrainDatabase(const std::string& folder) {
    const osg::ref_ptr<osgTerrain::Terrain> root = new osgTerrain::Terrain;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            root->addChild(pagedTile(row, column));
            if (!writeQuarters(folder, row, column)) return {};
        }
    }
    const std::string file = folder + "/terrain.osgb";
    return osgDB::writeNodeFile(*root, file) ? file : std::string();
}

}  // namespace osgAnalyticBin::test
