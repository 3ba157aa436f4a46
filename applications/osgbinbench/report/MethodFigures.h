// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Table.h"

#include <cstddef>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// What was measured of one method: a row for each pose, or a single one for a flight. All rows have the same columns,
/// which are numbers.
struct MethodFigures {
    std::string method;
    std::vector<Json> rows;
};

/// Poses that belong together: their names share the text before the first `_`, or without one all but the number at
/// their end. This names the path.
struct PathGroup {
    std::string name;
    std::vector<std::size_t> poses;  ///< places in the list of poses
};

/// The groups in the order in which their first poses come; every pose is in one.
[[nodiscard]] std::vector<PathGroup> pathGroupsOf(const std::vector<std::string>& poses);

/// The sums of the columns over the poses of one group, or over all rows. Requires: at least one row.
[[nodiscard]] Json sumOf(const MethodFigures& method, const PathGroup& group);
[[nodiscard]] Json sumOf(const MethodFigures& method);

}  // namespace osgAnalyticBin::report
