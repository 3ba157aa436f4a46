// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileMesh.h"

#include "Angles.h"
#include "PackedTerrain.h"
#include "Relief.h"
#include "TileNode.h"

#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>
#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <osg/Texture2D>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace osgbindem {

namespace {

using Colour = glm::ivec3;
using Block = std::array<Colour, 16>;

Block blockAt(const osg::Image& image, int column, int row) {
    Block block;
    for (int i = 0; i < 16; ++i) {
        const unsigned char* texel = image.data() + 3 * ((row + i / 4) * image.s() + column + i % 4);
        block[static_cast<std::size_t>(i)] = {texel[0], texel[1], texel[2]};
    }
    return block;
}

/// The ends of the diagonal of the colours' box along which most of them lie.
std::array<Colour, 2> endsOf(const Block& block) {
    Colour low = block[0];
    Colour high = block[0];
    Colour sum(0);
    for (const Colour& colour : block) {
        low = glm::min(low, colour);
        high = glm::max(high, colour);
        sum += colour;
    }
    // green weighs most in what is seen; the others run with it or against it
    Colour covariance(0);
    for (const Colour& colour : block) covariance += (16 * colour - sum) * (16 * colour.g - sum.g);
    for (const int c : {0, 2})
        if (covariance[c] < 0) std::swap(low[c], high[c]);
    return {high, low};
}

/// Five bits of red, six of green and five of blue.
std::uint16_t rounded(const Colour& colour) {
    const Colour bits = (colour * Colour(31, 63, 31) + 127) / 255;
    return static_cast<std::uint16_t>((bits.r << 11) | (bits.g << 5) | bits.b);
}

Colour shown(std::uint16_t bits) {
    const int red = bits >> 11;
    const int green = (bits >> 5) & 63;
    const int blue = bits & 31;
    return {(red << 3) | (red >> 2), (green << 2) | (green >> 4), (blue << 3) | (blue >> 2)};
}

std::uint32_t nearest(const Colour& colour, const std::array<Colour, 4>& palette) {
    const auto distance = [&](const Colour& other) {
        const Colour way = colour - other;
        return way.r * way.r + way.g * way.g + way.b * way.b;
    };
    const auto best = std::min_element(palette.begin(), palette.end(),
                                       [&](const Colour& a, const Colour& b) { return distance(a) < distance(b); });
    return static_cast<std::uint32_t>(best - palette.begin());
}

void store(const Block& block, unsigned char* target) {
    const std::array<Colour, 2> ends = endsOf(block);
    std::uint16_t first = rounded(ends[0]);
    std::uint16_t second = rounded(ends[1]);
    // the larger number first means four colours
    if (first < second) std::swap(first, second);
    std::uint32_t indices = 0;
    if (first != second) {
        const Colour a = shown(first);
        const Colour b = shown(second);
        const std::array<Colour, 4> palette{a, b, (2 * a + b) / 3, (a + 2 * b) / 3};
        for (std::uint32_t i = 0; i < 16; ++i) indices |= nearest(block[i], palette) << (2 * i);
    }
    for (int i = 0; i < 2; ++i) target[i] = static_cast<unsigned char>(first >> (8 * i));
    for (int i = 0; i < 2; ++i) target[2 + i] = static_cast<unsigned char>(second >> (8 * i));
    for (int i = 0; i < 4; ++i) target[4 + i] = static_cast<unsigned char>(indices >> (8 * i));
}

/// The image in blocks of 4 x 4 texels with two colours and two between them each (S3TC, DXT1): a sixth of the bytes,
/// drawn as it is stored. The same bytes on every machine.
/// Requires: three bytes a texel, rows without padding, sides that are multiples of 4.
osg::ref_ptr<osg::Image> inBlocks(const osg::Image& image) {
    const osg::ref_ptr<osg::Image> blocks = new osg::Image;
    blocks->allocateImage(image.s(), image.t(), 1, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_UNSIGNED_BYTE, 1);
    unsigned char* target = blocks->data();
    for (int row = 0; row < image.t(); row += 4) {
        for (int column = 0; column < image.s(); column += 4, target += 8) store(blockAt(image, column, row), target);
    }
    return blocks;
}

void drape(osg::Geometry& geometry, osg::Image& image) {
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(&image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    geometry.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
}

using osgAnalyticBin::PackedTerrain;
using osgAnalyticBin::TerrainGrid;
using osgAnalyticBin::support::kRadiansPerDegree;

// Vertices at the poles are rounded to within this of the axis, in metres.
constexpr double kAxisTolerance = 1.0;

// Covers the rounding within GeodeticMeshBounds (1e-7 m).
constexpr double kMargin = 1e-6;

/// How far chords between posts of the grid sag below these, in metres, and a little more.
double sagOf(const TerrainGrid& grid, const osgAnalyticBin::core::Interval& heights, const RectDeg& rect) {
    const auto posts = static_cast<std::size_t>(grid.cells + 1);
    const osgAnalyticBin::core::GeodeticGridBounds bounds(
        grid.ellipsoid,
        {{rect.south * kRadiansPerDegree, rect.north * kRadiansPerDegree},
         {rect.west * kRadiansPerDegree, rect.east * kRadiansPerDegree},
         posts,
         posts},
        std::max(std::abs(heights.lower), std::abs(heights.upper)));
    return 1.5 * bounds.sag();
}

}  // namespace

void colour(osgAnalyticBin::TerrainGrid& grid, int textureSize) {
    grid.textureSize = textureSize;
    if (textureSize > 0) return;
    grid.colours = osgAnalyticBin::hypsometricStops();
    grid.relief = true;
}

osg::ref_ptr<const osg::Vec4ubArray> reliefColours(osgAnalyticBin::TerrainGrid grid) {
    colour(grid, 0);
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osgAnalyticBin::fillGeometry(grid, *geometry);
    return dynamic_cast<const osg::Vec4ubArray*>(geometry->getColorArray());
}

osg::ref_ptr<osg::Geometry> makeGeometry(const osgAnalyticBin::TerrainGrid& grid, osg::Image* image, bool isPacked) {
    const osg::ref_ptr<osg::Geometry> geometry = isPacked ? new PackedTerrain(grid) : new osg::Geometry;
    if (!isPacked) osgAnalyticBin::fillGeometry(grid, *geometry);
    if (image != nullptr) drape(*geometry, isPacked ? *inBlocks(*image) : *image);
    return geometry;
}

SharedParts::SharedParts(int cells, bool arePacked)
    : _triangles(new osg::DrawElementsUShort(GL_TRIANGLES)), _cells(cells) {
    if (!arePacked) _triangles->asVector() = osgAnalyticBin::trianglesOf(cells);
}

void SharedParts::addTo(osg::Geometry& geometry, int textureSize) {
    geometry.addPrimitiveSet(_triangles);
    if (textureSize == 0) return;
    osg::ref_ptr<osg::Vec2Array>& coordinates = _texCoords[textureSize];
    if (!coordinates) {
        coordinates = new osg::Vec2Array(osg::Array::BIND_PER_VERTEX);
        if (!_triangles->empty()) osgAnalyticBin::addTextureCoordinates(_cells, textureSize, *coordinates);
    }
    geometry.setTexCoordArray(0, coordinates);
}

MeshExtent extentOf(const TerrainGrid& grid, const std::vector<std::uint16_t>& triangles, const TileId& tile) {
    namespace core = osgAnalyticBin::core;
    const RectDeg rect = tile.rect();
    const double axisTolerance = tile.touchesPole() ? kAxisTolerance : 0.0;
    core::GeodeticMeshBounds bounds(grid.ellipsoid, 0.5 * (rect.west + rect.east) * kRadiansPerDegree, axisTolerance);
    std::vector<glm::dvec3> drawn = verticesOf(grid);
    for (glm::dvec3& vertex : drawn) vertex = grid.origin + glm::dvec3(glm::vec3(vertex - grid.origin));
    const auto expandByTriangle = [&](std::size_t first) {
        bounds.expandByTriangle(drawn[triangles[first]], drawn[triangles[first + 1]], drawn[triangles[first + 2]]);
    };
    // Only vertices and triangles that can be at an end of the bin are looked at. All others are well within: in
    // latitude and longitude those that do not stand at the border, whose neighbours are a whole cell away, and in
    // altitude those that are higher than the lowest post by more than chords sag, and lower than the highest.
    const core::Interval heights = heightsOf(grid);
    const double rounding = 2.0 * grid.quantum;  // vertices are rounded by less than a quantum
    const double lowestChord = heights.lower + sagOf(grid, heights, rect) + rounding;
    const int last = grid.cells;
    std::size_t vertex = 0;
    for (int row = 0; row <= last; ++row) {
        for (int column = 0; column <= last; ++column, ++vertex) {
            const double height = grid.height(column, row);
            if (column == 0 || row == 0 || column == last || row == last || height <= heights.lower + rounding ||
                height >= heights.upper - rounding)
                bounds.expandByVertex(drawn[vertex]);
        }
    }
    std::size_t index = 0;
    for (int row = 0; row < last; ++row) {
        for (int column = 0; column < last; ++column, index += 6) {
            const double lowest = std::min({grid.height(column, row), grid.height(column + 1, row),
                                            grid.height(column, row + 1), grid.height(column + 1, row + 1)});
            if (row > 0 && row < last - 1 && lowest > lowestChord) continue;
            expandByTriangle(index);
            expandByTriangle(index + 3);
        }
    }
    const double surfaceLow = bounds.bin().altitude().lower;
    for (; vertex < drawn.size(); ++vertex) bounds.expandByVertex(drawn[vertex]);
    for (; index + 2 < triangles.size(); index += 3) expandByTriangle(index);
    return {osgAnalyticBin::AnalyticBin(bounds.bin(), kMargin + axisTolerance), surfaceLow};
}

}  // namespace osgbindem
