// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullTraversal.h"
#include "Viewpoint.h"

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <optional>

namespace osgAnalyticBin {

/// An eye over the terrain that is shown.
struct FoundEye {
    core::HorizonEye horizon;
    /// Whether the eye is above the ground. False: a finer mesh of the ground is awaited, and the eye may be above that
    /// one. Nothing is hidden then, but files of tiles behind the horizon can wait.
    bool isAboveGround;
};

/// The eye over a database: the occluder lies just below the lowest surface that the traversal shows, by levels of
/// detail and by what is loaded, in the frustum, between the eye and its horizon. Coarse meshes elsewhere, which dip
/// far below the ellipsoid, do not count. Nothing at all is drawn below `deepest` (metres), infinite where no altitude
/// is declared. `depth` (metres) is where the search starts, best that of the last frame; it returns the depth found.
/// Requires: tiles that cover the globe, or the region, without gaps.
/// Guarantee: nothing is hidden that is seen past the shown surfaces, by lines of sight that stay over the tiles until
/// they meet the occluder; the eye's occluder is no deeper than `depth` was
/// or 1.05 times the depth found, but for eyes below the ellipsoid; tests: ShownDepth.*, HoledGlobe.*.
/// Returns: nullopt when something of unknown depth is shown and no altitude is declared, when nothing can be hidden,
/// when a tile in view may not be drawn or can be seen through, and when the eye may be below the finest mesh of the
/// ground. Cost: that of the walk, mostly once. Source: doc/theory/horizon.md,
/// section 8. The selection of the view is made for this eye; without one above the ground it has to be made anew.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::optional<FoundEye> eyeAboveWhatIsShown(const DatabaseView& view,
                                                                                const Viewpoint& viewpoint,
                                                                                double deepest, double& depth);

/// The same over an occluder at a given depth (metres), where no tile is known to reach lower.
[[nodiscard]] std::optional<core::HorizonEye> eyeAboveDepth(const DatabaseView& view, const Viewpoint& viewpoint,
                                                            double depth);

/// Makes the selection where no horizon can be used.
/// Returns: whether all that is shown in view is drawn and opaque, and the eye is above the ground below it; if not,
/// the selection has to be made anew.
[[nodiscard]] bool selectWithoutHorizon(const DatabaseView& view, const Viewpoint& viewpoint);

}  // namespace osgAnalyticBin
