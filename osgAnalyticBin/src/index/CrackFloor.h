// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileTree.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <cstddef>
#include <vector>

namespace osgAnalyticBin::indexing {

/// What each tile is culled by: what it and its descendants draw, lowered to what their skirts show.
///
/// An eye above the terrain sees a skirt of a tile A only through a crack between A's edge and that of a neighbour B,
/// and only above B's surface at that edge. Hence the floor of A's bin is the lowest of
///  (1) A's own surface and those of its descendants;
///  (2) those of A's neighbours of the same depth and their descendants, where B is as fine as A or finer;
///  (3) the facing edges of each ancestor of A and of that one's neighbours which touch A, where B is coarser;
///  (4) the end of A's own skirts, where an edge of A has no neighbour, or one without known surface;
/// but nowhere lower than the skirts of A and its descendants reach, which needs no neighbours. No skirt grows with the
/// vertical scale: where its end is the floor, its length counts as sag. At last each bin is made to hold those of its
/// descendants.
/// For a tile with more tiles beside or above it than any real terrain has, (4) is used, which bounds the effort.
/// Returns: by tile; not valid where something is not known. `comparisons`: if not null, of pairs of tiles.
[[nodiscard]] std::vector<osgAnalyticBin::AnalyticBin> binsWithCracks(const std::vector<TreeTile>& tiles,
                                                                      std::size_t* comparisons = nullptr);

}  // namespace osgAnalyticBin::indexing
