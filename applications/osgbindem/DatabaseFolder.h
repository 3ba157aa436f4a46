// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileLayout.h"

#include <string>

namespace osgbindem {

/// Where the files of a database stand: "earth.osgb" is the root file, its tiles are below "earth_tiles". All tiles are
/// written below "earth_tiles.partial", which takes the place of "earth_tiles" when everything is there; the root file
/// comes last. So a root file always belongs to a complete database, and an older database of the same name stays
/// whole until then. The destructor removes what is not complete.
class DatabaseFolder final {
public:
    /// Locks the database against a second program and clears away what an aborted one has left. Throws Failure.
    explicit DatabaseFolder(const std::string& rootFile);
    DatabaseFolder(const DatabaseFolder&) = delete;
    DatabaseFolder& operator=(const DatabaseFolder&) = delete;
    ~DatabaseFolder();

    /// Name of the file with the children of a tile, seen from the file that has the tile.
    [[nodiscard]] std::string childrenFile(const TileId& tile) const;

    /// Writes the file with the children of a tile; may be called by several threads. Throws Failure.
    void writeChildren(const TileId& tile, const std::string& bytes) const;

    /// Swaps the new database in. Throws Failure.
    void complete(const std::string& rootBytes);

private:
    void lock();
    void requireOwnFolder(const std::string& folder) const;

    std::string _rootFile;
    std::string _newRoot;
    /// Without path.
    std::string _tilesName;
    std::string _tiles;
    std::string _partial;
    std::string _old;
    std::string _lockFile;
    int _lock = -1;
};

}  // namespace osgbindem
