// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Experiment.h"

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

/// Reads the command line; prints the help and ends the program when that is asked for.
/// Throws: osgbindem::Failure with one line that says what is wrong.
[[nodiscard]] Settings readSettings(int argc, char** argv);

}  // namespace osgAnalyticBin::paper
