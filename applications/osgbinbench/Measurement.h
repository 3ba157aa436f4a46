// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {

/// One method's figures, by column, as a file of --json holds them.
struct MeasuredMethod {
    std::string name;
    std::map<std::string, double> sums;
    std::map<std::string, std::vector<double>> byPose;  ///< empty, or a figure for each pose
};

/// A file of --json.
struct Measurement {
    std::string file;
    std::vector<std::pair<std::string, std::string>> conditions;  ///< how it was measured: key and value, as JSON
    std::string mode;
    std::vector<std::string> poseNames;
    std::vector<MeasuredMethod> methods;  ///< in the file's order
    std::vector<MeasuredMethod> live;     ///< with the pager running; empty where that was not measured
};

/// Throws: Failure, one line with the file's name, when it cannot be read or does not hold what osgbinbench writes.
[[nodiscard]] Measurement measurementFromFile(const std::string& file);

}  // namespace osgAnalyticBin::bench
