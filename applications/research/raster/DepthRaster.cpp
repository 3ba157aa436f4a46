// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DepthRaster.h"

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::bench {

namespace {

int roundedUp(int pixels, int block) {
    return (pixels + block - 1) / block * block;
}

ClipPoint cut(const ClipPoint& inside, const ClipPoint& outside, float w) {
    const float share = (inside.w - w) / (inside.w - outside.w);
    return {inside.x + share * (outside.x - inside.x), inside.y + share * (outside.y - inside.y), w};
}

/// Where an edge of a counterclockwise triangle crosses a row: on its left side, or on its right.
class Edge {
public:
    Edge(float fromX, float fromY, float toX, float toY)
        : _isLeft(toY < fromY),
          _isRight(toY > fromY),
          _perRow(fromY == toY ? 0.0F : (toX - fromX) / (toY - fromY)),
          _atZero(fromX - _perRow * fromY) {}

    // What is level is above or below all rows of the triangle.
    void cut(float row, float& first, float& last) const {
        const float x = _atZero + _perRow * row;
        if (_isLeft) first = std::max(first, x);
        if (_isRight) last = std::min(last, x);
    }

private:
    bool _isLeft, _isRight;
    float _perRow, _atZero;
};

}  // namespace

DepthRaster::DepthRaster(int width, int height)
    : _width(roundedUp(width, kBlock)),
      _height(roundedUp(height, kBlock)),
      _blockColumns(_width / kBlock),
      _inverses(static_cast<std::size_t>(_width) * static_cast<std::size_t>(_height)),
      _blocks(_inverses.size() / (kBlock * kBlock)),
      _isStale(_blocks.size()) {}

void DepthRaster::clear(float nearest) {
    _nearest = nearest;
    std::fill(_inverses.begin(), _inverses.end(), 0.0F);
    std::fill(_blocks.begin(), _blocks.end(), 0.0F);
    std::fill(_isStale.begin(), _isStale.end(), std::uint8_t{0});
}

DepthRaster::Vertex DepthRaster::onScreen(const ClipPoint& p) const {
    const float inverse = 1.0F / p.w;
    return {0.5F * static_cast<float>(_width) * (1.0F + p.x * inverse),
            0.5F * static_cast<float>(_height) * (1.0F + p.y * inverse), inverse};
}

void DepthRaster::draw(const ClipPoint& a, const ClipPoint& b, const ClipPoint& c) {
    const std::array<ClipPoint, 3> corners{a, b, c};
    std::array<Vertex, 4> vertices;
    std::size_t count = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const ClipPoint& from = corners[i];
        const ClipPoint& to = corners[(i + 1) % corners.size()];
        const bool isIn = from.w >= _nearest;
        if (isIn) vertices[count++] = onScreen(from);
        if (isIn != (to.w >= _nearest))
            vertices[count++] = onScreen(isIn ? cut(from, to, _nearest) : cut(to, from, _nearest));
    }
    for (std::size_t i = 2; i < count; ++i) fill(vertices[0], vertices[i - 1], vertices[i]);
}

