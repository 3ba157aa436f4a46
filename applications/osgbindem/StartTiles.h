// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"
#include "TileBuilder.h"

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>

namespace osgbindem {

/// The start tiles, made of what the tasks have left of the tiles below them.
class StartTiles final {
public:
    explicit StartTiles(const Settings& settings) : _settings(settings) {}

    /// Requires: all tasks are finished, and the builder finds what they have left. May be called by several threads;
    /// they share the tiles.
    void build(TileBuilder& builder);

    /// Requires: all are built. The bytes of the root file.
    [[nodiscard]] std::string rootBytes() const;

private:
    static constexpr std::size_t kCount = std::size_t{TileId::kStartColumns} * TileId::kStartRows;

    const Settings& _settings;
    std::array<std::unique_ptr<BuiltTile>, kCount> _tiles;
    std::optional<SharedParts> _shared;
    std::atomic<std::size_t> _next{0};
};

}  // namespace osgbindem
