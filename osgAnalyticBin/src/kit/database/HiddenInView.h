// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../cull/CullTraversal.h"
#include "../tile/TerrainHider.h"
#include "Database.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/ref_ptr>

#include <optional>

namespace osgAnalyticBin {

/// What is hidden in a view of a database.
struct HiddenInView {
    std::optional<core::HorizonEye> eye;      ///< above the horizon that hides; none: nothing is behind it
    std::optional<core::HorizonEye> fileEye;  ///< see DatabaseView
    bool isSelected = false;                  ///< what is drawn is selected already
    std::optional<double> nearReach;          ///< of an eye, see Viewpoint
    osg::ref_ptr<TerrainHider> hider;         ///< null: terrain hides nothing
};

/// Looks for the horizon and for terrain in front of tiles, as far as options and the view allow it, and says in the
/// visitor's statistics what is missing. `isAltered`: a callback of the application's at the root of the database or
/// above may leave out tiles, or draw them otherwise. Where something was selected, it is what is drawn.
/// Requires: no active occluders.
[[nodiscard]] HiddenInView findHidden(DatabaseView& view, Database& database, const CullOptions& options,
                                      bool isAltered);

/// Tells nodes that are no tiles what the database hides.
void tellOthers(const DatabaseView& view, const HiddenInView& hidden);

}  // namespace osgAnalyticBin
