// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Bins on the tiles of an application's own scene graph.

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBins.h>

#include <osg/CoordinateSystemNode>
#include <osg/Group>

#include <cstdlib>

int main() {
    using namespace osgAnalyticBin;
    osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    osg::ref_ptr<osg::Group> tile = new osg::Group;
    setStoredBin(*tile, AnalyticBin(core::GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 8848.0})));
    globe->addChild(tile);
    return installBins(*globe) == 1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
