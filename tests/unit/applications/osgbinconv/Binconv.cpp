// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Binconv.h"

#include "TestRaster.h"

#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <glm/geometric.hpp>
#include <osg/CoordinateSystemNode>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgTerrain/TerrainTile>

#include <DatabaseFixture.h>
#include <TileFixture.h>
#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin::test {

namespace {

namespace fs = std::filesystem;

std::string writeBindemDatabase(const TemporaryFolder& folder) {
    const std::string globe = TestRaster::globe(2.5, hills).write(folder / "heights.tif");
    const Outcome made = runStock(
        quoted({OSGBINDEM_PROGRAM, "--quiet", "--levels", "1", "--cells", "8", globe, "-o", folder / "earth.osgb"}),
        Modules::Present);
    return made.code == 0 ? folder / "earth.osgb" : std::string();
}

}  // namespace

bool isAtHand(const std::string& kind) {
    return kind == "synthetic" || kind == "bindem" || fs::exists(SAMPLE_DATA "/vpb/" + kind);
}

std::string makeDatabase(const std::string& kind, const TemporaryFolder& folder) {
    if (kind == "synthetic") return writeSyntheticDatabase(folder.path());
    if (kind == "bindem") return writeBindemDatabase(folder);
    fs::copy(SAMPLE_DATA "/vpb/" + kind, folder.path(), fs::copy_options::recursive);
    return folder / "earth.osgb";
}

osg::ref_ptr<osg::Node> makeSmallTile(const std::string& pagedFile, double westDeg) {
    const osg::ref_ptr<osg::Node> mesh = makeMeshTile(extentsDeg(0, 1, westDeg, westDeg + 1), 100.0, 5);
    if (pagedFile.empty()) return mesh;
    return makePaged(mesh, pagedFile);
}

void writeFile(const std::string& path, osg::Node& tile) {
    fs::create_directories(fs::path(path).parent_path());
    if (!osgDB::writeNodeFile(tile, path)) throw std::runtime_error("cannot write " + path);
}

void writeRoot(const std::string& path, osg::Node& tile) {
    writeFile(path, *makeGlobe({&tile}));
}

namespace {

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

DrawnTile drawn(const FoundTile& tile) {
    DrawnTile result;
    result.file = tile.frame.file;
    result.ordinal = tile.ordinal;
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

class Reader {
public:
    explicit Reader(const std::string& rootFile) : _folder(osgDB::getFilePath(rootFile)) {}

    void read(const std::string& path, const TileFrame& frame, const std::vector<std::size_t>& above) {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(path);
        if (!node) throw std::runtime_error("cannot read " + path);
        for (const FoundTile& tile : findTiles(*node, frame)) {
            tiles.push_back(drawn(tile));
            tiles.back().ancestors = above;
            std::vector<std::size_t> line{tiles.size() - 1};
            line.insert(line.end(), above.begin(), above.end());
            for (const std::string& file : tile.pagedFiles) {
                TileFrame below = tile.frame;
                below.file = file;
                below.isBelowTile = true;
                read(_folder + "/" + file, below, line);
            }
        }
    }

    std::vector<DrawnTile> tiles;

private:
    std::string _folder;
};

}  // namespace

core::Ellipsoid ellipsoidOfTests() {
    return {osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR};
}

std::vector<DrawnTile> readAllTiles(const std::string& rootFile) {
    Reader reader(rootFile);
    reader.read(rootFile, {}, {});
    return std::move(reader.tiles);
}

}  // namespace osgAnalyticBin::test
