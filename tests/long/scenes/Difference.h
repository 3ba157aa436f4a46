// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <optional>
#include <string>

namespace osgAnalyticBin::test {

/// How two nodes differ.
struct Difference {
    std::string what;
    std::string text;
};

/// Compares a scene that never had bins with one that they were taken off again: culling flags, callbacks, user values,
/// expiry times and structure. Both may have been saved and read.
/// Returns: the first difference of the first of these kinds in which they differ, nullopt when there is none.
[[nodiscard]] std::optional<Difference> findDifference(osg::Node& without, osg::Node& with, bool wereSaved);

}  // namespace osgAnalyticBin::test
