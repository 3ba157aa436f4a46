// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../database/Database.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/core/mesh/MeshCover.h>

#include <optional>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

/// What a tile's bounds are made of, besides the tile.
struct FitSources {
    CullOptions options;
    const osg::EllipsoidModel& ellipsoid;   ///< of the tile's ground
    osg::ref_ptr<const BinIndex> index;     ///< null: none
    const InstalledTile* parent = nullptr;  ///< null: none
    Widening correction;                    ///< what was found of the tile before, perhaps in another place
    bool hasNewContent = false;             ///< since bins were last installed on it
};

/// What a tile is culled by, at vertical scale 1.
struct TileFit {
    AnalyticBin bin;      ///< with all descendants; not valid: see isTerrain
    AnalyticBin surface;  ///< what it draws by itself; not valid: not known
    /// Metres that skirts hang below the bin; 0 for a tile in an index, whose bin holds them. Descendants' skirts are
    /// taken to be no longer than the tile's own; a descendant with longer ones expands the bins above it.
    double skirt = 0.0;
    bool isScalable = false;
    /// Whether the bin holds heights that were declared alone, while OSG's sphere bounds what is loaded.
    bool isDeclared = false;
    /// False: another technique may draw less than the whole surface at its borders.
    bool isInPlace = true;
    /// False: the node is not terrain, and left as it is. True with a bin that is not valid: never culled.
    bool isTerrain = false;
    InstalledTile::Extents extents;
    /// The tile's stored bin, corrected, or that of the nearest ancestor with one.
    AnalyticBin stored;
    /// What is to be reported, with what the tile draws.
    std::vector<std::pair<Finding, AnalyticBin>> findings;
};

/// From, in this order: the bin stored with it; the database's index; its surface and the range of heights that the
/// options declare. Changes nothing.
/// `shape` is what the database is drawn in; the application may change that meanwhile.
/// Source: doc/theory/tiles.md, sections 2 and 4.
[[nodiscard]] TileFit fitTile(const FoundTile& tile, const FitSources& from, const TerrainShape& shape);

/// What a tile's own meshes are taken to cover whatever they are: as its bin says where the database's horizon is
/// given; nothing where neither the horizon nor occlusion is used.
[[nodiscard]] std::optional<core::MeshCover> coverWithoutMesh(const FitSources& from, const TileFit& fit);

/// Whether a tile is ground, as its mesh tells: one of its drawables spans at least a 16th of the tile above in both
/// directions. Leaves that hold objects on the ground alone, such as houses, do not; OSG culls them better.
[[nodiscard]] bool isGround(const FoundTile& tile, const InstalledTile* parent, const TileFit& fit);

}  // namespace osgAnalyticBin
