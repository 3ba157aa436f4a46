// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/Export.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osg/Node>

#include <cstdint>

namespace osgAnalyticBin {

/// The surface of one tile, without tiles that are paged below it, and how far skirts leave it.
struct TileSurface {
    /// Extents of all that is drawn, and altitudes of the surface at vertical scale 1, chords between posts included;
    /// sag() says how much of the depth is chords. margin() is the rounding of float vertices. Not valid(): the node is
    /// no geocentric terrain, or its bounds cannot be computed.
    AnalyticBin bin;
    /// Metres by which skirts hang below `bin` at most, at any vertical scale: AnalyticBin::withSkirts() of this holds
    /// all that is drawn. 0: no skirts, or skirts that cannot be told from the surface and are in `bin`.
    double skirt = 0.0;
    /// The tile draws nothing; `bin` is not valid then.
    bool isEmpty = false;
    /// An osgTerrain tile, whose heights follow osgTerrain::Terrain's vertical scale.
    bool isScalable = false;
    /// In the plane of a map.
    bool isInMap = false;
};

/// The surface of a tile's own mesh: an osgTerrain::TerrainTile (read, neither traversed nor changed) as
/// osgTerrain::GeometryTechnique draws it, or any subgraph of fixed transforms and geometry. Children of LODs and
/// switches all count, whatever is chosen. Each drawable of a billboard is taken as a cube about its position, large
/// enough for every rotation. What vertices do not tell is as large as its bound: a drawable with a draw callback, with
/// a bound that the application gives, or of a class of its own, and a node of any class without children.
/// Below a paged or moving node nothing is known: not valid(); neither on an ellipsoid without hasValidRadii() that is
/// not mapPlane(), nor where a matrix is not affine.
/// In a map, where `ellipsoid` is mapPlane(), an osgTerrain tile is one whose locator is not geocentric.
/// `node` stands in a frame that `localToEcef` takes to ECEF. `sampleRatio` is osgTerrain::Terrain's.
/// A terrain tile of another class, or that already has another technique, is not valid(), unless `withAnyTechnique` is
/// set: its surface is then the one that GeometryTechnique would make.
/// Skirts are recognised by the texture coordinates and the depth that VirtualPlanetBuilder gives them. In case of
/// doubt they count as surface. Meshes higher than 50 km or deeper than 1000 km on the earth are not taken for terrain:
/// not valid(). On another globe, or in another unit, both limits are in proportion to the equatorial radius; the upper
/// one is at least 50 000 units where that is no more than a tenth of the radius. Nor is a terrain tile valid() on an
/// ellipsoid with |e2| of 0.1 or more, or with heights of a hundredth of the radii or more.
/// Guarantee: in any unit, the bin withSkirts() holds every point of every triangle that is drawn, and the bin itself
/// every one of the surface; of terrain tiles once exaggerated(), at any vertical scale from -10 to 10 that leaves no
/// post deeper than half the smallest radius of curvature; tests: TileSurface.*. Terrain whose
/// boundaries are equalised (Terrain::setEqualizeBoundaries(), off by default) takes heights of its neighbours at its
/// edges, which are not in here. Cost: one pass over heights or vertices and triangles.
[[nodiscard]] OSGANALYTICBIN_EXPORT TileSurface tileSurface(osg::Node& node, const osg::EllipsoidModel& ellipsoid,
                                                            const osg::Matrixd& localToEcef, double sampleRatio = 1.0,
                                                            bool withAnyTechnique = false);

/// 64 bits of everything that tileSurface() reads, to tell whether a tile is the one that an index was made from.
/// Guarantee: the same on every platform and in every run, whatever the addresses and the byte order; never 0; not made
/// to withstand forgery; tests: SurfaceFingerprint.*.
/// Cost: one pass, some 5 microseconds for 48 KB.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::uint64_t surfaceFingerprint(osg::Node& node, const osg::Matrixd& localToEcef);

}  // namespace osgAnalyticBin
