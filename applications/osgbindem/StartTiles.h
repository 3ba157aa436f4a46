// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"
#include "TileBuilder.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// The start tiles, made of what the tasks have left of the tiles below them.
class StartTiles final {
public:
    StartTiles(const Settings& settings, const TileLayout& layout)
        : _settings(settings), _layout(layout), _tiles(layout.startTiles().size()) {}

    /// Requires: all tasks are finished, and the builder finds what they have left. May be called by several threads;
    /// they share the tiles.
    void build(TileBuilder& builder);

    /// Requires: all are built. The bytes of the root file.
    [[nodiscard]] std::string rootBytes() const;

private:
    const Settings& _settings;
    const TileLayout& _layout;
    std::vector<std::unique_ptr<BuiltTile>> _tiles;
    std::optional<SharedParts> _shared;
    std::atomic<std::size_t> _next{0};
};

}  // namespace osgbindem
