// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <cstdint>
#include <string>
#include <vector>

namespace osgAnalyticBin::test {

/// Least and greatest heights of the tiles of a quadtree of 16 x 8 tiles of 22.5 degrees: of a raster where there is
/// one and its cells are fine enough, below that made up by narrowing the parent's interval.
class Heights {
public:
    /// Of a raster as Tightness.cpp describes it; ends the program when it cannot be read. "": all made up.
    explicit Heights(const std::string& file);

    [[nodiscard]] core::Interval root(int row, int column) const;
    [[nodiscard]] core::Interval child(const core::Interval& parent, int level, int row, int column) const;

    /// Height of the ground that an eye is to stand above there, metres.
    [[nodiscard]] double groundAt(const core::Geodetic& position) const;

private:
    [[nodiscard]] core::Interval ofCells(int level, int row, int column) const;

    std::vector<std::int16_t> _cells;
};

}  // namespace osgAnalyticBin::test
