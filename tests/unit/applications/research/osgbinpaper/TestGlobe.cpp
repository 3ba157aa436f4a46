// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TestGlobe.h"

#include <gdal.h>

#include <cmath>
#include <sstream>

namespace osgAnalyticBin::paper {

double hills(double latitudeDeg, double longitudeDeg) {
    constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
    const double p = latitudeDeg * kRadiansPerDegree;
    const double l = longitudeDeg * kRadiansPerDegree;
    return 3000.0 * std::sin(7.0 * p + std::sin(3.0 * l)) + 2000.0 * std::cos(5.0 * l) * std::cos(p) +
           1000.0 * std::sin(23.0 * p) * std::sin(19.0 * l);
}

std::string writeHills(const test::TemporaryFolder& folder, const std::string& name, double west, double south,
                       int columns, int rows, double spacing) {
    std::ostringstream text;
    text << "ncols " << columns << "\nnrows " << rows << "\nxllcorner " << west << "\nyllcorner " << south
         << "\ncellsize " << spacing << "\n";
    for (int row = rows - 1; row >= 0; --row) {
        for (int column = 0; column < columns; ++column)
            text << std::lround(hills(south + (row + 0.5) * spacing, west + (column + 0.5) * spacing)) << ' ';
        text << '\n';
    }
    return folder.write(name, text.str());
}

TestGlobe::TestGlobe() : _file(writeHills(_folder, "globe.asc", -180.0, -90.0, 180, 90, 2.0)) {
    GDALAllRegister();
}

Terrain TestGlobe::terrain(int deepestLevel) const {
    return Terrain(_file, deepestLevel);
}

}  // namespace osgAnalyticBin::paper
