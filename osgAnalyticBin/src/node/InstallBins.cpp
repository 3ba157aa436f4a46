// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Database.h"
#include "DatabaseCallbacks.h"

#include <osgAnalyticBin/BinInstaller.h>

#include <osg/CoordinateSystemNode>
#include <osg/Notify>

namespace osgAnalyticBin {

std::size_t setCullOptions(osg::Node& node, const CullOptions& options) {
    BinInstaller installer(options);
    installer._keepsDatabases = true;
    node.accept(installer);
    return installer.installed();
}

std::size_t installBins(osg::Node& node, const CullOptions& options) {
    return installBins(node, options, {});
}

std::size_t installBins(osg::Node& node, const CullOptions& options, const std::string& databaseFileName,
                        const osgDB::Options* readOptions) {
    BinInstaller installer(options);
    osg::ref_ptr<BinIndex> index;
    if (options.index && !databaseFileName.empty()) {
        std::string error;
        index = readBinIndex(databaseFileName, readOptions, error);
        if (!error.empty()) OSG_WARN << "osgAnalyticBin: " << error << std::endl;
        installer.setIndex(index.get());
    }
    const bool isGlobe = dynamic_cast<osg::CoordinateSystemNode*>(&node) != nullptr;
    if (!isGlobe) detachDatabase(node);
    node.accept(installer);
    // Tiles that no CoordinateSystemNode stands above are brought up to date from here.
    if (!isGlobe && installer._installed > 0 && installer._database) attachUpdate(node, *installer._database);
    OSG_INFO << "osgAnalyticBin: " << installer.installed() << " tiles with " << toText(options) << std::endl;
    return installer.installed();
}

}  // namespace osgAnalyticBin
