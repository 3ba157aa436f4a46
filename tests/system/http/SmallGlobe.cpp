// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SmallGlobe.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <support/StockPrograms.h>

namespace osgAnalyticBin::test {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Hills of 0 to 3000 m, a post a degree, as an ESRI ASCII grid.
void writeHills(const std::string& file) {
    std::ofstream grid(file);
    grid << "ncols 360\nnrows 180\nxllcorner -180\nyllcorner -90\ncellsize 1\n";
    for (int row = 0; row < 180; ++row) {
        const double latitude = (89.5 - row) * kDegree;
        for (int column = 0; column < 360; ++column) {
            const double longitude = (column - 179.5) * kDegree;
            grid << std::lround(1500.0 + 1500.0 * std::sin(7.0 * latitude) * std::cos(11.0 * longitude)) << ' ';
        }
        grid << '\n';
    }
}

}  // namespace

bool makeSmallGlobe(const std::string& folder) {
    const std::string grid = folder + "/hills.asc";
    writeHills(grid);
    const Outcome outcome = runStock(quoted(OSGBINDEM_FILE) + ' ' + quoted(grid) + " --levels 2 --cells 8 --quiet -o " +
                                         quoted(folder + "/earth.osgb"),
                                     Modules::Present);
    std::filesystem::remove(grid);
    return outcome.code == 0 && std::filesystem::exists(folder + "/earth.osgb");
}

}  // namespace osgAnalyticBin::test
