// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// Poses that belong together: their names share the text before the first `_`, or without one all but the number at
/// their end. This names the path.
struct PathGroup {
    std::string name;
    std::vector<std::size_t> poses;  ///< places in the list of poses
};

/// The groups in the order in which their first poses come; every pose is in one.
[[nodiscard]] std::vector<PathGroup> pathGroupsOf(const std::vector<std::string>& poses);

}  // namespace osgAnalyticBin::report
