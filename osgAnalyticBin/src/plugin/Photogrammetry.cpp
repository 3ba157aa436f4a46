// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Photogrammetry.h"

#include "SetPlacement.h"

#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/TileFile.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/CoordinateSystemNode>
#include <osg/Math>
#include <osg/MatrixTransform>
#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/XmlParser>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <locale>
#include <sstream>
#include <vector>

namespace osgAnalyticBin::plugin {

namespace {

using ReadResult = osgDB::ReaderWriter::ReadResult;

constexpr const char* kEnu = "ENU:";

// What the metadata say.
struct Metadata {
    std::string srs;    // "ENU:LAT,LON", "EPSG:CODE", well-known text; empty: none
    osg::Vec3d origin;  // added to the coordinates of the tiles
};

// Relative to the folder of the metadata, in alphabetical order.
struct TileFiles {
    std::vector<std::string> roots;
    std::vector<std::string> withoutRoot;  // folders in Data
};

const osgDB::XmlNode* childOf(const osgDB::XmlNode& node, const std::string& name) {
    for (const auto& child : node.children) {
        if (child->name == name) return child.get();
    }
    return nullptr;
}

std::string textIn(const osgDB::XmlNode& node, const std::string& name) {
    const osgDB::XmlNode* const child = childOf(node, name);
    return child ? child->getTrimmedContents() : std::string();
}

osg::ref_ptr<osgDB::XmlNode> parsed(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return in ? osgDB::readXmlStream(in) : nullptr;
}

// "1.5, 2,3" makes three numbers. Returns: nullopt unless the text is just `count` finite numbers between commas.
std::optional<osg::Vec3d> numbersFrom(const std::string& text, int count) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    osg::Vec3d numbers;
    for (int i = 0; i < count; ++i) {
        char comma = ',';
        if (i > 0) in >> comma;
        in >> numbers[i];
        if (!in || comma != ',' || !std::isfinite(numbers[i])) return std::nullopt;
    }
    return (in >> std::ws).eof() ? std::optional(numbers) : std::nullopt;
}

std::optional<Metadata> readMetadata(const std::string& path, std::string& error) {
    const osg::ref_ptr<osgDB::XmlNode> root = parsed(path);
    const osgDB::XmlNode* const model = root ? childOf(*root, "ModelMetadata") : nullptr;
    if (!model) {
        error = "\"" + path + "\" is not the metadata of a photogrammetry set: it has no element ModelMetadata";
        return std::nullopt;
    }
    const std::string origin = textIn(*model, "SRSOrigin");
    const auto numbers = numbersFrom(origin.empty() ? "0,0,0" : origin, 3);
    if (numbers) return Metadata{textIn(*model, "SRS"), *numbers};
    error = "\"" + path + "\": SRSOrigin is \"" + origin + "\"; three numbers with commas between are expected";
    return std::nullopt;
}

std::vector<std::string> sortedContent(const std::string& folder) {
    std::vector<std::string> names;
    for (const std::string& name : osgDB::getDirectoryContents(folder)) {
        if (!name.empty() && name.front() != '.') names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool isTileFile(const std::string& name) {
    const std::string extension = osgDB::getLowerCaseFileExtension(name);
    return extension == "osgb" || extension == "osgt" || extension == "osgx" || extension == "ive";
}

// The file that gave the others their names: "Block.osgb" beside "Block_L17_0.osgb". Returns: "" when there is none.
std::string rootFileIn(const std::string& folder) {
    std::vector<std::string> files = sortedContent(folder);
    files.erase(std::remove_if(files.begin(), files.end(), [](const auto& file) { return !isTileFile(file); }),
                files.end());
    const auto stemOf = [](const std::string& file) { return osgDB::getNameLessExtension(file); };
    const std::string named = osgDB::getSimpleFileName(folder);
    for (const std::string& file : files) {
        if (stemOf(file) == named) return file;
    }
    const auto startsAll = [&](const std::string& root) {
        return std::all_of(files.begin(), files.end(),
                           [&](const std::string& file) { return file.rfind(stemOf(root), 0) == 0; });
    };
    const auto root = std::find_if(files.begin(), files.end(), startsAll);
    return root == files.end() ? std::string() : *root;
}

// Returns: no roots when there are none; then `error` says why.
TileFiles findTileFiles(const std::string& metadataFile, std::string& error) {
    TileFiles found;
    const std::string above = osgDB::getFilePath(metadataFile);
    const std::string data = osgDB::concatPaths(above.empty() ? "." : above, "Data");
    if (osgDB::fileType(data) != osgDB::DIRECTORY) {
        error = "there is no folder Data beside \"" + metadataFile + "\"; the tiles are expected there";
        return found;
    }
    for (const std::string& name : sortedContent(data)) {
        const std::string path = osgDB::concatPaths(data, name);
        if (osgDB::fileType(path) != osgDB::DIRECTORY) {
            if (isTileFile(name)) found.roots.push_back("Data/" + name);
            continue;
        }
        const std::string root = rootFileIn(path);
        if (root.empty()) {
            found.withoutRoot.push_back("Data/" + name);
        } else {
            found.roots.push_back("Data/" + name + '/' + root);
        }
    }
    if (found.roots.empty()) error = "\"" + data + "\" holds no tile, as in Data/Tile_+000_+000/Tile_+000_+000.osgb";
    return found;
}

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
osg::ref_ptr<osg::MatrixTransform> readTiles(const std::string& metadataFile, const TileFiles& files,
                                             const osgDB::Options* options) {
    const osg::ref_ptr<osg::MatrixTransform> set = new osg::MatrixTransform;
    std::vector<std::string> broken;
    for (const std::string& file : files.roots) {
        const std::string path = osgDB::concatPaths(osgDB::getFilePath(metadataFile), file);
        const osg::ref_ptr<osg::Node> tile = readTile(path, options);
        if (tile) set->addChild(tile);
        if (!tile) broken.push_back(file);
    }
    warnOfMissing(metadataFile, files.withoutRoot, "folders have no root file");
    warnOfMissing(metadataFile, broken, "root files cannot be read");
    return set->getNumChildren() > 0 ? set : nullptr;
}

// "ENU:LAT,LON" or "ENU:LAT,LON,HEIGHT", in degrees and metres: the plane that touches the ellipsoid there.
std::optional<SetPlacement> enuPlacement(const Metadata& metadata, std::string& error) {
    const std::string text = metadata.srs.substr(std::string(kEnu).size());
    const bool hasHeight = std::count(text.begin(), text.end(), ',') == 2;
    const auto place = numbersFrom(text, hasHeight ? 3 : 2);
    if (!place || std::abs(place->x()) > 90.0 || std::abs(place->y()) > 360.0) {
        error = "the SRS is \"" + metadata.srs + "\"; ENU:LATITUDE,LONGITUDE in degrees is expected";
        return std::nullopt;
    }
    osg::Matrixd enuToEcef;
    osg::EllipsoidModel().computeLocalToWorldTransformFromLatLongHeight(
        osg::DegreesToRadians(place->x()), osg::DegreesToRadians(place->y()), hasHeight ? place->z() : 0.0, enuToEcef);
    return SetPlacement{osg::Matrixd::translate(metadata.origin) * enuToEcef, {}};
}

std::optional<SetPlacement> placementOf(const Metadata& metadata, osg::Node& set, std::string& error) {
    if (metadata.srs.rfind(kEnu, 0) == 0) return enuPlacement(metadata, error);
#ifdef OSGANALYTICBIN_PROJ
    osg::ComputeBoundsVisitor bounds;
    set.accept(bounds);
    const osg::BoundingBox& box = bounds.getBoundingBox();
    return projectedPlacement(metadata.srs, metadata.origin, box.valid() ? osg::Vec3d(box.center()) : osg::Vec3d(),
                              error);
#else
    (void)set;
    error = "the SRS is \"" + metadata.srs + "\", for which this plugin has to be built with PROJ; it is not";
    return std::nullopt;
#endif
}

// On the globe, where the metadata say where.
ReadResult placed(const std::string& metadataFile, const Metadata& metadata, osg::MatrixTransform& set) {
    if (metadata.srs.empty()) {
        OSG_WARN << "analyticbin: \"" << metadataFile
                 << "\" has no SRS; the set is shown in its own coordinates, not on a globe." << std::endl;
        return &set;
    }
    std::string error;
    const auto placement = placementOf(metadata, set, error);
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

bool isPhotogrammetryMetadata(const std::string& path) {
    if (osgDB::getLowerCaseFileExtension(path) != "xml") return false;
    if (osgDB::convertToLowerCase(osgDB::getSimpleFileName(path)) == "metadata.xml") return true;
    const osg::ref_ptr<osgDB::XmlNode> root = parsed(path);
    return root && childOf(*root, "ModelMetadata");
}

ReadResult readPhotogrammetrySet(const std::string& metadataFile, const osgDB::Options* options) {
    std::string error;
    const auto metadata = readMetadata(metadataFile, error);
    if (!metadata) return ReadResult("analyticbin: " + error);
    const TileFiles files = findTileFiles(metadataFile, error);
    if (files.roots.empty()) return ReadResult("analyticbin: " + error);
    const osg::ref_ptr<osg::MatrixTransform> set = readTiles(metadataFile, files, options);
    if (!set) return ReadResult("analyticbin: no tile of \"" + metadataFile + "\" can be read");
    set->setName(osgDB::getSimpleFileName(osgDB::getFilePath(metadataFile)));
    markPhotogrammetrySet(*set);
    return placed(metadataFile, *metadata, *set);
}

}  // namespace osgAnalyticBin::plugin
