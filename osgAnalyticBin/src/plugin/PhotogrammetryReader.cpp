// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PhotogrammetryReader.h"

#include "SetPlacement.h"

#include <osgAnalyticBin/PhotogrammetrySet.h>
#include <osgAnalyticBin/TileFile.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/CoordinateSystemNode>
#include <osg/MatrixTransform>
#include <osg/Notify>
#include <osgDB/FileNameUtils>

#include <exception>
#include <vector>

namespace osgAnalyticBin::plugin {

namespace {

using ReadResult = osgDB::ReaderWriter::ReadResult;

osg::ref_ptr<osg::Node> readTile(const std::string& path, const osgDB::Options* options) {
    try {
        ReadResult result = readTileFile(path, options);
        return result.getNode();
    } catch (const std::exception&) {
        return nullptr;
    }
}

void warnOfMissing(const std::string& metadataFile, const std::vector<std::string>& missing, const char* what) {
    if (missing.empty()) return;
    OSG_WARN << "analyticbin: \"" << metadataFile << "\": " << missing.size() << ' ' << what << ", the first is \""
             << missing.front() << "\"; the set is shown without them." << std::endl;
}

// Returns: nullptr when no tile can be read.
osg::ref_ptr<osg::MatrixTransform> readTiles(const std::string& metadataFile, const PhotogrammetryFiles& files,
                                             const osgDB::Options* options) {
    const osg::ref_ptr<osg::MatrixTransform> set = new osg::MatrixTransform;
    std::vector<std::string> broken;
    for (const std::string& file : files.roots) {
        const std::string path = osgDB::concatPaths(osgDB::getFilePath(metadataFile), file);
        const osg::ref_ptr<osg::Node> tile = readTile(path, options);
        if (!tile) {
            broken.push_back(file);
            continue;
        }
        setPhotogrammetryFile(*tile, file);
        set->addChild(tile);
    }
    warnOfMissing(metadataFile, files.withoutRoot, "folders have no root file");
    warnOfMissing(metadataFile, broken, "root files cannot be read");
    return set->getNumChildren() > 0 ? set : nullptr;
}

// On the globe, where the metadata say where.
ReadResult placed(const std::string& metadataFile, const PhotogrammetryMetadata& metadata, osg::MatrixTransform& set) {
    if (metadata.srs.empty()) {
        OSG_WARN << "analyticbin: \"" << metadataFile
                 << "\" has no SRS; the set is shown in its own coordinates, not on a globe." << std::endl;
        return &set;
    }
    osg::ComputeBoundsVisitor bounds;
    set.accept(bounds);
    std::string error;
    const osg::BoundingBox& box = bounds.getBoundingBox();
    const auto placement = placementOf(metadata, box.valid() ? osg::Vec3d(box.center()) : osg::Vec3d(), error);
    if (!placement) return ReadResult("analyticbin: \"" + metadataFile + "\": " + error);
    if (!placement->warning.empty())
        OSG_WARN << "analyticbin: \"" << metadataFile << "\": " << placement->warning << '.' << std::endl;
    set.setMatrix(placement->localToEcef);
    const osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    globe->setEllipsoidModel(new osg::EllipsoidModel);
    globe->addChild(&set);
    return globe.get();
}

}  // namespace

ReadResult readPhotogrammetrySet(const std::string& metadataFile, const osgDB::Options* options) {
    std::string error;
    const auto metadata = readPhotogrammetryMetadata(metadataFile, error);
    if (!metadata) return ReadResult("analyticbin: " + error);
    const PhotogrammetryFiles files = findPhotogrammetryFiles(metadataFile, error);
    if (files.roots.empty()) return ReadResult("analyticbin: " + error);
    const osg::ref_ptr<osg::MatrixTransform> set = readTiles(metadataFile, files, options);
    if (!set) return ReadResult("analyticbin: no tile of \"" + metadataFile + "\" can be read");
    set->setName(osgDB::getSimpleFileName(osgDB::getFilePath(metadataFile)));
    markPhotogrammetrySet(*set, metadataFile);
    return placed(metadataFile, *metadata, *set);
}

}  // namespace osgAnalyticBin::plugin
