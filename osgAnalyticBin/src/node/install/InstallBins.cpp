// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../boxes/BoxInstaller.h"
#include "../page/Database.h"
#include "BinInstaller.h"
#include "MeshCulling.h"
#include "TileCallback.h"

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/PhotogrammetrySet.h>

#include <osg/NodeCallback>
#include <osg/Notify>
#include <osg/PagedLOD>
#include <osg/ValueObject>
#include <osgTerrain/TerrainTile>

#include <typeinfo>

namespace osgAnalyticBin {

namespace {

constexpr const char* kTraversesAlways = "osgAnalyticBin.traversesAlways";

std::size_t install(osg::Node& node, const CullOptions& options, const BinIndex* index) {
    BinInstaller installer(options);
    installer.setIndex(index);
    installer.installAt(node);
    OSG_INFO << "osgAnalyticBin: " << installer.installed() << " tiles with " << toText(options) << std::endl;
    return installer.installed();
}

// What looks like a tile, where nobody looks for tiles.
bool hasTileBelow(osg::Node& subgraph) {
    bool has = false;
    forEachNode(subgraph, [&has](osg::Node& node) {
        has = has || hasStoredBin(node) || dynamic_cast<osg::PagedLOD*>(&node) ||
              dynamic_cast<osgTerrain::TerrainTile*>(&node);
    });
    return has;
}

}  // namespace

// Culled by boxes of its vertices, whatever stands around it.
void BinInstaller::visitSet(osg::Group& set) {
    if (_options.method == Method::Sphere) return removeBoxes(set);
    _boxes += installBoxes(set, _options);
}

void BinInstaller::visitMoving(osg::Transform& node) {
    if (isPhotogrammetrySet(node)) return visitSet(node);
    removeCallbacksBelow(node);
    if (installsBins() && hasTileBelow(node)) database().noteStrayTile(frame().file);
}

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
    osg::ref_ptr<BinIndex> index;
    if (options.index && !databaseFileName.empty()) {
        std::string error;
        index = readBinIndex(databaseFileName, readOptions, error);
        if (!error.empty()) OSG_WARN << "osgAnalyticBin: " << error << std::endl;
    }
    return install(node, options, index.get());
}

std::size_t installBinsByIndex(osg::Node& node, const CullOptions& options, const BinIndex& index) {
    return install(node, options, &index);
}

void setTraversesAlways(osg::Callback& callback) {
    callback.setUserValue(kTraversesAlways, true);
}

bool traversesAlways(const osg::Callback& callback) {
    bool does = typeid(callback) == typeid(osg::NodeCallback);
    if (!does) (void)callback.getUserValue(kTraversesAlways, does);
    return does;
}

}  // namespace osgAnalyticBin
