// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// What one cull traversal did with the tiles of a database, whatever the method.
struct TileCounts {
    std::uint64_t tested = 0;     ///< tiles that the traversal reached
    std::uint64_t kept = 0;       ///< tiles whose children it reached
    std::uint64_t drawn = 0;      ///< tiles with geometry of their own in the render bins
    std::uint64_t drawables = 0;  ///< drawables in the render bins
    std::uint64_t triangles = 0;  ///< triangles of those
    std::uint64_t wanted = 0;     ///< files that PagedLODs asked for: not loaded yet
};

/// One line of poses.csv: what was measured at one pose.
struct PoseRecord {
    std::string name;
    TileCounts tiles;
    std::uint64_t files = 0;  ///< node files read between the camera's arrival and the picture
    double cullMs = 0.0;      ///< median time of OSG's cull traversal, milliseconds
    double frameMs = 0.0;     ///< median time from frame to frame: update, cull, draw and what the viewer waits for
    std::string picture;      ///< file name, in the folder of the table
};

/// The file's name in the folder of a flight.
inline constexpr const char* kPoseTableName = "poses.csv";

/// Writes `folder`/poses.csv under a temporary name and renames it when it is complete. `remark` becomes the comment
/// line at the top. Throws: Failure.
void writePoseTable(const std::string& folder, const std::vector<PoseRecord>& records, const std::string& remark);

}  // namespace osgAnalyticBin::flight
