// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// Makes a globe with osgbindem: 128 start tiles and two finer levels in 640 files of some 20 kB.
/// Returns: whether FOLDER/earth.osgb is there.
bool makeSmallGlobe(const std::string& folder);

}  // namespace osgAnalyticBin::test
