// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SmallDatabase.h"

#include <osg/CoordinateSystemNode>
#include <osgDB/WriteFile>

#include <DatabaseFixture.h>
#include <filesystem>
#include <stdexcept>

namespace osgAnalyticBin::test {

osg::ref_ptr<osg::Node> makeSmallTile(const std::string& pagedFile, double westDeg) {
    const osg::ref_ptr<osg::Node> mesh = makeMeshTile(extentsDeg(0, 1, westDeg, westDeg + 1), 100.0, 5);
    if (pagedFile.empty()) return mesh;
    return makePaged(mesh, pagedFile);
}

void writeSmallFile(const std::string& path, osg::Node& tile, bool isRoot) {
    osg::ref_ptr<osg::Node> node = &tile;
    if (isRoot) {
        const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
        root->setEllipsoidModel(new osg::EllipsoidModel);
        root->addChild(&tile);
        node = root;
    }
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    if (!osgDB::writeNodeFile(*node, path)) throw std::runtime_error("cannot write " + path);
}

}  // namespace osgAnalyticBin::test
