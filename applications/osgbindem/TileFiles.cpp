// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileFiles.h"

#include "Checksum.h"
#include "Failure.h"
#include "Interruption.h"
#include "ModuleFolder.h"
#include "TextFile.h"

#include <cpl_string.h>
#include <osg/Group>
#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>

#include <cstdio>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace osgbindem {

namespace fs = std::filesystem;
using osgAnalyticBin::support::checksumOf;
using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

// A folder holds the files of this many levels and one folder for each tile of the next: 341 files, 1024 folders.
constexpr int kLevelsPerFolder = 5;

/// The folder, below that of all tiles, with the file of a tile's children.
std::string folderOf(const TileId& tile) {
    std::string folder = startName(tile);
    for (int level = kLevelsPerFolder; level <= tile.level; level += kLevelsPerFolder) {
        folder += "/" + tileName(tile.ancestor(level));
    }
    return folder;
}

/// Files are named for the south-western of the four tiles in them.
std::string fileOf(const TileId& tile) {
    return tileName(tile.children()[0]) + ".osgb";
}

}  // namespace

std::uint64_t fileChecksum(const TileId& tile, std::string_view content) noexcept {
    const int place[] = {tile.level, tile.x, tile.y};
    return checksumOf(content, checksumOf({reinterpret_cast<const char*>(place), sizeof place}));
}

std::string startName(const TileId& tile) {
    const TileId start = tile.ancestor(0);
    return CPLSPrintf("X%02d_Y%d", start.x, start.y);
}

bool isStartName(const std::string& name) {
    int x = 0;
    int y = 0;
    return std::sscanf(name.c_str(), "X%2d_Y%1d", &x, &y) == 2 && name == startName({0, x, y});
}

std::string tileName(const TileId& tile) {
    return CPLSPrintf("L%02d_X%d_Y%d", tile.level, tile.x, tile.y);
}

TileFiles::TileFiles(std::string folder, std::string finalName, int startLevel)
    : _folder(std::move(folder)), _finalName(std::move(finalName)), _startLevel(startLevel) {}

std::string TileFiles::childrenFile(const TileId& tile) const {
    const std::string file = fileOf(tile);
    if (tile.level == _startLevel) return _finalName + "/" + folderOf(tile) + "/" + file;
    return tile.level % kLevelsPerFolder == 0 ? tileName(tile) + "/" + file : file;
}

std::string TileFiles::pathOfChildren(const TileId& tile) const {
    return _folder + "/" + folderOf(tile) + "/" + fileOf(tile);
}

bool TileFiles::hasChildren(const TileId& tile) const {
    std::error_code error;
    return fs::exists(pathOfChildren(tile), error);
}

void TileFiles::writeChildren(const TileId& tile, const std::string& bytes) const {
    const std::string folder = _folder + "/" + folderOf(tile);
    osgAnalyticBin::support::makeFolder(folder);
    osgAnalyticBin::support::writeFile(folder + "/" + fileOf(tile), bytes);
}

std::uint64_t TileFiles::checksumBelow(const TileId& tile) const {
    throwIfStopRequested();
    if (!hasChildren(tile)) return 0;
    std::uint64_t sum = fileChecksum(tile, osgAnalyticBin::support::contentOf(pathOfChildren(tile)));
    if (tile.level + 1 >= TileLayout::kDeepest) return sum;
    for (const TileId& child : tile.children()) sum += checksumBelow(child);
    return sum;
}

void prepareNodeFiles() {
    osgAnalyticBin::addModuleFolder();
    for (const char* name : {"osg::Group", "osgAnalyticBin::InstallBinsCallback", "osgAnalyticBin::PackedTerrain"}) {
        if (osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(name) == nullptr) {
            throw Failure(std::string("OpenSceneGraph finds no serializer for ") + name +
                          "; install this library's modules or set OSG_LIBRARY_PATH");
        }
    }
    (void)nodeFileBytes(*osg::ref_ptr<osg::Node>(new osg::Group), true);
}

std::string nodeFileBytes(const osg::Node& node, bool compress) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setPluginStringData("fileType", "Binary");
    options->setPluginStringData("WriteImageHint", "IncludeData");
    if (compress) options->setPluginStringData("Compressor", "zlib");
    osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
    if (writer == nullptr)
        throw Failure("OpenSceneGraph's plugin for .osgb is missing; install it or set OSG_LIBRARY_PATH");
    std::ostringstream stream;
    const osgDB::ReaderWriter::WriteResult result = writer->writeNode(node, stream, options);
    if (!result.success() || !stream) throw Failure("OpenSceneGraph cannot store a tile: " + result.message());
    return stream.str();
}

}  // namespace osgbindem
