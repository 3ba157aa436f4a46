// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MethodFigures.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

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

Json sumOf(const MethodFigures& method, const PathGroup& group) {
    Json sum = method.rows[group.poses.front()];
    for (std::size_t i = 1; i < group.poses.size(); ++i) {
        for (const auto& [column, value] : method.rows[group.poses[i]].items()) {
            Json& total = sum[column];
            if (value.is_number_float())
                total = total.get<double>() + value.get<double>();
            else
                total = total.get<std::uint64_t>() + value.get<std::uint64_t>();
        }
    }
    return sum;
}

Json sumOf(const MethodFigures& method) {
    PathGroup all{{}, std::vector<std::size_t>(method.rows.size())};
    std::iota(all.poses.begin(), all.poses.end(), std::size_t{0});
    return sumOf(method, all);
}

}  // namespace osgAnalyticBin::report
