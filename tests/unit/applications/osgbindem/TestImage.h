// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseWalk.h"

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
    double west = 0.0;
    double north = 0.0;
    double spacingDeg = 1.0;
    int pixels = 1;
    /// nullopt: a hole. With a palette there is one colour.
    std::function<std::optional<Colour>(double latitudeDeg, double longitudeDeg)> colourAt;
    Hole hole = Hole::Alpha;

    /// Round the globe: 2 `rows` by `rows` pixels.
    [[nodiscard]] static TestImage globe(double spacingDeg, const Colour& colour);
    [[nodiscard]] static TestImage square(double west, double north, double spacingDeg, int pixels,
                                          const Colour& colour);

    void write(const std::string& path) const;
};

/// The image of a tile's texture; nullptr without one.
[[nodiscard]] const osg::Image* textureOf(const LoadedTile& tile);

/// What a tile shows at its texel nearest to the position.
[[nodiscard]] Colour shownAt(const LoadedTile& tile, double latitudeDeg, double longitudeDeg);
/// What the finest tile there shows.
[[nodiscard]] Colour shownAt(const LoadedDatabase& database, double latitudeDeg, double longitudeDeg);
