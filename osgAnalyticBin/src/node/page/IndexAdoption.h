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

/// A tile that takes its bin from the index as soon as the index has it.
struct AwaitingTile {
    osg::observer_ptr<const ParentTile> tile;  // keeps the database alive
    std::uint64_t fingerprint = 0;
    double skirt = 0.0;    ///< metres, of its own mesh
    bool isPaged = false;  ///< whether it pages finer tiles
};

/// The index of a database while it is being made, and the tiles that wait for it. Threads: adopt() and setIndex() only
/// while no cull traversal runs, the rest at any time.
class IndexAdoption {
public:
    /// `isExpected`: whether setIndex() will be called.
    explicit IndexAdoption(bool isExpected) : _isExpected(isExpected) {}

    /// `index`: null if there will be none.
    void setIndex(AutoIndex* index);
    [[nodiscard]] osg::ref_ptr<AutoIndex> index() const;

    /// Whether tiles have to be passed to await().
    [[nodiscard]] bool isAwaited() const;

    /// Whether adopt() has something to do with an index that is whole.
    [[nodiscard]] bool hasNews() const;

    /// Whether tiles that page finer ones wait.
    [[nodiscard]] bool hasWaiting() const;

    /// Adds tiles that wait. `content`: the root node of their file, not merged into the scene yet; null: they are in
    /// the scene.
    void await(osg::Node* content, std::vector<AwaitingTile> tiles);

    /// Gives waiting tiles the bins that the index has by now. Looks at `mostTiles` tiles at most.
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
    std::size_t _next = 0;                // of _contents, to be looked at next
    unsigned int _adoptedGeneration = 0;  // of the index, that all tiles were compared with
    unsigned int _roundGeneration = 0;    // at the beginning of this round
    bool _hasUnseen = false;              // contents were added that this round does not look at
};

}  // namespace osgAnalyticBin
