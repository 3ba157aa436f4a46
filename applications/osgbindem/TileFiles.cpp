// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileFiles.h"

#include "Checksum.h"
#include "Interruption.h"
#include "TextFile.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

namespace osgbindem {

using osgAnalyticBin::support::checksumOf;
using osgAnalyticBin::support::throwIfStopRequested;

namespace fs = std::filesystem;

namespace {

// A folder holds the files of this many levels and one folder for each tile of the next: 341 files, 1024 folders.
constexpr int kLevelsPerFolder = 5;

std::string text(const char* format, int a, int b, int c = 0) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, a, b, c);
    return buffer;
}

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

void FileSum::add(const TileId& tile, std::string_view content) noexcept {
    ++files;
    bytes += content.size();
    const int place[] = {tile.level, tile.x, tile.y};
    checksum += checksumOf(content, checksumOf({reinterpret_cast<const char*>(place), sizeof place}));
}

std::string startName(const TileId& tile) {
    const TileId start = tile.ancestor(0);
    return text("X%02d_Y%d", start.x, start.y);
}

bool isStartName(const std::string& name) {
    int x = 0;
    int y = 0;
    return std::sscanf(name.c_str(), "X%2d_Y%1d", &x, &y) == 2 && name == startName({0, x, y});
}

std::string tileName(const TileId& tile) {
    return text("L%02d_X%d_Y%d", tile.level, tile.x, tile.y);
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

FileSum TileFiles::sumBelow(const TileId& tile) const {
    FileSum sum;
    addBelow(tile, sum);
    return sum;
}

void TileFiles::addBelow(const TileId& tile, FileSum& sum) const {
    throwIfStopRequested();
    if (!hasChildren(tile)) return;
    sum.add(tile, osgAnalyticBin::support::contentOf(pathOfChildren(tile)));
    if (tile.level + 1 >= TileLayout::kDeepest) return;
    for (const TileId& child : tile.children()) addBelow(child, sum);
}

}  // namespace osgbindem
