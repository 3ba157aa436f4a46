// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

#include <array>

namespace osgAnalyticBin {

/// The surface of one tile, without tiles that are paged below it and without skirts.
struct TileSurface {
    /// Extents, and altitudes at vertical scale 1, chords between posts included; sag() says how much of the depth is
    /// chords. margin() is the rounding of float vertices. Not valid(): the node is no geocentric terrain, or its
    /// bounds cannot be computed.
    AnalyticBin bin;
    /// Metres: lower bounds of the surface's altitude along its south, east, north and west edge, chords included.
    std::array<double, 4> edgeLow{};
    /// The greatest length of skirts below the surface in metres, at any vertical scale; 0: no skirts, or skirts that
    /// cannot be told from the surface and are in `bin`.
    double skirt = 0.0;
    /// The tile draws nothing; `bin` is not valid then.
    bool isEmpty = false;
    /// An osgTerrain tile, whose heights follow osgTerrain::Terrain's vertical scale.
    bool isScalable = false;
    /// In the plane of a map.
    bool isInMap = false;
};

}  // namespace osgAnalyticBin
