// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TextFile.h"
#include "TileLayout.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace osgbindem {

using namespace osgAnalyticBin::tiles;

/// Of the file with the children of a tile.
[[nodiscard]] std::uint64_t fileChecksum(const TileId& tile, std::string_view content);

/// Name of a start tile, for what is kept apart for each of them: "X03_Y7".
[[nodiscard]] std::string startName(const TileId& tile);
[[nodiscard]] bool isStartName(const std::string& name);

/// Name of a tile: "L07_X12_Y345".
[[nodiscard]] std::string tileName(const TileId& tile);

/// The files with tiles, below one folder. May be used by several threads and programs at once, for different tiles.
class TileFiles final {
public:
    /// `folder`: where they are written; `finalName`: the name, without path, that it is going to have.
    TileFiles(std::string folder, std::string finalName)
        : _folder(std::move(folder)), _finalName(std::move(finalName)) {}

    /// Name of the file with the children of a tile, seen from the file that has the tile, which may be the root file.
    [[nodiscard]] std::string childrenFile(const TileId& tile, bool isInRoot) const;

    /// Writes the file with the children of a tile. Throws Failure.
    void writeChildren(const TileId& tile, const std::string& bytes) const;

    /// The path of that file.
    [[nodiscard]] std::string pathOfChildren(const TileId& tile) const;
    [[nodiscard]] bool hasChildren(const TileId& tile) const;

    /// Reads back all files below a tile. Returns: the sum of their checksums.
    [[nodiscard]] std::uint64_t checksumBelow(const TileId& tile) const;

    /// Takes over all files below a tile, as they are, from another folder. Throws Failure.
    void takeBelow(const TileId& tile, const TileFiles& from) const;

private:
    std::string _folder;
    std::string _finalName;
};

struct SurveyedTile;

/// Where the files of a database stand: "earth.osgb" is the root file, its tiles are below "earth_tiles". All tiles are
/// written below "earth_tiles.partial", which takes the place of "earth_tiles" when everything is there; the root file
/// comes last. So a root file always belongs to a complete database, and an older database of the same name stays
/// whole until then. The folder "state" beside the tiles says what they are built from and holds a record of each task
/// of the work plan, written after the task's tiles: a later run continues with the tasks that have none, programs on
/// several machines share them, and an update keeps the tiles of tasks that have not changed.
class DatabaseFolder final {
public:
    /// Throws Failure when no database can be there.
    explicit DatabaseFolder(const std::string& rootFile);
    /// Removes what is not complete, unless a later run can go on with it.
    ~DatabaseFolder();

    /// Locks the database against a second program, and removes what a finished run has left. Throws Failure.
    void lock();

    /// Requires: locked. Throws Failure when there is a root file already: it belongs to a complete database.
    void requireNone() const;

    /// Requires: locked. Removes what earlier runs have left. Throws Failure.
    void clear();

    [[nodiscard]] const std::string& partial() const { return _partial; }
    [[nodiscard]] const TileFiles& files() const { return _files; }

    /// Whether there is a root file, which belongs to a complete database.
    [[nodiscard]] bool isComplete() const;
    /// The files of the complete database.
    [[nodiscard]] const TileFiles& standingFiles() const { return _standingFiles; }
    /// What the complete database is built from; empty when nobody knows.
    [[nodiscard]] std::string standingSources() const { return osgAnalyticBin::support::contentOf(sourcesIn(_tiles)); }

    /// Whether the state belongs to a database that is built from just this.
    [[nodiscard]] bool isStateOf(const std::string& sources) const {
        return osgAnalyticBin::support::contentOf(sourcesIn(_partial)) == sources;
    }
    /// Requires: there is no state. Throws Failure.
    void beginState(const std::string& sources) const;
    /// How many tasks have records, whole ones or not.
    [[nodiscard]] std::size_t doneCount() const;
    /// Writes the record of a finished task. May be called by several threads, as find() may. Throws Failure.
    void keep(const SurveyedTile& tile) const;
    /// Returns: nullopt when there is no record that is whole.
    [[nodiscard]] std::optional<SurveyedTile> find(const TileId& tile, const TileLayout& layout) const;

    /// Takes over what a task has left in the complete database. Returns: whether that is known. Throws Failure.
    [[nodiscard]] bool takeOver(const TileId& tile) const;

    /// Swaps the new database in. Throws Failure.
    void complete(const std::string& rootBytes);

private:
    void requireOwnFolder(const std::string& folder) const;
    void remove(const std::string& folder) const;
    [[nodiscard]] static std::string sourcesIn(const std::string& folder);
    [[nodiscard]] static std::string recordIn(const std::string& folder, const TileId& tile);

    std::string _rootFile;
    /// Without path.
    std::string _tilesName;
    std::string _tiles;
    std::string _partial;
    std::string _old;
    TileFiles _files;
    TileFiles _standingFiles;
    std::optional<osgAnalyticBin::support::LockedFile> _lock;
};

}  // namespace osgbindem
