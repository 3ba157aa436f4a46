// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// The data that a terrain tile's mesh is made from: heights at the posts of a grid in latitude and longitude, and
/// skirts. It takes a fifth of the mesh's bytes or less.
struct TerrainGrid {
    /// Metres; heights and skirts are whole multiples of it.
    static constexpr double kStep = 1.0 / 64.0;

    /// A stop of the colours by height: the colour at this height, blended towards the next stop's.
    struct ColourStop {
        /// Metres.
        float height = 0.0F;
        /// Red, green, blue.
        std::array<std::uint8_t, 3> colour{};
    };
    /// The skirt of one edge, post by post, from south to north or from west to east, in steps.
    struct Skirt {
        /// How far it hangs down.
        std::vector<std::int32_t> depth;
        /// How far the lower end leans outward.
        std::vector<std::int32_t> lean;
    };

    /// Below the heights.
    core::Ellipsoid ellipsoid{1.0, 1.0};
    /// Along an edge of the tile.
    std::int32_t cells = 0;
    /// Number of posts of the tile's level around the equator. From pole to pole there are half as many plus one.
    std::int64_t columns = 0;
    /// @{
    /// The south-west post, counted from longitude -180 and latitude -90.
    std::int64_t firstColumn = 0;
    std::int64_t firstRow = 0;
    /// @}
    /// Metres: vertices are rounded to multiples of it in ECEF.
    double quantum = 1.0;
    /// In ECEF; vertices are stored relative to it.
    glm::dvec3 origin{0.0};
    /// In steps, row by row from the south-west; one ring of posts around the tile, for its normals, is among them.
    std::vector<std::int32_t> heights;
    /// South, north, west, east.
    std::array<Skirt, 4> skirts;
    /// By height; empty: white, and the texture has the colours.
    std::vector<ColourStop> colours;
    /// Colours by height look like a map of a relief: lit from the north-west, with snow by height and latitude.
    bool relief = false;
    /// Texels along an edge of the texture, whose outer texels' middles lie on the tile's edges; 0: no texture.
    std::int32_t textureSize = 0;

    /// The height of a post in metres; column and row from -1 to cells + 1.
    [[nodiscard]] double height(int column, int row) const noexcept {
        return kStep * heights[static_cast<std::size_t>((row + 1) * (cells + 3) + column + 1)];
    }
};

/// The colours of heights: blues below 0 m, greens to browns to white above.
[[nodiscard]] const std::vector<TerrainGrid::ColourStop>& hypsometricStops();

/// The colour of a height.
[[nodiscard]] osg::Vec4ub colourAt(const std::vector<TerrainGrid::ColourStop>& stops, double height);

/// The vertices of a grid, row by row from the south-west, then the skirts' edge by edge, in ECEF metres.
/// Guarantee: a post that two grids with the same quantum share is mapped to exactly the same point.
[[nodiscard]] std::vector<glm::dvec3> verticesOf(const TerrainGrid& grid);

/// Three vertices a triangle, the surface's first.
[[nodiscard]] std::vector<std::uint16_t> trianglesOf(int cells);

/// The mesh as OSG draws it, without the triangles and texture coordinates, which tiles may share.
void fillGeometry(const TerrainGrid& grid, osg::Geometry& geometry);

/// One for each vertex. Requires: none is there yet.
void addTextureCoordinates(int cells, int textureSize, osg::Vec2Array& coordinates);

/// The bytes of a grid. Each height is stored as its difference from a prediction by its neighbours. The bytes are the
/// same on every machine.
[[nodiscard]] std::string packed(const TerrainGrid& grid);

/// Returns: nullopt for what packed() has not made.
[[nodiscard]] std::optional<TerrainGrid> unpacked(const std::string& bytes);

}  // namespace osgAnalyticBin
