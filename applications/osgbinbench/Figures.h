// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "PathGroups.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// What was measured of one method at one pose, or summed over poses.
struct Figures {
    std::uint64_t truthTiles = 0;
    std::uint64_t surfaceTiles = 0;
    std::uint64_t hiddenTiles = 0;
    std::uint64_t visibleTiles = 0;
    std::uint64_t visibleFiles = 0;
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
    std::uint64_t surfaceFalseKeeps = 0;
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

inline constexpr std::array<CountColumn, 20> kCountColumns{{
    {"truth_tiles", &Figures::truthTiles,
     "tiles needed: the hull of the tile's bin, finer descendants in it, meets the frustum, not behind the globe"},
    {"surface_tiles", &Figures::surfaceTiles, "the same, more strictly, of the tile's own surface alone"},
    {"hidden_tiles", &Figures::hiddenTiles, "tiles whose bin meets the frustum, but behind the globe"},
    {"visible_tiles", &Figures::visibleTiles, "tiles with a pixel of their own, skirts included"},
    {"visible_files", &Figures::visibleFiles,
     "files that bring these and the tiles above them: the least that has to be read"},
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
    {"surface_false_keeps", &Figures::surfaceFalseKeeps, "tiles drawn that are not among the surface_tiles"},
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

/// The same for a continuous flight, or for jumps from pose to pose, with paging live.
struct FlightFigures {
    std::string method;
    std::uint64_t frames = 0;
    std::uint64_t drawnTiles = 0;
    std::uint64_t missingFrames = 0;
    std::uint64_t residentTiles = 0;
    std::uint64_t filesRequested = 0;
    std::uint64_t askedAgain = 0;
    std::uint64_t bytes = 0;
    std::uint64_t completeMs = 0;
    double cullMs = 0.0;
    double cullMedianMs = 0.0;
    double cull99thMs = 0.0;
};

/// The same for flights that are drawn: milliseconds.
struct DrawnFigures {
    std::string method;
    std::uint64_t frames = 0;
    double cullMs = 0.0;
    double drawMs = 0.0;
    double work1stMs = 0.0;
    double workMedianMs = 0.0;
    double work99thMs = 0.0;
    double frameMs = 0.0;
    double frame1stMs = 0.0;
    double frameMedianMs = 0.0;
    double frame99thMs = 0.0;
};

struct DrawnColumn {
    const char* name;
    double DrawnFigures::*ms;
    const char* meaning;
};

inline constexpr std::array<DrawnColumn, 9> kDrawnColumns{{
    {"cull_ms", &DrawnFigures::cullMs, "milliseconds of the cull traversals, summed over frames"},
    {"draw_ms", &DrawnFigures::drawMs, "of drawing, until the pixels are there"},
    {"work_1st_ms", &DrawnFigures::work1stMs, "cull and draw of one frame, 1st percentile"},
    {"work_median_ms", &DrawnFigures::workMedianMs, "median"},
    {"work_99th_ms", &DrawnFigures::work99thMs, "99th percentile"},
    {"frame_ms", &DrawnFigures::frameMs, "from frame to frame, summed: update and what the pager brings besides"},
    {"frame_1st_ms", &DrawnFigures::frame1stMs, "of one, 1st percentile"},
    {"frame_median_ms", &DrawnFigures::frameMedianMs, "median"},
    {"frame_99th_ms", &DrawnFigures::frame99thMs, "99th percentile"},
}};

struct FlightColumn {
    const char* name;
    std::uint64_t FlightFigures::*count;
    const char* meaning;
};

inline constexpr std::array<FlightColumn, 7> kFlightColumns{{
    {"drawn_tiles", &FlightFigures::drawnTiles, "tiles with a mesh of their own drawn, summed over frames"},
    {"missing_frames", &FlightFigures::missingFrames,
     "frames that asked for a file for what they showed: it was too coarse"},
    {"resident_tiles", &FlightFigures::residentTiles, "tiles in memory after the last frame"},
    {"files_requested", &FlightFigures::filesRequested, "files read"},
    {"asked_again", &FlightFigures::askedAgain, "times that a file was asked for which earlier frames had given up"},
    {"bytes", &FlightFigures::bytes, "bytes of these files"},
    {"complete_ms", &FlightFigures::completeMs,
     "milliseconds from each jump until nothing was missing, summed; 0 without --jumps"},
}};

inline constexpr const char* kCullMedianColumn = "cull_median_ms";
inline constexpr const char* kCull99thColumn = "cull_99th_ms";

}  // namespace osgAnalyticBin::bench