void DepthRaster::fill(const Vertex& a, const Vertex& b, const Vertex& c) {
    const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (!(area > 0.0F)) return;
    const auto width = static_cast<float>(_width);
    const auto height = static_cast<float>(_height);
    // middles of rows and columns stand at halves
    const float lowest = std::ceil(std::max(0.0F, std::min({a.y, b.y, c.y})) - 0.5F);
    const float highest = std::floor(std::min(height, std::max({a.y, b.y, c.y})) - 0.5F);
    const float left = std::max(0.0F, std::min({a.x, b.x, c.x}));
    const float right = std::min(width, std::max({a.x, b.x, c.x}));
    if (!(left < right)) return;
    const float alongX = ((b.inverse - a.inverse) * (c.y - a.y) - (c.inverse - a.inverse) * (b.y - a.y)) / area;
    const float alongY = ((c.inverse - a.inverse) * (b.x - a.x) - (b.inverse - a.inverse) * (c.x - a.x)) / area;
    const std::array<Edge, 3> edges{Edge(a.x, a.y, b.x, b.y), Edge(b.x, b.y, c.x, c.y), Edge(c.x, c.y, a.x, a.y)};
    for (float middle = lowest + 0.5F; middle <= highest + 0.5F; middle += 1.0F) {
        float begin = left;
        float end = right;
        for (const Edge& edge : edges) edge.cut(middle, begin, end);
        const int first = static_cast<int>(std::ceil(begin - 0.5F));
        const int last = static_cast<int>(std::floor(end - 0.5F));
        if (first > last) continue;
        const int row = static_cast<int>(middle);
        const float base = a.inverse + alongY * (middle - a.y) + alongX * (0.5F - a.x);
        float* const pixels = &_inverses[static_cast<std::size_t>(row) * static_cast<std::size_t>(_width)];
        for (int x = first; x <= last; ++x) pixels[x] = std::max(pixels[x], base + alongX * static_cast<float>(x));
        std::uint8_t* const stale = &_isStale[static_cast<std::size_t>(row / kBlock * _blockColumns)];
        for (int x = first / kBlock; x <= last / kBlock; ++x) stale[x] = 1;
    }
}

float DepthRaster::farthestInBlock(int column, int row) {
    const auto block = static_cast<std::size_t>(row * _blockColumns + column);
    if (_isStale[block] == 0) return _blocks[block];
    std::array<float, kBlock> least;
    const float* pixels = &_inverses[static_cast<std::size_t>(row * kBlock * _width + column * kBlock)];
    std::copy_n(pixels, kBlock, least.begin());
    for (int y = 1; y < kBlock; ++y) {
        pixels += _width;
        for (std::size_t x = 0; x < kBlock; ++x) least[x] = std::min(least[x], pixels[x]);
    }
    _isStale[block] = 0;
    return _blocks[block] = *std::min_element(least.begin(), least.end());
}

bool DepthRaster::isCovered(int left, int right, int bottom, int top, float inverse) const {
    for (int y = bottom; y <= top; ++y) {
        const float* const row = &_inverses[static_cast<std::size_t>(y) * static_cast<std::size_t>(_width)];
        if (std::any_of(row + left, row + right + 1, [&](float covered) { return covered <= inverse; })) return false;
    }
    return true;
}

bool DepthRaster::hides(const std::array<ClipPoint, 8>& corners) {
    Vertex low = onScreen(corners[0]);
    Vertex high = low;
    for (const ClipPoint& corner : corners) {
        if (!(corner.w >= _nearest)) return false;
        const Vertex p = onScreen(corner);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), low.inverse};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.inverse, p.inverse)};
    }
    const auto pixel = [](float at, int size) {
        return static_cast<int>(std::floor(std::clamp(at, 0.0F, static_cast<float>(size) - 0.5F)));
    };
    const bool isInPicture =
        high.x > 0.0F && high.y > 0.0F && low.x < static_cast<float>(_width) && low.y < static_cast<float>(_height);
    if (!isInPicture) return false;
    const int left = pixel(low.x, _width);
    const int right = pixel(high.x, _width);
    const int bottom = pixel(low.y, _height);
    const int top = pixel(high.y, _height);
    for (int row = bottom / kBlock; row <= top / kBlock; ++row) {
        for (int column = left / kBlock; column <= right / kBlock; ++column) {
            if (farthestInBlock(column, row) > high.inverse) continue;
            const int x = column * kBlock;
            const int y = row * kBlock;
            if (!isCovered(std::max(left, x), std::min(right, x + kBlock - 1), std::max(bottom, y),
                           std::min(top, y + kBlock - 1), high.inverse))
                return false;
        }
    }
    return true;
}

}  // namespace osgAnalyticBin::bench
