// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PathGroups.h"

#include <algorithm>

namespace osgAnalyticBin::report {

std::vector<PathGroup> pathGroupsOf(const std::vector<std::string>& poses) {
    std::vector<PathGroup> groups;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        std::string name = poses[i].substr(0, poses[i].find('_'));
        // recorded flights number their poses
        const std::size_t word = name.find_last_not_of("0123456789");
        if (name == poses[i] && word != std::string::npos) name.resize(word + 1);
        auto group = std::find_if(groups.begin(), groups.end(), [&](const PathGroup& g) { return g.name == name; });
        if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
        group->poses.push_back(i);
    }
    return groups;
}

}  // namespace osgAnalyticBin::report
