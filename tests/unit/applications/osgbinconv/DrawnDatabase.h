// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace osgAnalyticBin::test {

/// A tile of a database, as OpenSceneGraph reads it.
struct DrawnTile {
    std::string file;
    std::size_t ordinal = 0;
    /// Indices of all tiles above it, the nearest first.
    std::vector<std::size_t> ancestors;
    /// Metres that its skirts hang down.
    double skirt = 0.0;
    double low = 0.0;
    double high = 0.0;
    std::uint64_t fingerprint = 0;
    /// What the file itself says; not valid: nothing.
    AnalyticBin storedBin;
    /// Points of what it draws itself, skirts left out: some all over, and all along its edges.
    std::vector<glm::dvec3> samples;
    std::vector<core::Geodetic> edgeSamples;

    [[nodiscard]] bool isAbove(std::size_t self, const DrawnTile& other) const;
};

/// All tiles of a local database, each file read by its name.
[[nodiscard]] std::vector<DrawnTile> readAllTiles(const std::string& rootFile);

/// The ellipsoid of all databases here.
[[nodiscard]] core::Ellipsoid ellipsoidOfTests();

}  // namespace osgAnalyticBin::test
