// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../index/AutoIndex.h"

#include <osg/Node>
#include <osg/observer_ptr>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

class Database;
struct ParentTile;

/// A tile whose bin is to become that of the index when the index knows it.
struct AwaitingTile {
    osg::observer_ptr<const ParentTile> tile;  // which has a reference to the database
    std::uint64_t fingerprint = 0;
    double skirt = 0.0;    ///< metres, of its own mesh
    bool isPaged = false;  ///< whether files are below it
};

/// The index of a database that is being made, and the tiles that wait for it. Threads: adopt() and setIndex() where no
/// cull traversal runs, the rest at any time.
class IndexAdoption {
public:
    /// `isExpected`: an index may be set.
    explicit IndexAdoption(bool isExpected) : _isExpected(isExpected) {}

    /// Null: there will be none.
    void setIndex(AutoIndex* index);
    [[nodiscard]] osg::ref_ptr<AutoIndex> index() const;

    /// Whether tiles have to be told to await().
    [[nodiscard]] bool isAwaited() const;

    /// Whether tiles with files below them wait.
    [[nodiscard]] bool hasWaiting() const;

    /// `content`: holds the tiles, and stands below another node when it is in the scene; null: they are in the scene.
    void await(osg::Node* content, std::vector<AwaitingTile> tiles);

    /// Gives some tiles the bins that are known by now. `mostTiles`: how many are looked at.
    void adopt(Database& database, std::size_t mostTiles);

private:
    struct Content {
        bool isInScene = false;
        osg::observer_ptr<osg::Node> root;
        std::vector<AwaitingTile> tiles;
    };

    mutable std::mutex _mutex;
    bool _isExpected;
    osg::ref_ptr<AutoIndex> _index;
    std::vector<Content> _contents;
    std::size_t _next = 0;                // of the contents, to be looked at
    unsigned int _adoptedGeneration = 0;  // that all tiles have been compared with
    unsigned int _roundGeneration = 0;    // at the beginning of this round
    bool _hasUnseen = false;              // contents that this round did not look at
};

}  // namespace osgAnalyticBin
