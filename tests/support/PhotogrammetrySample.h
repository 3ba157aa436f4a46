// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// A set of oblique photogrammetry as ContextCapture lays it out, made by a formula: hills with towers.
struct PhotogrammetrySample {
    /// The level from which on the meshes have the towers.
    int towersFrom = 0;
    /// Two nodes have spheres that do not hold their vertices: a root, and one two levels below. The others hold those
    /// of all levels.
    bool hasFalseSpheres = true;
};

/// Writes the tiles of the set into a folder that exists. Returns: false when they cannot be written.
[[nodiscard]] bool writePhotogrammetrySample(const std::string& folder, const PhotogrammetrySample& sample = {});

}  // namespace osgAnalyticBin::test
