// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tries the zip for Windows: writes a small database, opens it through the plugin, culls it, waits until the kit has
// made an index, writes a node with a bin to files, and reads it back.
//     osganalyticbin_windows_trial FOLDER
// Exit code: 0 if all this worked.

#include "DatabaseFixture.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <support/AnyScene.h>
#include <support/SyntheticDatabase.h>

namespace {

using namespace osgAnalyticBin;

osg::ref_ptr<osg::Node> read(const std::string& file) {
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
    if (!node) throw std::runtime_error(file + " cannot be read");
    return node;
}

// Counts nodes whose cull callback is a bin's.
unsigned int binsOf(osg::Node& scene) {
    unsigned int bins = 0;
    test::visitNodes(scene, [&bins](osg::Node& node) {
        if (dynamic_cast<const AnalyticBinCullCallback*>(node.getCullCallback())) ++bins;
    });
    return bins;
}

void openDatabase(const std::string& folder) {
    const std::string file = test::writeSyntheticDatabase(folder);
    if (file.empty()) throw std::runtime_error("no database can be written to " + folder);
    std::cout << "wrote " << file << std::endl;
    const osg::ref_ptr<osg::Node> scene = read(file + ".analyticbin");
    std::cout << "bins: " << binsOf(*scene) << std::endl;
    if (binsOf(*scene) == 0) throw std::runtime_error("the plugin installed no bins");

    const test::CullView view = test::CullView::lookAt({7.0e6, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 60.0);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    const test::CullResult result = test::cull(*scene, view, *visitor);
    const BinStatistics* const statistics = BinStatistics::find(*visitor);
    if (!statistics) throw std::runtime_error("no bin was tested");
    const BinCounts counts = statistics->getCounts();
    std::cout << "drawn: " << result.drawn.size() << ", tested: " << counts.tested << ", culled: " << counts.outside
              << ", of these behind the horizon: " << counts.hidden << std::endl;
    if (result.drawn.empty() || counts.outside == 0) throw std::runtime_error("nothing is drawn, or nothing culled");
}

// A thread of the kit makes the index of a database without stored bins.
void makeIndex(const std::string& folder) {
    const std::string file = test::writeMeshDatabase(folder, 700.0, 900.0);
    const osg::ref_ptr<osg::Node> scene = read(file + ".analyticbin");
    constexpr double kMostSeconds = 60.0;
    if (!waitForIndex(*scene, kMostSeconds)) throw std::runtime_error("no index was made");
    if (isIndexAwaited(*read(file + ".analyticbin"))) throw std::runtime_error("the index was not kept");
    std::cout << "index kept" << std::endl;
}

void keepBin(const std::string& folder, const std::string& extension) {
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    const AnalyticBin bin(core::GeodeticBin::fromDegrees({47.0, 48.0}, {11.0, 12.0}, {500.0, 3000.0}));
    tile->setCullCallback(new AnalyticBinCullCallback(bin, osg::EllipsoidModel()));
    const std::string file = folder + "/bin." + extension;
    if (!osgDB::writeNodeFile(*tile, file)) throw std::runtime_error(file + " cannot be written");
    const osg::ref_ptr<osg::Node> copy = read(file);
    const auto* const callback = dynamic_cast<const AnalyticBinCullCallback*>(copy->getCullCallback());
    if (!callback || callback->getBin() != bin) throw std::runtime_error("the bin in " + file + " is another one");
    std::cout << "bin in ." << extension << ": " << callback->getBin().toText() << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 2) throw std::runtime_error("name a folder");
        openDatabase(argv[1]);
        makeIndex(argv[1]);
        keepBin(argv[1], "osgt");
        keepBin(argv[1], "osgb");
        return EXIT_SUCCESS;
    } catch (const std::exception& error) {
        std::cerr << "osganalyticbin_windows_trial: " << error.what() << std::endl;
        return EXIT_FAILURE;
    }
}
