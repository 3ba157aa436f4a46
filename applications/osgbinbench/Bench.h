// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CullMethod.h"
#include "Settings.h"
#include "Table.h"

#include <osg/Image>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {

using report::allOf;
using report::MethodFigures;
using report::PathGroup;
using report::pathGroupsOf;
using report::sumOf;

/// What was measured of all methods, the reference first.
struct Measurement {
    std::vector<std::string> poses;  ///< names of the methods' rows; empty: of flights
    std::vector<MethodFigures> methods;
};

/// A column of what is measured: its name in files, and what it says.
struct Column {
    const char* name;
    const char* meaning;
};

inline constexpr const char* kCullColumn = "cull_ms";
inline constexpr const char* kCullColdColumn = "cull_cold_ms";

/// Of a pose. Tables for people leave out what has "_spread" in its name.
inline constexpr std::array<Column, 21> kPoseColumns{{
    {"truth_tiles",
     "tiles needed: the hull of the tile's bin, finer descendants in it, meets the frustum, not behind the globe"},
    {"hidden_tiles", "tiles whose bin meets the frustum, but behind the globe"},
    {"visible_tiles", "tiles with a pixel of their own, skirts included"},
    {"nodes", "nodes and drawables that the cull traversal reached"},
    {"tested_tiles", "tiles that it reached"},
    {"kept_tiles", "tiles that it went into"},
    {"drawn_tiles", "tiles with a mesh of their own drawn"},
    {"drawables", "drawables drawn"},
    {"triangles", "triangles of these"},
    {"paged_lods", "PagedLODs among the tiles kept"},
    {"resident_tiles", "tiles in memory then, shown or not"},
    {"files_requested", "files read from the root file's on, until the pager was idle"},
    {"bytes", "bytes of these files"},
    {"false_culls", "visible tiles that were not drawn"},
    {"false_cull_pixels", "pixels of these"},
    {"false_keeps", "tiles drawn that are not among the truth_tiles"},
    {"differing_pixels", "pixels that differ from the picture without culling"},
    {kCullColumn, "milliseconds of a cull traversal and its sorting, median"},
    {"cull_spread_ms", "from the first quartile of these times to the third"},
    {kCullColdColumn, "as cull_ms, after other memory was touched (--flush): a viewer that draws between two culls"},
    {"cull_cold_spread_ms", "from the first quartile of these times to the third"},
}};

/// Of a flight, after "frames".
inline constexpr std::array<Column, 9> kFlightColumns{{
    {"drawn_tiles", "tiles with a mesh of their own drawn, summed over frames"},
    {"missing_frames", "frames that asked for a file for what they showed: it was too coarse"},
    {"resident_tiles", "tiles in memory after the last frame"},
    {"files_requested", "files read"},
    {"bytes", "bytes of these files"},
    {"complete_ms", "milliseconds from each jump until nothing was missing, summed; 0 without --jumps"},
    {kCullColumn, "milliseconds of all cull traversals and their sorting, summed"},
    {"cull_median_ms", "of one, median"},
    {"cull_99th_ms", "of one, 99th percentile"},
}};

/// Of a flight that was drawn, after "frames".
inline constexpr std::array<Column, 9> kDrawnColumns{{
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

class FileWatch;

/// A camera path around a database that has none, made from its extents: the whole of it from above (overview), down
/// onto the place with the highest terrain from four sides (oblique), level across the ground there (low), and a turn
/// of the head there (turning). OSG computes near and far planes, as in the stock osgviewer.
/// Throws: Failure when the database cannot be read or has no tiles, Interrupted. Progress goes to stderr.
[[nodiscard]] std::vector<flight::CameraPose> defaultPath(const Settings& settings, FileWatch& watch);

/// The name of a pose, and what is seen there.
using Picture = std::pair<std::string, osg::ref_ptr<osg::Image>>;

struct PoseFigures {
    Measurement measured;  ///< of all poses, or, where the user has asked to stop, of those until then, one at least
    std::vector<Picture> pictures;  ///< for the report: what the last method draws, by pose
};

/// Measures all methods at every pose of a path. At each pose every method starts from the root file alone, so that
/// its figures do not depend on the poses before; when all have loaded what they want, they are compared.
/// `methods`: the reference first, as cullMethodsFromNames() gives them.
/// Throws: Failure when there is nothing to draw on, the database cannot be read, a pose takes longer than the timeout,
/// a picture cannot be saved, or the oracle draws other tiles than what it repeats; Interrupted. Progress goes to
/// stderr.
[[nodiscard]] PoseFigures measureAtPoses(const Settings& settings, const std::vector<CullMethod>& methods,
                                         const std::vector<flight::CameraPose>& path, FileWatch& watch);

/// Flies every method along a path with paging live. The oracle is left out, with one line that says so, and where
/// frames are drawn the reference, too. How many files a flight takes depends on the machine too.
/// --frames: once, continuously, at the settings' rate, whether the files wanted have come or not. Methods take turns
/// of some frames each, starting with another one every time; in the turns of others a method's pager and clock stand
/// still. Frames are culled, not drawn, as drawing by software would set the pace. With --speed each turn is a flight
/// straight ahead from one pose, which begins once everything there is loaded.
/// --jumps: from pose to pose, from the root file alone on, standing at each until nothing is missing.
/// --draw: continuously, in a viewer, at the settings' rate at most. A frame is timed once all that it shows is loaded,
/// so that all methods draw the same scene. Each method flies the whole path from the root file alone, several times;
/// the methods take turns flight by flight.
/// Throws: Failure when the database cannot be read, there is nothing to draw on, or what a pose of --jumps or --speed
/// or a frame of --draw shows takes longer than the timeout to load. Progress goes to stderr.
[[nodiscard]] Measurement fly(const Settings& settings, const std::vector<CullMethod>& methods,
                              const std::vector<flight::CameraPose>& path, FileWatch& watch);

}  // namespace osgAnalyticBin::bench
