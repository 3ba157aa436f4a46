// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

namespace osgAnalyticBin::scale {

/// A way to cull, by the name that the command line and the tables use: BASE[+horizon][+edges].
struct ScaleMethod {
    std::string name;
    /// For the pseudo-loader, and its name.
    std::string parameters, loader;
    /// Whether the camera culls nothing at all.
    bool cullsNothing = false;
    /// Whether what bins decide is repeated without tests: osgbinbench's oracle.
    bool replaysVerdicts = false;
};

/// Throws: Failure for an unknown name.
[[nodiscard]] ScaleMethod scaleMethodFromName(const std::string& name);

/// What the command line asks for.
struct Settings {
    std::vector<ScaleMethod> methods;
    std::vector<int> levels{4, 8, 12, 16, 20};
    std::vector<int> residents{100, 1000, 10000, 100000};
    int memoryTiles = 10000;
    int poses = 12;
    int cells = 8;
    int rounds = 15;
    bool measuresDepth = true;
    bool measuresResidents = true;
    bool measuresMemory = true;
    std::string csv;
    std::string json;
    std::string plot;
};

/// Reads the command line; --help is answered at once.
/// Returns: whether there is something to measure.
/// Throws: Failure when an option is unknown, malformed or out of range.
[[nodiscard]] bool settingsFromCommandLine(int argc, char** argv, Settings& settings);

}  // namespace osgAnalyticBin::scale
