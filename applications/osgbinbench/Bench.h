// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CullMethod.h"
#include "Figures.h"
#include "Settings.h"

#include <osg/Image>

#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {

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
/// still. Frames are culled, not drawn, as drawing by software would set the pace.
/// --jumps: from pose to pose, from the root file alone on, standing at each until nothing is missing.
/// --draw: continuously, in a viewer, at the settings' rate at most. A frame is timed once all that it shows is loaded,
/// so that all methods draw the same scene. Each method flies the whole path from the root file alone, several times;
/// the methods take turns flight by flight.
/// Throws: Failure when the database cannot be read, there is nothing to draw on, or what a pose of --jumps or a frame
/// of --draw shows takes longer than the timeout to load. Progress goes to stderr.
[[nodiscard]] Measurement fly(const Settings& settings, const std::vector<CullMethod>& methods,
                              const std::vector<flight::CameraPose>& path, FileWatch& watch);

}  // namespace osgAnalyticBin::bench
