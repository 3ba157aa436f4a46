// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "PathGroups.h"
#include "Table.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// What was measured of one method at one pose, or summed over poses.
struct Figures {
    std::uint64_t truthTiles = 0;
    std::uint64_t hiddenTiles = 0;
    std::uint64_t visibleTiles = 0;
    std::uint64_t nodes = 0;
    std::uint64_t testedTiles = 0;
    std::uint64_t keptTiles = 0;
    std::uint64_t drawnTiles = 0;
    std::uint64_t drawables = 0;
    std::uint64_t triangles = 0;
    std::uint64_t pagedLods = 0;
    std::uint64_t residentTiles = 0;
    std::uint64_t filesRequested = 0;
    std::uint64_t bytes = 0;
    std::uint64_t falseCulls = 0;
    std::uint64_t falseCullPixels = 0;
    std::uint64_t falseKeeps = 0;
    std::uint64_t differingPixels = 0;
    double cullMs = 0.0;
    double cullSpreadMs = 0.0;
    double cullColdMs = 0.0;
    double cullColdSpreadMs = 0.0;

    Figures& operator+=(const Figures& other);
};

/// A column of whole numbers: its name in files, and what it says.
struct CountColumn {
    const char* name;
    std::uint64_t Figures::*count;
    const char* meaning;
};

inline constexpr std::array<CountColumn, 17> kCountColumns{{
    {"truth_tiles", &Figures::truthTiles,
     "tiles needed: the hull of the tile's bin, finer descendants in it, meets the frustum, not behind the globe"},
    {"hidden_tiles", &Figures::hiddenTiles, "tiles whose bin meets the frustum, but behind the globe"},
    {"visible_tiles", &Figures::visibleTiles, "tiles with a pixel of their own, skirts included"},
    {"nodes", &Figures::nodes, "nodes and drawables that the cull traversal reached"},
    {"tested_tiles", &Figures::testedTiles, "tiles that it reached"},
    {"kept_tiles", &Figures::keptTiles, "tiles that it went into"},
    {"drawn_tiles", &Figures::drawnTiles, "tiles with a mesh of their own drawn"},
    {"drawables", &Figures::drawables, "drawables drawn"},
    {"triangles", &Figures::triangles, "triangles of these"},
    {"paged_lods", &Figures::pagedLods, "PagedLODs among the tiles kept"},
    {"resident_tiles", &Figures::residentTiles, "tiles in memory then, shown or not"},
    {"files_requested", &Figures::filesRequested, "files read from the root file's on, until the pager was idle"},
    {"bytes", &Figures::bytes, "bytes of these files"},
    {"false_culls", &Figures::falseCulls, "visible tiles that were not drawn"},
    {"false_cull_pixels", &Figures::falseCullPixels, "pixels of these"},
    {"false_keeps", &Figures::falseKeeps, "tiles drawn that are not among the truth_tiles"},
    {"differing_pixels", &Figures::differingPixels, "pixels that differ from the picture without culling"},
}};

inline constexpr const char* kCullColumn = "cull_ms";
inline constexpr const char* kCullColdColumn = "cull_cold_ms";

/// A column of milliseconds. A time is followed by its spread, which tables for people leave out.
struct TimeColumn {
    const char* name;
    double Figures::*ms;
    bool isSpread;
    const char* meaning;
};

inline constexpr std::array<TimeColumn, 4> kTimeColumns{{
    {kCullColumn, &Figures::cullMs, false, "milliseconds of a cull traversal and its sorting, median"},
    {"cull_spread_ms", &Figures::cullSpreadMs, true, "from the first quartile of these times to the third"},
    {kCullColdColumn, &Figures::cullColdMs, false,
     "as cull_ms, after other memory was touched (--flush): a viewer that draws between two culls"},
    {"cull_cold_spread_ms", &Figures::cullColdSpreadMs, true, "from the first quartile of these times to the third"},
}};

/// One method's figures, pose by pose.
struct MethodFigures {
    std::string method;
    std::vector<Figures> poses;

    [[nodiscard]] Figures sum() const;
};

using report::PathGroup;
using report::pathGroupsOf;

/// What a method did at the poses of one group. Requires: figures for each of them.
[[nodiscard]] Figures sumOf(const MethodFigures& method, const PathGroup& group);

/// What was measured of one method in a flight with paging live: "frames", and figures by kFlightColumns, or
/// kDrawnColumns where it was drawn.
struct FlightFigures {
    std::string method;
    report::Json sums;
};

struct FlightColumn {
    const char* name;
    const char* meaning;
};

inline constexpr std::array<FlightColumn, 10> kFlightColumns{{
    {"drawn_tiles", "tiles with a mesh of their own drawn, summed over frames"},
    {"missing_frames", "frames that asked for a file for what they showed: it was too coarse"},
    {"resident_tiles", "tiles in memory after the last frame"},
    {"files_requested", "files read"},
    {"asked_again", "times that a file was asked for which earlier frames had given up"},
    {"bytes", "bytes of these files"},
    {"complete_ms", "milliseconds from each jump until nothing was missing, summed; 0 without --jumps"},
    {kCullColumn, "milliseconds of all cull traversals and their sorting, summed"},
    {"cull_median_ms", "of one, median"},
    {"cull_99th_ms", "of one, 99th percentile"},
}};

inline constexpr std::array<FlightColumn, 9> kDrawnColumns{{
    {kCullColumn, "milliseconds of the cull traversals, summed over frames"},
    {"draw_ms", "of drawing, until the pixels are there"},
    {"work_1st_ms", "cull and draw of one frame, 1st percentile"},
    {"work_median_ms", "median"},
    {"work_99th_ms", "99th percentile"},
    {"frame_ms", "from frame to frame, summed: update and what the pager brings besides"},
    {"frame_1st_ms", "of one, 1st percentile"},
    {"frame_median_ms", "median"},
    {"frame_99th_ms", "99th percentile"},
}};

}  // namespace osgAnalyticBin::bench
