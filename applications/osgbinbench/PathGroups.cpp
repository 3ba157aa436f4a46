// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PathGroups.h"

#include <algorithm>

namespace osgAnalyticBin::bench {

std::vector<PathGroup> pathGroupsOf(const std::vector<std::string>& poses) {
    std::vector<PathGroup> groups;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const std::string name = poses[i].substr(0, poses[i].find('_'));
        auto group = std::find_if(groups.begin(), groups.end(), [&](const PathGroup& g) { return g.name == name; });
        if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
        group->poses.push_back(i);
    }
    return groups;
}

Figures sumOf(const MethodFigures& method, const PathGroup& group) {
    Figures sum;
    for (const std::size_t pose : group.poses) sum += method.poses[pose];
    return sum;
}

}  // namespace osgAnalyticBin::bench
