// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseFolder.h"

#include "Failure.h"
#include "NodeFile.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace fs = std::filesystem;

namespace {

// A folder holds the files of this many levels and one folder for each tile of the next: 341 files, 1024 folders.
constexpr int kLevelsPerFolder = 5;

std::string text(const char* format, int a, int b, int c = 0) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, a, b, c);
    return buffer;
}

std::string startFolder(const TileId& tile) {
    const TileId start = tile.ancestor(0);
    return text("X%02d_Y%d", start.x, start.y);
}

bool isStartFolder(const std::string& name) {
    int x = 0;
    int y = 0;
    return std::sscanf(name.c_str(), "X%2d_Y%1d", &x, &y) == 2 && name == startFolder({0, x, y});
}

std::string levelFolder(const TileId& tile) {
    return text("L%02d_X%d_Y%d", tile.level, tile.x, tile.y);
}

/// The folder, below that of all tiles, with the file of a tile's children.
std::string folderOf(const TileId& tile) {
    std::string folder = startFolder(tile);
    for (int level = kLevelsPerFolder; level <= tile.level; level += kLevelsPerFolder) {
        folder += "/" + levelFolder(tile.ancestor(level));
    }
    return folder;
}

/// Files are named for the south-western of the four tiles in them.
std::string fileOf(const TileId& tile) {
    const TileId child = tile.children()[0];
    return text("L%02d_X%d_Y%d.osgb", child.level, child.x, child.y);
}

void moveTo(const std::string& from, const std::string& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) throw Failure("cannot rename \"" + from + "\" to \"" + to + "\": " + error.message());
}

}  // namespace

DatabaseFolder::DatabaseFolder(const std::string& rootFile) : _rootFile(rootFile) {
    const fs::path path(rootFile);
    _tilesName = path.stem().string() + "_tiles";
    _tiles = (path.parent_path() / _tilesName).string();
    _partial = _tiles + ".partial";
    _old = _tiles + ".old";
    _lockFile = _tiles + ".lock";
    _newRoot = rootFile + ".partial";
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        throw Failure("no folder \"" + folder.string() + "\" for the database; create it first");
    }
    if (fs::is_directory(path, error)) {
        throw Failure("the output \"" + rootFile + "\" is a folder; name a file that ends in .osgb");
    }
    requireOwnFolder(_tiles);
    lock();
    for (const std::string& left : {_partial, _old}) {
        requireOwnFolder(left);
        fs::remove_all(left, error);
        if (error) throw Failure("cannot remove \"" + left + "\": " + error.message() + "; remove it");
    }
    fs::create_directory(_partial, error);
    if (error) throw Failure("cannot create \"" + _partial + "\": " + error.message() + "; choose another folder");
}

DatabaseFolder::~DatabaseFolder() {
    std::error_code ignored;
    if (_lock >= 0) {
        fs::remove_all(_partial, ignored);
        fs::remove(_newRoot, ignored);
        ::unlink(_lockFile.c_str());
        ::close(_lock);
    }
}

void DatabaseFolder::requireOwnFolder(const std::string& folder) const {
    // The folder is going to be replaced: it must hold tiles and nothing of anybody else's.
    std::error_code error;
    if (!fs::exists(folder, error)) return;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (!isStartFolder(entry.path().filename().string())) {
            throw Failure("\"" + folder + "\" has files that are no tiles; move it away or choose another name");
        }
    }
    if (error) throw Failure("cannot look into \"" + folder + "\": " + error.message() + "; choose another name");
}

void DatabaseFolder::lock() {
    _lock = ::open(_lockFile.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (_lock < 0) {
        const std::error_code error(errno, std::generic_category());
        throw Failure("cannot write to the folder of \"" + _rootFile + "\": " + error.message() +
                      "; choose another folder");
    }
    struct stat held {};
    struct stat named {};
    const bool isLocked = ::flock(_lock, LOCK_EX | LOCK_NB) == 0;
    // The other program may have removed the file between the two calls above.
    const bool isSame = ::fstat(_lock, &held) == 0 && ::stat(_lockFile.c_str(), &named) == 0 &&
                        held.st_ino == named.st_ino && held.st_dev == named.st_dev;
    if (!isLocked || !isSame) {
        ::close(_lock);
        _lock = -1;
        throw Failure("another osgbindem is writing \"" + _rootFile + "\"; wait for it or choose another name");
    }
}

std::string DatabaseFolder::childrenFile(const TileId& tile) const {
    const std::string file = fileOf(tile);
    if (tile.level == 0) return _tilesName + "/" + folderOf(tile) + "/" + file;
    return tile.level % kLevelsPerFolder == 0 ? levelFolder(tile) + "/" + file : file;
}

void DatabaseFolder::writeChildren(const TileId& tile, const std::string& bytes) const {
    const std::string folder = _partial + "/" + folderOf(tile);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Failure("cannot create \"" + folder + "\": " + error.message() + "; make room");
    writeFile(folder + "/" + fileOf(tile), bytes);
}

void DatabaseFolder::complete(const std::string& rootBytes) {
    writeFile(_newRoot, rootBytes);
    std::error_code error;
    fs::remove(_rootFile, error);
    if (error) throw Failure("cannot replace \"" + _rootFile + "\": " + error.message());
    if (fs::exists(_tiles)) moveTo(_tiles, _old);
    moveTo(_partial, _tiles);
    moveTo(_newRoot, _rootFile);
    fs::remove_all(_old, error);
}

}  // namespace osgbindem
