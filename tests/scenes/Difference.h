// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <optional>
#include <string>

namespace osgAnalyticBin::test {

/// Compares a scene that never had bins with one that they were taken off again: structure, culling flags, callbacks,
/// user values and expiry times. `ignoresUpdate`: update callbacks may differ.
/// Returns: the first difference in words, nullopt when there is none.
[[nodiscard]] std::optional<std::string> firstDifference(osg::Node& without, osg::Node& with, bool ignoresUpdate);

}  // namespace osgAnalyticBin::test
