// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TestDatabases.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin::test {

namespace {

std::string sampleFolder(const std::string& kind) {
    return SAMPLE_DATA "/vpb/" + kind;
}

std::string writeBindemDatabase(const TemporaryFolder& folder) {
    std::ofstream grid(folder / "heights.asc");
    grid << "ncols 144\nnrows 72\nxllcorner -180\nyllcorner -90\ncellsize 2.5\n";
    for (int row = 0; row < 72; ++row) {
        for (int column = 0; column < 144; ++column) {
            grid << std::round(2000.0 * std::sin(0.3 * row) * std::cos(0.4 * column)) << ' ';
        }
        grid << '\n';
    }
    grid.close();
    const Outcome made =
        runStock(test::quoted(OSGBINDEM_PROGRAM) + " --quiet --levels 1 --cells 8 " +
                     test::quoted(folder / "heights.asc") + " -o " + test::quoted(folder / "earth.osgb"),
                 Modules::Present);
    return made.code == 0 ? folder / "earth.osgb" : std::string();
}

}  // namespace

bool isAtHand(const std::string& kind) {
    return kind == "synthetic" || kind == "bindem" || std::filesystem::exists(sampleFolder(kind));
}

std::string makeDatabase(const std::string& kind, const TemporaryFolder& folder) {
    if (kind == "synthetic") return writeSyntheticDatabase(folder.path());
    if (kind == "bindem") return writeBindemDatabase(folder);
    std::filesystem::copy(sampleFolder(kind), folder.path(), std::filesystem::copy_options::recursive);
    return folder / "earth.osgb";
}

}  // namespace osgAnalyticBin::test
