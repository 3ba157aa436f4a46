// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Shape>
#include <osgTerrain/Layer>

#include <array>
#include <limits>

namespace osgAnalyticBin {

/// The lowest and highest valid posts of an elevation layer, metres; low > high when there are none.
struct HeightRange {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    /// Lowest posts of the first row, last column, last row and first column. Where posts are missing the mesh has
    /// other edges than its rectangle: `low` then.
    std::array<double, 4> edgeLow{};
    /// No valid post is infinite or not a number.
    bool isFinite = true;

    [[nodiscard]] static HeightRange flat() { return {0.0, 0.0, {}, true}; }
};

/// Cost: one pass over the floats, or as many virtual calls where a ValidDataOperator of unknown kind picks them.
[[nodiscard]] HeightRange heightRange(const osgTerrain::Layer& layer, const osg::HeightField& field);

/// The same of any layer, by its virtual functions.
[[nodiscard]] HeightRange heightRange(const osgTerrain::Layer& layer);

}  // namespace osgAnalyticBin
