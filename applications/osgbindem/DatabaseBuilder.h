// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseFolder.h"
#include "ProgressLine.h"
#include "Ranks.h"
#include "Settings.h"
#include "TileBuilder.h"

#include <cpl_progress.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// Builds the whole database, or what an earlier run of the same settings and rasters has left of it to do.
/// Throws Failure, Interrupted; then what is done is kept beside the output for the next run, finished subtrees only.
/// An update takes over those parts of the finished database that come out as they are.
/// The other ranks only help.
void buildDatabase(const Settings& settings, const Ranks& ranks);

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

/// Takes those parts of a plan over from the finished database that come out as they are. Returns: how many there are.
/// Throws Failure, Interrupted.
std::size_t takeOverUnchanged(const Settings& settings, const TileLayout& layout, const std::vector<Task>& plan,
                              const ChangedArea& area, const DatabaseFolder& folder);

}  // namespace osgbindem
