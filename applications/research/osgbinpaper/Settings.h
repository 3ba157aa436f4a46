// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Experiment.h"

#include <optional>
#include <string>

namespace osgAnalyticBin::paper {

/// Everything the command line says.
struct Settings {
    std::string dem = "/usr/share/ferret-vis/data/etopo5.cdf";
    int levels = 6;
    double floor = 0.0;  // metres
    ExperimentSettings experiment;
    std::string csv;
    std::string json;
    std::string plotFolder;
    bool isQuiet = false;
};

/// Reads the command line. Returns: nullopt when it asked for the help or the version, which are printed then.
/// Throws: UsageError.
[[nodiscard]] std::optional<Settings> readSettings(int argc, char** argv);

}  // namespace osgAnalyticBin::paper
