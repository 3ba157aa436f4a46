// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Failure.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

/// One elevation raster as named on the command line.
struct DemInput {
    std::string path;
    /// Metres per unit of the raster's heights; without it, what the raster declares.
    std::optional<double> metresPerUnit = std::nullopt;
};

/// Everything the command line says.
struct Settings {
    std::vector<DemInput> dems;
    std::optional<double> nodata;
    /// What heights are above: "none" (as they are), "egm96", a file with a grid; empty: as the rasters say.
    std::string geoid;
    /// Metres over which a raster or an image gives way to coarser ones at its border, 0 for none; without it by the
    /// rasters.
    std::optional<double> blend;
    std::vector<std::string> images;
    /// The band that has the heights in elevation rasters.
    std::optional<int> band;
    std::string output;
    osgAnalyticBin::core::Ellipsoid ellipsoid{1.0, 1.0};
    /// Whether the radii are those of a default osg::EllipsoidModel.
    bool isWgs84 = true;
    bool areRadiiGiven = false;
    /// The part of the earth that is built; all of it without. East is greater than west, and may pass 180.
    std::optional<RectDeg> region;
    /// Levels below the start tiles of a whole globe.
    std::optional<int> levels;
    /// Cells along a tile's edge.
    std::optional<int> cells;
    double lodFactor = 4.0;
    /// Without it, one for each core.
    std::optional<int> threads;
    /// For what is read of the rasters, in MiB: GDAL's cache and the blocks of all threads.
    int memoryMib = 256;
    /// Read a raster's overview where that is as fine as the finest tiles.
    bool useOverviews = true;
    bool compress = false;
    /// Tiles are stored as grids of heights, not as meshes.
    bool packed = false;
    /// Build only what differs from the database that is there.
    bool update = false;
    bool quiet = false;
    /// Whether a finished database of the output's name may be replaced.
    bool overwrite = false;
};

/// Reads the command line, the program's name first. No raster is opened.
/// Returns: nullopt after help or version was printed. Throws Failure.
[[nodiscard]] std::optional<Settings> settingsFrom(int argc, const char* const* argv);

}  // namespace osgbindem
