// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// An osgViewer application with analytic bins: tutorial DATABASE [--bins OPTIONS]. See tutorial.md.

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osg/ArgumentParser>
#include <osgDB/ReadFile>
#include <osgGA/TerrainManipulator>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <iostream>

int main(int argc, char** argv) {
    osg::ArgumentParser arguments(&argc, argv);
    std::string binsText;
    arguments.read("--bins", binsText);
    std::string error;
    const auto options = osgAnalyticBin::cullOptionsFromText(binsText, error);
    if (!options || arguments.argc() < 2) {
        std::cerr << "tutorial: " << (error.empty() ? "name a database" : error) << std::endl;
        return 1;
    }

    const std::string file = arguments[1];
    osg::ref_ptr<osg::Node> database = osgDB::readRefNodeFile(file);
    if (!database) {
        std::cerr << "tutorial: cannot read " << file << std::endl;
        return 1;
    }
    const std::size_t tiles = osgAnalyticBin::installBins(*database, *options, file);
    std::cout << "bins on " << tiles << " tiles so far" << std::endl;

    osgViewer::Viewer viewer(arguments);
    viewer.setSceneData(database);
    viewer.setCameraManipulator(new osgGA::TerrainManipulator);
    viewer.addEventHandler(new osgViewer::StatsHandler);
    const int code = viewer.run();

    const osgAnalyticBin::BinCounts counts = osgAnalyticBin::binCounts(viewer);
    std::cout << "last frame: " << counts.tested << " tiles tested, " << counts.outside << " culled, " << counts.hidden
              << " of them behind the horizon" << std::endl;
    return code;
}
