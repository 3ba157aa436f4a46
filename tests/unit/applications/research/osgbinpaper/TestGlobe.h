// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Terrain.h"

#include <gdal.h>

#include <cmath>
#include <sstream>
#include <string>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::paper {

/// Mountains and seas that differ everywhere, from -6000 to 6000 m.
[[nodiscard]] inline double hills(double latitudeDeg, double longitudeDeg) {
    constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
    const double p = latitudeDeg * kRadiansPerDegree;
    const double l = longitudeDeg * kRadiansPerDegree;
    return 3000.0 * std::sin(7.0 * p + std::sin(3.0 * l)) + 2000.0 * std::cos(5.0 * l) * std::cos(p) +
           1000.0 * std::sin(23.0 * p) * std::sin(19.0 * l);
}

/// A raster of the hills as a text file in a folder of its own, `spacing` degrees apart, from the south-west corner on;
/// round the globe unless told otherwise.
class TestGlobe {
public:
    explicit TestGlobe(double west = -180.0, double south = -90.0, int columns = 180, int rows = 90,
                       double spacing = 2.0) {
        GDALAllRegister();
        std::ostringstream text;
        text << "ncols " << columns << "\nnrows " << rows << "\nxllcorner " << west << "\nyllcorner " << south
             << "\ncellsize " << spacing << "\n";
        for (int i = rows * columns - 1; i >= 0; --i) {
            const int row = i / columns, column = columns - 1 - i % columns;
            text << std::lround(hills(south + (row + 0.5) * spacing, west + (column + 0.5) * spacing)) << ' ';
        }
        _file = _folder.write("hills.asc", text.str());
    }

    [[nodiscard]] const std::string& file() const { return _file; }

    /// Its terrain, with levels 0 to `deepestLevel`.
    [[nodiscard]] Terrain terrain(int deepestLevel) const { return Terrain(_file, deepestLevel); }

private:
    test::TemporaryFolder _folder;
    std::string _file;
};

}  // namespace osgAnalyticBin::paper
