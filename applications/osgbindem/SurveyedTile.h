// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "HeightGrid.h"
#include "SkirtMeasure.h"

#include <osgAnalyticBin/AnalyticBin.h>

namespace osgbindem {

/// A tile with everything below it in files: what its mesh and the tiles above need of it.
struct SurveyedTile {
    HeightGrid heights;
    Skirt skirt;
    /// The full-resolution heights under the tile.
    HeightRange range;
    /// Holds the bins of all tiles below; not valid for a tile without children.
    osgAnalyticBin::AnalyticBin below;
};

}  // namespace osgbindem
