// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseFolder.h"

#include "Failure.h"
#include "RecordStream.h"
#include "TileBuilder.h"

#include <cpl_string.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace osgbindem {

namespace fs = std::filesystem;
namespace support = osgAnalyticBin::support;
using osgAnalyticBin::RecordReader;
using osgAnalyticBin::RecordWriter;
using osgAnalyticBin::support::writeFile;

namespace {

// Behind the name of what is not complete.
constexpr const char* kPartial = ".partial";
constexpr const char* kState = "state";

// A folder holds the files of this many levels and one folder for each tile of the next: 341 files, 1024 folders.
constexpr int kLevelsPerFolder = 5;

/// The folder, below that of all tiles, with the file of a tile's children.
std::string folderOf(const TileId& tile) {
    std::string folder = startName(tile);
    for (int level = kLevelsPerFolder; level <= tile.level; level += kLevelsPerFolder)
        folder += "/" + tileName(tile.ancestor(level));
    return folder;
}

/// Files are named for the south-western of the four tiles in them.
std::string fileOf(const TileId& tile) {
    return tileName(tile.children()[0]) + ".osgb";
}

void moveTo(const std::string& from, const std::string& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) throw Failure("cannot rename \"" + from + "\" to \"" + to + "\": " + error.message());
}

/// A second name for a file; a copy where the file system has no such names.
void takeFile(const std::string& from, const std::string& to) {
    std::error_code error;
    support::makeFolder(fs::path(to).parent_path().string());
    fs::remove(to, error);
    fs::create_hard_link(from, to, error);
    if (error) fs::copy_file(from, to, error);
    if (error) throw Failure("cannot copy \"" + from + "\" to \"" + to + "\": " + error.message());
}

}  // namespace

std::uint64_t fileChecksum(const TileId& tile, std::string_view content) {
    return osgAnalyticBin::checksumOf(tileName(tile) + ' ' + std::to_string(osgAnalyticBin::checksumOf(content)));
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

std::string TileFiles::childrenFile(const TileId& tile, bool isInRoot) const {
    const std::string file = fileOf(tile);
    if (isInRoot) return _finalName + "/" + folderOf(tile) + "/" + file;
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
    support::makeFolder(folder);
    support::writeFile(folder + "/" + fileOf(tile), bytes);
}

std::uint64_t TileFiles::checksumBelow(const TileId& tile) const {
    support::throwIfStopRequested();
    if (!hasChildren(tile)) return 0;
    std::uint64_t sum = fileChecksum(tile, support::contentOf(pathOfChildren(tile)));
    if (tile.level + 1 >= TileLayout::kDeepest) return sum;
    for (const TileId& child : tile.children()) sum += checksumBelow(child);
    return sum;
}

void TileFiles::takeBelow(const TileId& tile, const TileFiles& from) const {
    support::throwIfStopRequested();
    if (!from.hasChildren(tile)) return;
    takeFile(from.pathOfChildren(tile), pathOfChildren(tile));
    if (tile.level + 1 >= TileLayout::kDeepest) return;
    for (const TileId& child : tile.children()) takeBelow(child, from);
}

DatabaseFolder::DatabaseFolder(const std::string& rootFile)
    : _rootFile(rootFile),
      _tilesName(fs::path(rootFile).stem().string() + "_tiles"),
      _tiles((fs::path(rootFile).parent_path() / _tilesName).string()),
      _partial(_tiles + kPartial),
      _old(_tiles + ".old"),
      _files(_partial, _tilesName),
      _standingFiles(_tiles, _tilesName) {
    const fs::path path(rootFile);
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw Failure("no folder \"" + folder + "\" for the database; create it first");
    if (fs::is_directory(path, error))
        throw Failure("the output \"" + rootFile + "\" is a folder; name a file that ends in .osgb");
    for (const std::string& replaced : {_tiles, _partial, _old}) requireOwnFolder(replaced);
}

DatabaseFolder::~DatabaseFolder() {
    if (!_lock) return;
    std::error_code ignored;
    if (doneCount() == 0) fs::remove_all(_partial, ignored);
    fs::remove(_rootFile + kPartial, ignored);
    _lock->remove();
}

void DatabaseFolder::requireOwnFolder(const std::string& folder) const {
    // The folder is going to be replaced: it must hold tiles and nothing of anybody else's.
    std::error_code error;
    if (!fs::exists(folder, error)) return;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (!isStartName(name) && name != kState)
            throw Failure("\"" + folder + "\" has files that are no tiles; move it away or choose another name");
    }
    if (error) throw Failure("cannot look into \"" + folder + "\": " + error.message() + "; choose another name");
}

