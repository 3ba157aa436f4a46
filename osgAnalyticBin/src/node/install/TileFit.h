// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../page/Database.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/core/mesh/MeshCover.h>

namespace osgAnalyticBin {

/// What a tile is culled by, at vertical scale 1.
struct TileFit {
    AnalyticBin bin;      ///< with all descendants; not valid: see isTerrain
    AnalyticBin surface;  ///< what it draws by itself; not valid: not known
    /// Metres that skirts hang below the bin, where they are to count: with SkirtUse::All, and on the outer border of a
    /// database, where no neighbour stands before them. Assumes: descendants' skirts hang no longer than the tile's
    /// own.
    double skirt = 0.0;
    bool isScalable = false;
    /// Whether the bin holds heights that were declared alone, while OSG's sphere bounds what is loaded.
    bool isDeclared = false;
    /// Metres that skirts of its own mesh hang, where a bin is stored.
    double ownSkirt = 0.0;
    /// False: another technique may draw less than the whole surface at its borders.
    bool isInPlace = true;
    /// False: the node is not terrain, and left as it is. True with a bin that is not valid: never culled.
    bool isTerrain = false;
};

/// From, in this order: the bin stored with it; the database's index; its surface and the range of heights that the
/// options declare. A tile that is not as the index knows it is reported to the database.
/// `shape` is what the database is drawn in; the application may change that meanwhile.
/// `link.parent`, `link.file`, `link.ordinal` and what is stored above have to be set in `link`; the rest is set here.
/// Source: doc/theory/tiles.md, sections 2 and 4.
[[nodiscard]] TileFit fitTile(const FoundTile& tile, Database& database, const TerrainShape& shape, ParentTile& link);

/// What a tile's own meshes cover: as its bin says where the database's horizon is given; nothing where neither the
/// horizon nor occlusion is used. `link`: as fitTile() has left it.
[[nodiscard]] core::MeshCover coverBy(const FoundTile& tile, const Database& database, const TerrainShape& shape,
                                      const ParentTile& link);

/// Whether a tile is ground, as its mesh tells: one of its drawables spans at least a 16th of the tile above in both
/// directions. Leaves that hold objects on the ground alone, such as houses, do not; OSG culls them better. `link`:
/// that of the tile, fitted.
[[nodiscard]] bool isGround(const FoundTile& tile, const ParentTile& link);

}  // namespace osgAnalyticBin
