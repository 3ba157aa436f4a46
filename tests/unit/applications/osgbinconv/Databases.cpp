// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Databases.h"

#include <osg/CoordinateSystemNode>
#include <osgDB/WriteFile>

#include <DatabaseFixture.h>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin::test {

namespace {

namespace fs = std::filesystem;

std::string writeBindemDatabase(const TemporaryFolder& folder) {
    std::ostringstream grid;
    grid << "ncols 144\nnrows 72\nxllcorner -180\nyllcorner -90\ncellsize 2.5\n";
    for (int i = 0; i < 72 * 144; ++i)
        grid << std::round(2000.0 * std::sin(0.3 * (i / 144)) * std::cos(0.4 * (i % 144))) << ' ';
    const Outcome made = runStock(quoted({OSGBINDEM_PROGRAM, "--quiet", "--levels", "1", "--cells", "8",
                                          folder.write("heights.asc", grid.str()), "-o", folder / "earth.osgb"}),
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
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    root->addChild(&tile);
    writeFile(path, *root);
}

}  // namespace osgAnalyticBin::test
