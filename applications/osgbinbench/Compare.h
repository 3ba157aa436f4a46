// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <iosfwd>
#include <string>

namespace osgAnalyticBin::bench {

/// The rule by which figures are judged, for people, several lines.
[[nodiscard]] std::string comparisonRule();

/// Compares two files of --json, method by method and figure by figure, and prints what changed and whether it is
/// beyond noise, by comparisonRule(). What was measured otherwise (database, options, size) is one warning.
/// Returns: whether something is worse.
/// Throws: Failure when a file cannot be read, is not of osgbinbench, or the two have no poses or methods in common.
[[nodiscard]] bool compareFiles(const std::string& oldFile, const std::string& newFile, std::ostream& output);

}  // namespace osgAnalyticBin::bench
