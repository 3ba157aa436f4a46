// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Heights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <support/Random.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

using core::Interval;

namespace {

constexpr std::size_t kColumns = 576, kLines = 288;
constexpr int kFinestRasterLevel = 5;
constexpr double kLowestBelievable = -11500.0;

Interval narrowed(const Interval& parent, int level, int row, int column) {
    Random random((static_cast<std::uint64_t>(level) << 56) ^ (static_cast<std::uint64_t>(row) << 28) ^
                      static_cast<std::uint64_t>(column),
                  7);
    const double width = parent.width() * random.uniform(0.5, 0.8);
    const double lower = parent.lower + random.uniform() * (parent.width() - width);
    return {lower, lower + width};
}

}  // namespace

Heights::Heights(const std::string& file) {
    if (file.empty()) return;
    std::ifstream stream(file, std::ios::binary);
    _cells.resize(2 * kColumns * kLines);
    stream.read(reinterpret_cast<char*>(_cells.data()), static_cast<std::streamsize>(_cells.size() * 2));
    if (!stream) {
        std::fprintf(stderr, "cannot read %s\n", file.c_str());
        std::exit(EXIT_FAILURE);
    }
}

Interval Heights::root(int row, int column) const {
    return _cells.empty() ? narrowed({-11000.0, 9000.0}, 0, row, column) : ofCells(0, row, column);
}

Interval Heights::child(const Interval& parent, int level, int row, int column) const {
    if (!_cells.empty() && level <= kFinestRasterLevel) return ofCells(level, row, column);
    return narrowed(parent, level, row, column);
}

double Heights::groundAt(const core::Geodetic& position) const {
    Interval heights;
    for (int level = 0; level <= 10; ++level) {
        const double deg = std::ldexp(kRootTileDeg, -level);
        const auto row = static_cast<int>((position.latitude / kRadiansPerDegree + 90.0) / deg);
        const auto column = static_cast<int>((position.longitude / kRadiansPerDegree + 180.0) / deg);
        heights = level == 0 ? root(row, column) : child(heights, level, row, column);
    }
    return std::max(0.0, heights.upper);
}

Interval Heights::ofCells(int level, int row, int column) const {
    const double cells = 36.0 / std::ldexp(1.0, level);  // a tile is this many cells wide
    const auto first = [&](int i) { return static_cast<std::size_t>(std::floor(i * cells)); };
    const auto last = [&](int i) { return static_cast<std::size_t>(std::ceil((i + 1) * cells)); };
    Interval result{1e9, -1e9};
    for (std::size_t y = first(row); y < std::min(kLines, last(row)); ++y) {
        for (std::size_t x = first(column); x < std::min(kColumns, last(column)); ++x) {
            const std::size_t cell = (kLines - 1 - y) * kColumns + x;
            result.lower = std::min(result.lower, std::max<double>(_cells[cell], kLowestBelievable));
            result.upper = std::max<double>(result.upper, _cells[cell + kColumns * kLines]);
        }
    }
    return result;
}

}  // namespace osgAnalyticBin::test
