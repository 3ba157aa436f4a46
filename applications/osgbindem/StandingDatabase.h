// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileFiles.h"
#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// A finished database that is to be updated. Not for use by several threads: each has its own copy. The root file is
/// large: the copies read it once together, when one of them needs it.
class StandingDatabase final {
public:
    StandingDatabase(std::string rootFile, TileFiles files, const TileLayout& layout)
        : _layout(layout), _start(std::make_shared<Start>(std::move(rootFile), layout)), _files(std::move(files)) {}

    [[nodiscard]] bool hasChildren(const TileId& tile) const { return _files.hasChildren(tile); }

    /// The bin that is stored with a tile. Throws Failure when the tile is not there.
    [[nodiscard]] osgAnalyticBin::AnalyticBin bin(const TileId& tile);

private:
    using Bins = std::vector<osgAnalyticBin::AnalyticBin>;

    /// The start tiles; may be used by several threads.
    class Start {
    public:
        Start(std::string file, const TileLayout& layout) : _file(std::move(file)), _layout(layout) {}

        /// Reads them when asked first. Throws Failure.
        [[nodiscard]] const Bins& bins();

    private:
        std::string _file;
        const TileLayout& _layout;
        std::mutex _mutex;
        Bins _bins;
    };

    /// Of the tiles in the file with the tile.
    [[nodiscard]] const Bins& binsBeside(const TileId& tile);

    const TileLayout& _layout;
    std::shared_ptr<Start> _start;
    TileFiles _files;
    std::optional<TileId> _parent;
    Bins _siblings;
};

}  // namespace osgbindem
