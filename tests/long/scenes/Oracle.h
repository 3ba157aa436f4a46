// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "AllowedOccluders.h"
#include "Description.h"
#include "Recorder.h"

#include <optional>
#include <string>

namespace osgAnalyticBin::test {

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
