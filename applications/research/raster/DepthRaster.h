// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin::bench {

/// A point in the picture: x and y from -1 to 1 times w, where w is its distance along the line of sight, metres.
struct ClipPoint {
    float x = 0.0F, y = 0.0F, w = 0.0F;
};

/// A small depth buffer that occluders are drawn into by the processor, with the farthest depth of each block of 8 x 8
/// pixels on top. Like those of games it samples the middles of its pixels: an occluder may cover a little more than
/// it should.
/// Source: Intel's sample "Software Occlusion Culling" (depth-test rasterizer) and Haar & Aaltonen's pyramid of
/// farthest depths, in plain C++ that the compiler vectorises.
class DepthRaster {
public:
    /// Rounded up to whole blocks.
    DepthRaster(int width, int height);

    /// Nothing is drawn; points nearer than `nearest`, metres and positive, will be cut off.
    void clear(float nearest);

    /// Draws a triangle that is counterclockwise in the picture; others face away and are left out.
    void draw(const ClipPoint& a, const ClipPoint& b, const ClipPoint& c);

    /// Whether everything in the rectangle around the corners' picture is nearer than the nearest of the corners.
    /// Returns: false also when a corner is nearer than the nearest plane, or none of the rectangle is in the picture.
    [[nodiscard]] bool hides(const std::array<ClipPoint, 8>& corners);

    [[nodiscard]] int width() const { return _width; }
    [[nodiscard]] int height() const { return _height; }

private:
    static constexpr int kBlock = 8;

    /// In pixels, with one over the distance, which is linear in the picture.
    struct Vertex {
        float x, y, inverse;
    };

    [[nodiscard]] Vertex onScreen(const ClipPoint& p) const;
    void fill(const Vertex& a, const Vertex& b, const Vertex& c);
    [[nodiscard]] float farthestInBlock(int column, int row);
    [[nodiscard]] bool isCovered(int left, int right, int bottom, int top, float inverse) const;

    int _width, _height, _blockColumns;
    float _nearest = 1.0F;
    std::vector<float> _inverses;  // of the nearest occluder in a pixel; 0: none
    std::vector<float> _blocks;    // the least of a block's
    std::vector<std::uint8_t> _isStale;
};

}  // namespace osgAnalyticBin::bench
