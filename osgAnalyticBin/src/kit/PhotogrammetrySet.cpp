// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/PhotogrammetrySet.h>

#include <osg/ValueObject>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

#include <algorithm>

namespace osgAnalyticBin {

namespace {

constexpr const char* kMetadata = "osgAnalyticBin.photogrammetrySet";
constexpr const char* kFile = "osgAnalyticBin.photogrammetryFile";

std::string valueOf(const osg::Node& node, const char* name) {
    std::string value;
    (void)node.getUserValue(name, value);
    return value;
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

}  // namespace

bool isMetadataName(const std::string& rootFile) {
    return osgDB::getLowerCaseFileExtension(rootFile) == "xml";
}

PhotogrammetryFiles findPhotogrammetryFiles(const std::string& metadataFile, std::string& error) {
    PhotogrammetryFiles found;
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

void markPhotogrammetrySet(osg::Group& set, const std::string& metadataFile) {
    set.setUserValue(kMetadata, metadataFile);
}

bool isPhotogrammetrySet(const osg::Node& node) {
    const osg::UserDataContainer* const values = node.getUserDataContainer();
    return values && node.asGroup() && values->getUserObject(kMetadata);
}

void setPhotogrammetryFile(osg::Node& tile, const std::string& file) {
    tile.setUserValue(kFile, file);
}

std::string metadataFileOf(const osg::Node& set) {
    return valueOf(set, kMetadata);
}

std::string photogrammetryFileOf(const osg::Node& tile) {
    return valueOf(tile, kFile);
}

}  // namespace osgAnalyticBin
