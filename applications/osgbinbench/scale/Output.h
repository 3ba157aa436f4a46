// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Series.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace osgAnalyticBin::scale {

/// All that was measured; empty where it was not asked for.
struct Results {
    std::vector<DepthRow> depth;
    std::vector<ResidentRow> residents;
    std::vector<MemoryRow> memory;
};

/// A line for each method and measurement, after a line of column names; cells that do not apply are empty.
[[nodiscard]] std::string csvOf(const Results& results);

/// An object with "depth", "residents" and "memory", each a list of objects with the columns of the table, and
/// "ratios": for each method, cull time for each drawn tile of the deepest globe to that of 8 levels (or the shallowest
/// measured), and cull time with the most PagedLODs to that with the fewest.
[[nodiscard]] std::string jsonOf(const Settings& settings, const Results& results);

/// For people.
void printTables(std::ostream& output, const Results& results);

/// Draws depth (time for each drawn tile), flight (time of the whole flight), residents and memory into a folder, each
/// as .svg and .png, with its data (.csv) and the script that draws it (.gp). Throws: Failure.
void plot(const std::string& folder, const Results& results);

}  // namespace osgAnalyticBin::scale
