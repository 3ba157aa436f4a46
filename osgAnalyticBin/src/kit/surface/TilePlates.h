// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/TerrainShape.h>
#include <osgAnalyticBin/core/mesh/MeshCover.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/Node>

#include <memory>
#include <vector>

namespace osgAnalyticBin {

/// A tile's own meshes, and what determines where they are drawn.
struct TileMeshes {
    std::vector<osg::ref_ptr<osg::Node>> nodes;
    const osg::EllipsoidModel& ellipsoid;
    const osg::Matrixd& localToEcef;  ///< from the frame that the meshes stand in
    const TerrainShape& shape;        ///< in which osgTerrain tiles are shown
};

/// What terrain in front of others is known by.
struct TileGround {
    /// What the tile's own meshes cover, skirts left out. Several levels of detail have to fill the same place each. Of
    /// osgTerrain tiles: the whole grid, by any technique that is vouched for.
    core::MeshCover cover;
    /// Bounds of the altitudes of what the tile draws by itself, without skirts. Null where they are not known: for
    /// several levels of detail, osgTerrain tiles that are not whole grids, quads, what tileSurface() does not know,
    /// and meshes with holes or at a pole.
    std::unique_ptr<const core::GroundPlates> plates;
};

/// Cost: some 0.1 microseconds for each triangle, as much again with plates; for osgTerrain tiles some ten
/// microseconds.
[[nodiscard]] OSGANALYTICBIN_EXPORT TileGround groundOf(const TileMeshes& meshes, bool withPlates);
/// The share of a place's width by which float vertices are rounded.
inline constexpr double kPlaceRounding = 4.0 * core::MeshCover::kTolerance;
/// Whether two places are the same, up to a share of their width.
[[nodiscard]] bool isSamePlace(const core::GeodeticBin& a, const core::GeodeticBin& b, double share = kPlaceRounding);
/// Who declares a horizon says that the tiles of the globe have no holes: their meshes are not looked at.
[[nodiscard]] bool areVouchedFor(const CullOptions& options, const osg::EllipsoidModel& ellipsoid);

/// Reads all triangles of a tile's only mesh, skirts included, into an empty mesh; of osgTerrain tiles those with
/// either diagonal, and no skirts. Returns: false where they are not known, as above.
[[nodiscard]] bool readTileMesh(const TileMeshes& meshes, core::EcefMesh& mesh);

}  // namespace osgAnalyticBin
