// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "SkirtMeasure.h"
#include "TileFiles.h"
#include "TileLayout.h"

#include <cstddef>
#include <optional>
#include <string>

namespace osgbindem {

/// A finished task of the work plan, as its file holds it.
struct TaskRecord {
    SurveyedTile tile;
    /// Of the files below the tile.
    FileSum files;
};

/// What has been done of a database, in files below one folder: what it is built from, and a record of each finished
/// task, written after the task's tiles. A later run goes on from it; programs on several machines share it.
class BuildState final {
public:
    explicit BuildState(std::string folder) : _folder(std::move(folder)) {}

    /// Whether the state belongs to a database that is built from just this.
    [[nodiscard]] bool isOf(const std::string& sources) const;

    /// Requires: there is no state. Throws Failure.
    void begin(const std::string& sources) const;

    /// How many records there are, whole ones or not.
    [[nodiscard]] std::size_t count() const;

    /// Throws Failure.
    void keep(const TaskRecord& record) const;

    /// Returns: nullopt when there is none that is whole. May be called by several threads, as keep() may.
    [[nodiscard]] std::optional<TaskRecord> find(const TileId& tile, const TileLayout& layout) const;

private:
    [[nodiscard]] std::string sourcesFile() const { return _folder + "/sources.txt"; }
    [[nodiscard]] std::string fileOf(const TileId& tile) const;

    std::string _folder;
};

}  // namespace osgbindem
