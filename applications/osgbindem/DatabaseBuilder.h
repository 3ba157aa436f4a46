// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseFolder.h"
#include "DemMosaic.h"
#include "ProgressLine.h"
#include "Ranks.h"
#include "Settings.h"
#include "TileBuilder.h"

#include <cpl_progress.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// Builds the whole database, or what an earlier run of the same settings and rasters has left of it to do.
/// Throws Failure, Interrupted; then what is done is kept beside the output for the next run, finished subtrees only.
/// The other ranks only help; what went wrong there is thrown by the first one.
void buildDatabase(const Settings& settings, const Ranks& ranks);

/// Builds what has changed of a database since its rasters were other ones; the result is that of buildDatabase().
/// Throws Failure, Interrupted; then the database is as it was, or, if the new files were on their way into it already,
/// the next run of the program brings in the rest.
void updateDatabase(const Settings& settings);

/// Everything that decides the bytes of a database, as text: programs, settings, and each raster's files with their
/// sizes and times. Two runs with the same text build the same files.
[[nodiscard]] std::string describeSources(const Settings& settings, const TileLayout& layout);

/// Where heights, how fine they are, or colours may have changed since a database was built: rectangles of posts, with
/// the cells between them and their neighbours.
using ChangedArea = std::vector<RectDeg>;

/// Whether one of them has a point in common with the rectangle; longitudes count modulo 360, a pole is one point.
[[nodiscard]] bool touches(const ChangedArea& area, const RectDeg& rect) noexcept;

/// Compares the descriptions of two databases. Returns: nullopt when more than rasters and images differs.
[[nodiscard]] std::optional<ChangedArea> changedBetween(const std::string& before, const std::string& now);

/// A subtree that one thread builds by itself.
struct Task {
    TileId tile;
    /// About the number of tiles without children in it.
    double weight = 0.0;
};

/// Shows how much is done; may be used by several threads. On a terminal it is a line that is written over, with the
/// time that is left; elsewhere it is GDAL's row of numbers.
class Progress final {
public:
    Progress(bool isShown, const std::vector<Task>& tasks)
        : _isShown(isShown), _isRow(!_line.isTerminal() || launchedRank() != nullptr) {
        for (const Task& task : tasks) _total += task.weight;
        add(0.0);
    }

    /// `isKnown`: an earlier run has done it.
    void add(double amount, bool isKnown = false) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _done += amount;
        if (isKnown) _line.skip(amount / _total);
        if (_isShown && _isRow) GDALTermProgress(std::min(_done / _total, 0.99), nullptr, nullptr);
        if (_isShown && !_isRow && _line.isDue()) _line.show(_done / _total, "");
    }
    void finish() {
        if (_isShown && _isRow) GDALTermProgress(1.0, nullptr, nullptr);
        if (_isShown && !_isRow) _line.finish(1.0, "");
    }

private:
    std::mutex _mutex;
    osgAnalyticBin::support::ProgressLine _line{stdout};
    const bool _isShown;
    const bool _isRow;
    double _total = 0.0;
    double _done = 0.0;
};

/// The layout that the settings ask for, or else the rasters, once every raster is known to have heights; the rasters
/// are closed again. Says what the user should know of them, unless that is quiet. Throws Failure.
[[nodiscard]] TileLayout checkedLayoutFor(const Settings& settings);

/// Divides the tree into subtrees of similar weight; neighbours follow each other. What lies above the subtrees is left
/// for afterwards. The plan is the same however many threads and programs share the work, so that others can go on.
/// No raster is read.
[[nodiscard]] std::vector<Task> planTasks(const DemMosaic& mosaic, const TileLayout& layout);

/// What the threads share that build or update one database.
struct Site {
    const Settings& settings;
    const TileLayout& layout;
    const DatabaseFolder& folder;
    Progress& progress;
    /// Of a database that is updated: finds tiles that stay as they are, with a builder of the thread.
    std::function<std::optional<SurveyedTile>(TileBuilder& builder, const TileId& tile)> standing = nullptr;
};

/// Called while threads work. `isStopped`: the user wants to stop. What it throws stops the threads.
using Glance = std::function<void(bool isStopped)>;

/// Does tasks in threads, those left out that an earlier run has done and whose files are whole. `glance`: may be null.
/// Throws what was thrown first.
void doTasks(const Site& site, const std::vector<Task>& tasks, const Glance& glance);

/// Builds the start tiles in threads, from what all tasks of the plan have left. Throws what was thrown first.
[[nodiscard]] std::vector<BuiltTile> buildStarts(const Site& site, const std::vector<Task>& plan);

}  // namespace osgbindem
