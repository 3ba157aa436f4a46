// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileFixture.h"

#include <osg/PagedLOD>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin::test {

// Writes the synthetic database, and edits the tiles of all files, or of those below the root's tiles alone.
// Returns: the root's file; empty when something cannot be written.
inline std::string writeEdited(const std::string& folder, const std::string& files,
                               const std::function<void(osg::PagedLOD& tile)>& edit) {
    const std::string rootFile = writeSyntheticDatabase(folder);
    for (const std::string& name : osgDB::getDirectoryContents(folder)) {
        if (name[0] == '.' || name.rfind(files, 0) != 0) continue;
        const osg::ref_ptr<osg::Node> content = osgDB::readRefNodeFile(folder + "/" + name);
        if (!content) return {};
        for (unsigned int i = 0; i < content->asGroup()->getNumChildren(); ++i)
            edit(dynamic_cast<osg::PagedLOD&>(*content->asGroup()->getChild(i)));
        if (!osgDB::writeNodeFile(*content, folder + "/" + name)) return {};
    }
    return rootFile;
}

// Puts an osgTerrain tile in the place of the mesh, and takes the stored bin away.
inline void makeTerrain(osg::PagedLOD& tile) {
    constexpr unsigned int kPosts = 9;
    const core::GeodeticBin extents = storedBin(tile).bin().withAltitude({0.0, 0.0});
    const osg::ref_ptr<osgTerrain::TerrainTile> terrain =
        makeTerrainTile(extents, kPosts, kPosts, [&](unsigned int i, unsigned int j) {
            const double x = extents.longitude().lower + i * extents.longitude().width() / (kPosts - 1);
            const double y = extents.latitude().lower + j * extents.latitude().width() / (kPosts - 1);
            return static_cast<float>(2000.0 * std::sin(11.0 * x) * std::sin(17.0 * y));
        });
    const double width = extents.longitude().width();
    const auto place = [width](const core::Interval& range, double from) {
        return static_cast<int>(std::floor((range.middle() + from) / width));
    };
    terrain->setTileID(osgTerrain::TileID(static_cast<int>(std::lround(std::log2(0.25 * osg::PI / width))),
                                          place(extents.longitude(), osg::PI), place(extents.latitude(), osg::PI_2)));
    tile.setChild(0, terrain);
    tile.setUserDataContainer(nullptr);
}

/// The globe of writeSyntheticDatabase(), but with stored bins that are too low for the meshes in the files below the
/// root: they are widened when the tiles are loaded. Returns: the database's file; empty when it cannot be written.
[[nodiscard]] inline std::string writeFalseDatabase(const std::string& folder) {
    return writeEdited(folder, "tiles_0_", [](osg::PagedLOD& tile) {
        AnalyticBin bin = storedBin(tile);
        bin.setBin(bin.bin().withAltitude({-60000.0, -50000.0}));
        setStoredBin(tile, bin);
    });
}

/// The globe of writeSyntheticDatabase() as osgTerrain tiles with 9 x 9 posts, without stored bins. Its root is an
/// osgTerrain::Terrain. Returns: the database's file; empty when it cannot be written.
[[nodiscard]] inline std::string writeTerrainDatabase(const std::string& folder) {
    const std::string file = writeEdited(folder, "", makeTerrain);
    const osg::ref_ptr<osg::Node> globe = osgDB::readRefNodeFile(file);
    if (!globe) return {};
    const osg::ref_ptr<osgTerrain::Terrain> root = new osgTerrain::Terrain;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    for (unsigned int i = 0; i < globe->asGroup()->getNumChildren(); ++i) root->addChild(globe->asGroup()->getChild(i));
    return osgDB::writeNodeFile(*root, file) ? file : std::string();
}

}  // namespace osgAnalyticBin::test
