// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "LoadedDatabase.h"

#include <array>
#include <functional>
#include <optional>
#include <string>

/// Red, green, blue.
using Colour = std::array<int, 3>;

/// How a file says that it has no pixel somewhere.
enum class Hole { Alpha, Mask, Nodata, Palette };

/// An image, square degree by square degree: `pixels` by `pixels` from the north-west corner on.
struct TestImage {
    TestImage(double westDeg, double northDeg, double pixelDeg, int side, const Colour& colour);

    /// Round the globe: twice as many columns as rows.
    [[nodiscard]] static TestImage globe(double spacingDeg, const Colour& colour);

    /// Writes a file. Returns: its path.
    std::string write(const std::string& path) const;

    double west, north, spacingDeg;
    int pixels;
    /// nullopt: a hole. With a palette there is one colour.
    std::function<std::optional<Colour>(double latitudeDeg, double longitudeDeg)> colourAt;
    Hole hole = Hole::Alpha;
};

/// The image of a tile's texture; nullptr without one.
[[nodiscard]] const osg::Image* textureOf(const LoadedTile& tile);

/// What a tile shows at its texel nearest to the position.
[[nodiscard]] Colour shownAt(const LoadedTile& tile, double latitudeDeg, double longitudeDeg);
/// What the finest tile there shows.
[[nodiscard]] Colour shownAt(const LoadedDatabase& database, double latitudeDeg, double longitudeDeg);
