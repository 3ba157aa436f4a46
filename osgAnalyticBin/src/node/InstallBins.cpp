// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/BinInstaller.h>

#include <osg/Notify>

namespace osgAnalyticBin {

std::size_t setCullOptions(osg::Node& node, const CullOptions& options) {
    BinInstaller installer(options);
    installer._keepsDatabases = true;
    installer.installAt(node);
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
    installer.installAt(node);
    OSG_INFO << "osgAnalyticBin: " << installer.installed() << " tiles with " << toText(options) << std::endl;
    return installer.installed();
}

}  // namespace osgAnalyticBin
