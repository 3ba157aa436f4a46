// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TestRaster.h"

#include <filesystem>
#include <support/Programs.h>

namespace osgAnalyticBin::test {

/// Makes a globe with osgbindem: 128 start tiles and two finer levels in 640 files of some 20 kB.
/// Returns: whether FOLDER/earth.osgb is there.
inline bool makeSmallGlobe(const std::string& folder) {
    const std::string grid = TestRaster::globe(1.0, hills).write(folder + "/hills.tif");
    const Outcome outcome = runStock(quoted(OSGBINDEM_FILE) + ' ' + quoted(grid) + " --levels 2 --cells 8 --quiet -o " +
                                         quoted(folder + "/earth.osgb"),
                                     Modules::Present);
    std::filesystem::remove(grid);
    return outcome.code == 0 && std::filesystem::exists(folder + "/earth.osgb");
}

}  // namespace osgAnalyticBin::test
