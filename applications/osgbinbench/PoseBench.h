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

/// The name of a pose, and what is seen there.
using Picture = std::pair<std::string, osg::ref_ptr<osg::Image>>;

struct PoseFigures {
    /// Of all poses, or, where the user has asked to stop, of those until then, one at least.
    std::vector<MethodFigures> methods;
    /// For the report: what the last method draws, by pose.
    std::vector<Picture> pictures;
};

/// Measures all methods at every pose of a path. At each pose every method starts from the root file alone, so that
/// its figures do not depend on the poses before; when all have loaded what they want, they are compared.
/// `methods`: the reference first, as cullMethodsFromNames() gives them.
/// Throws: Failure when there is nothing to draw on, the database cannot be read, a pose takes longer than the timeout,
/// a picture cannot be saved, or the oracle draws other tiles than what it repeats; Interrupted. Progress goes to
/// stderr.
[[nodiscard]] PoseFigures measureAtPoses(const Settings& settings, const std::vector<CullMethod>& methods,
                                         const std::vector<flight::CameraPose>& path, FileWatch& watch);

}  // namespace osgAnalyticBin::bench
