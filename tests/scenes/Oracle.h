// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Description.h"
#include "Recorder.h"

#include <optional>
#include <string>

namespace osgAnalyticBin::test {

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

/// What a drawable was lost to.
struct FalseCull {
    std::string key;
    osg::Vec3d pointInEyeSpace;
    osg::Vec3d pointInPicture;
};

/// What may be culled although it is in the picture.
struct WhatCounts {
    double smallestPixels = 0.0;          ///< drawables that are smaller may be
    bool onlyBetweenGivenPlanes = false;  ///< near and far planes cull, before they are computed
};

/// Looks for a point of a drawable that one traversal delivered and the other did not, that is in the picture and
/// behind nothing that is drawn.
[[nodiscard]] std::optional<FalseCull> findFalseCull(const Description& description, const Delivery& without,
                                                     const Delivery& with, const std::vector<AllowedOccluder>& allowed,
                                                     const WhatCounts& counts);

}  // namespace osgAnalyticBin::test