void DatabaseFolder::lock() {
    _lock.emplace(_tiles + ".lock", "osgbindem", _rootFile);
    remove(_old);  // a run was killed when its database was complete, or all but its last file
}

bool DatabaseFolder::isComplete() const {
    std::error_code ignored;
    return fs::exists(_rootFile, ignored);
}

void DatabaseFolder::requireNone() const {
    if (!isComplete()) return;
    throw Failure("\"" + _rootFile + "\" is there already; give --overwrite, --update or another name");
}

void DatabaseFolder::remove(const std::string& folder) const {
    std::error_code error;
    fs::remove_all(folder, error);
    if (error) throw Failure("cannot remove \"" + folder + "\": " + error.message() + "; remove it");
}

void DatabaseFolder::clear() {
    // The state goes first: without it, nobody takes what is left for anything.
    remove(_partial + "/" + kState);
    remove(_partial);
}

std::string DatabaseFolder::sourcesIn(const std::string& folder) {
    return folder + "/" + kState + "/sources.txt";
}

std::string DatabaseFolder::recordIn(const std::string& folder, const TileId& tile) {
    return folder + "/" + kState + "/" + startName(tile) + "/" + tileName(tile) + ".task";
}

void DatabaseFolder::beginState(const std::string& sources) const {
    support::makeFolder(_partial + "/" + kState);
    writeFile(sourcesIn(_partial), sources);
}

std::size_t DatabaseFolder::doneCount() const {
    std::size_t count = 0;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(_partial + "/" + kState, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().extension() == ".task") ++count;
    }
    return count;
}

void DatabaseFolder::keep(const SurveyedTile& tile) const {
    RecordWriter out;
    out.list(packed(tile.grid));
    out.value<TileFigures>(tile);
    const std::string file = recordIn(_partial, tile.id);
    support::makeFolder(fs::path(file).parent_path().string());
    writeFile(file, out.finish());
}

std::optional<SurveyedTile> DatabaseFolder::find(const TileId& tile, const TileLayout& layout) const {
    const std::string bytes = support::contentOf(recordIn(_partial, tile));
    SurveyedTile found;
    std::string grid;
    try {
        RecordReader in(bytes);
        in.list(grid);
        in.value<TileFigures>(found);
        if (!in.isAtEnd()) return std::nullopt;
    } catch (const std::out_of_range&) {
        return std::nullopt;
    }
    const auto known = osgAnalyticBin::unpacked(grid);
    if (!known || known->cells != layout.cells()) return std::nullopt;
    found.id = tile;
    found.grid = *known;
    return found;
}

bool DatabaseFolder::takeOver(const TileId& tile) const {
    const std::string record = recordIn(_tiles, tile);
    if (!fs::exists(record)) return false;
    if (fs::exists(recordIn(_partial, tile))) return true;
    _files.takeBelow(tile, _standingFiles);
    takeFile(record, recordIn(_partial, tile));
    return true;
}

void DatabaseFolder::complete(const std::string& rootBytes) {
    writeFile(_rootFile + kPartial, rootBytes);
    support::flushToDisk(_partial);
    std::error_code error;
    fs::remove(_rootFile, error);
    if (error) throw Failure("cannot replace \"" + _rootFile + "\": " + error.message());
    if (fs::exists(_tiles)) moveTo(_tiles, _old);
    moveTo(_partial, _tiles);
    moveTo(_rootFile + kPartial, _rootFile);
    fs::remove_all(_old, error);
}

}  // namespace osgbindem
