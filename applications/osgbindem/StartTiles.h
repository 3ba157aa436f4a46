// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TaskWork.h"

#include <array>
#include <atomic>
#include <memory>
#include <set>
#include <string>

namespace osgbindem {

/// The start tiles, made of what the tasks have left of the tiles below them.
class StartTiles final {
public:
    StartTiles(const Site& site, const std::vector<Task>& tasks);

    /// Requires: all tasks are finished. May be called by several threads; they share the tiles.
    void build(TileBuilder& builder);

    /// Requires: all are built. The bytes of the root file.
    [[nodiscard]] std::string rootBytes(TileBuilder& builder) const;

private:
    static constexpr std::size_t kCount = std::size_t{TileId::kStartColumns} * TileId::kStartRows;

    [[nodiscard]] std::optional<SurveyedTile> finished(const TileId& tile) const;

    const Site& _site;
    std::set<TileId> _tasks;
    std::array<std::unique_ptr<BuiltTile>, kCount> _tiles;
    std::atomic<std::size_t> _next{0};
};

}  // namespace osgbindem
