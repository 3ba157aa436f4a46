// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PackedTerrain.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace osgAnalyticBin {

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
    const std::uint64_t bits = first | std::uint64_t{second} << 16 | std::uint64_t{indices} << 32;
    for (int i = 0; i < 8; ++i) target[i] = static_cast<unsigned char>(bits >> (8 * i));
}

}  // namespace

osg::ref_ptr<osg::Image> inBlocks(const osg::Image& image) {
    const osg::ref_ptr<osg::Image> blocks = new osg::Image;
    blocks->allocateImage(image.s(), image.t(), 1, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_UNSIGNED_BYTE, 1);
    unsigned char* target = blocks->data();
    for (int row = 0; row < image.t(); row += 4)
        for (int column = 0; column < image.s(); column += 4, target += 8) store(blockAt(image, column, row), target);
    return blocks;
}

}  // namespace osgAnalyticBin
