// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osg/Vec3d>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::test {

/// What a line meets in a scene.
struct Picked {
    std::vector<std::string> hits;  ///< the nodes on the way to each, and where it is
    std::size_t visited = 0;        ///< nodes
};

[[nodiscard]] Picked pick(osg::Node& scene, const osg::Vec3d& from, const osg::Vec3d& to);

/// Compares picks with bins and without. `comparesVisits`: else hits alone. Returns: what is wrong.
[[nodiscard]] std::optional<std::string> findPickDifference(const Picked& without, const Picked& with,
                                                            bool comparesVisits);

}  // namespace osgAnalyticBin::test
