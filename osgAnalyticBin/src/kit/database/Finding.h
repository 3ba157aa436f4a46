// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin {

/// What is found of a database or of one of its tiles. A database remembers it, and tells the user once.
enum class Finding {
    /// Part of the globe may not be covered by tiles of known depth: the horizon is off, unless its altitude is given.
    Gap,
    /// The mesh of a tile is not known to fill its place: the horizon is off while the tile is in view.
    Hole,
    /// A tile is drawn in several places or moves, or as another Terrain than the database's says. It has no bin and is
    /// no occluder: where there is a gap as well, the horizon is off even if its altitude was given.
    StrayTile,
    /// A tile is not where its bin was stored or installed: a gap and a stray tile.
    MovedTile,
    /// Tiles are nested too deep: the innermost have no bins, and count as a gap.
    TooDeep,
    /// The technique of osgTerrain tiles is not known.
    UnknownTechnique,
    /// OSG computes the near plane of a camera only after the cull traversal, and it has no bound before.
    UnknownNearPlane,
    /// The eye is not over the region that the database covers: the horizon hides nothing.
    EyeBesideRegion,
    /// A tile that pages finer ones would take its bin from an index.
    IndexWanted,

    // Findings of a tile that concern the bins of the tiles above it:
    /// The tile is not as the index knows it.
    OtherThanIndexed,
    /// The tile is larger than the bin that is stored with it or above it.
    LargerThanStored,
    /// It cannot be compared with the bins stored with it and above it: these are not used.
    Unverifiable,
    /// The tile may rightly draw outside of the bins above it.
    Larger,
};

/// Tells the user, if that is of use. `file`: where it was found.
void tell(Finding finding, const std::string& file, bool isInMap);

}  // namespace osgAnalyticBin
