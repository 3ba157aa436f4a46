// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "HeightRange.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace osgAnalyticBin {

namespace {

// Minimum, maximum and finiteness of floats, in lanes that the compiler turns into vectors.
struct FloatRange {
    static constexpr std::size_t kLanes = 16;

    void add(const float* values, std::size_t count) {
        std::size_t i = 0;
        for (; i + kLanes <= count; i += kLanes) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const float v = values[i + lane];
                low[lane] = v < low[lane] ? v : low[lane];
                high[lane] = v > high[lane] ? v : high[lane];
                poison[lane] += v - v;  // 0 for finite values only
            }
        }
        for (; i < count; ++i) {
            low[0] = std::min(low[0], values[i]);
            high[0] = std::max(high[0], values[i]);
            poison[0] += values[i] - values[i];
        }
    }

    [[nodiscard]] double lowest() const { return static_cast<double>(*std::min_element(low, low + kLanes)); }
    [[nodiscard]] double highest() const { return static_cast<double>(*std::max_element(high, high + kLanes)); }
    [[nodiscard]] bool isFinite() const {
        return std::all_of(poison, poison + kLanes, [](float p) { return p == 0.0f; });
    }

    float low[kLanes];
    float high[kLanes];
    float poison[kLanes];

    FloatRange() {
        std::fill(low, low + kLanes, std::numeric_limits<float>::infinity());
        std::fill(high, high + kLanes, -std::numeric_limits<float>::infinity());
        std::fill(poison, poison + kLanes, 0.0f);
    }
};

double lowestOf(const float* values, std::size_t count, std::size_t stride) {
    float low = values[0];
    for (std::size_t i = 1; i < count; ++i) low = std::min(low, values[i * stride]);
    return static_cast<double>(low);
}

void include(HeightRange& range, float value) {
    range.isFinite &= std::isfinite(value);
    range.low = std::min(range.low, static_cast<double>(value));
    range.high = std::max(range.high, static_cast<double>(value));
}

HeightRange rangeOfAll(const float* values, std::size_t columns, std::size_t rows) {
    FloatRange floats;
    floats.add(values, columns * rows);
    HeightRange range{floats.lowest(), floats.highest(), {}, floats.isFinite()};
    range.edgeLow = {lowestOf(values, columns, 1), lowestOf(values + columns - 1, rows, columns),
                     lowestOf(values + columns * (rows - 1), columns, 1), lowestOf(values, rows, columns)};
    return range;
}

}  // namespace

HeightRange heightRange(const osgTerrain::Layer& layer, const osg::HeightField& field) {
    const std::size_t columns = field.getNumColumns();
    const std::size_t rows = field.getNumRows();
    if (columns == 0 || rows == 0) return {};
    const float* values = field.getFloatArray()->asVector().data();
    const osgTerrain::ValidDataOperator* isValid = layer.getValidDataOperator();
    if (!isValid) return rangeOfAll(values, columns, rows);

    HeightRange range;
    for (std::size_t i = 0; i < columns * rows; ++i)
        if ((*isValid)(values[i])) include(range, values[i]);
    range.edgeLow.fill(range.low);
    return range;
}

HeightRange heightRange(const osgTerrain::Layer& layer) {
    HeightRange range;
    for (unsigned int row = 0; row < layer.getNumRows(); ++row) {
        for (unsigned int column = 0; column < layer.getNumColumns(); ++column) {
            float value = 0.0f;
            if (layer.getValidValue(column, row, value)) include(range, value);
        }
    }
    range.edgeLow.fill(range.low);
    return range;
}

}  // namespace osgAnalyticBin
