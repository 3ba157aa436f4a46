// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Description.h"
#include "Recorder.h"

#include <osg/Vec3d>

#include <vector>

namespace osgAnalyticBin::test {

/// The line of sight to a point, in eye space: from the near plane.
struct Sight {
    osg::Vec3d start, end, inPicture;
    bool isPerspective;  ///< the eye is at the origin
};

/// A database of which the documentation says that something hidden below it may be culled, though no face that is
/// drawn hides it. It hides where the near plane has cut its faces away; the flags say where else. It is as large as
/// the kit may take it to be: the ellipsoid, or what is lower than the eye.
struct AllowedOccluder {
    int database = 0;
    /// Metres above the ellipsoid: above it, an eye sees the database's faces from in front.
    double highest = 0.0;
    bool fromBelow = false;       ///< from eyes below the highest terrain
    bool fromEverywhere = false;  ///< from all eyes
};

/// What the documentation excludes of a scene.
[[nodiscard]] std::vector<AllowedOccluder> allowedOccluders(const Description& description);

/// Whether the occluder, where a traversal met its database, may hide the end of a line of sight.
[[nodiscard]] bool mayHide(const AllowedOccluder& occluder, const Description& description, const MetDatabase& met,
                           const Sight& sight);

}  // namespace osgAnalyticBin::test
