// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// A set of oblique photogrammetry as ContextCapture lays it out, made by a formula: hills with towers, textured.
struct PhotogrammetrySample {
    int tilesPerSide = 3;
    /// Levels of detail of a tile. The finest are below a chain of single children, then four children each.
    int levels = 4;
    std::string srs = "ENU:47.5,11.2";
    std::string origin = "0,0,0";
    double tileMetres = 200.0;
    unsigned int textureSize = 32;
    /// The level from which on the meshes have the towers.
    int towersFrom = 0;
    /// Two nodes have spheres that do not hold their vertices: a root, and one two levels below. The others hold those
    /// of all levels.
    bool hasFalseSpheres = true;
};

/// The tile whose root has a false sphere, and the file in which another node has one.
inline constexpr const char* kTileWithFalseSphere = "Data/Tile_+001_+001/Tile_+001_+001.osgb";
inline constexpr const char* kFileWithFalseSphere = "Data/Tile_+000_+001/Tile_+000_+001_L2_0.osgb";

/// Writes the set into a folder that exists. Returns: the path of its metadata.xml; empty when it cannot be written.
[[nodiscard]] std::string writePhotogrammetrySample(const std::string& folder, const PhotogrammetrySample& sample = {});

/// Metres above the ground of the set's frame, at a place in it: towers are steps.
[[nodiscard]] double photogrammetryHeight(double x, double y, bool hasTowers = true);

}  // namespace osgAnalyticBin::test
