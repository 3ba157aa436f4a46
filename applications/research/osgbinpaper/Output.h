// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"

#include <iosfwd>
#include <string>

namespace osgAnalyticBin::paper {

/// A line for each kind of view, level and method, after a line of column names; counts only, the same for the same
/// seed.
[[nodiscard]] std::string csvOf(const Results& results, int levels);

/// An object: the settings, "methods" with sums over all views, "views" with the same for each, "worst".
[[nodiscard]] std::string jsonOf(const Settings& settings, const Results& results);

/// The tables, by view and by level.
void printTables(std::ostream& output, const Results& results, int levels);

}  // namespace osgAnalyticBin::paper
