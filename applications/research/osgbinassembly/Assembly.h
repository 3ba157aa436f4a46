// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Part.h"

#include <osg/Group>

#include <cstdint>
#include <vector>

namespace osgAnalyticBin::assembly {

/// A plant: modules in a square grid, each turned at random, with pipe routes of straight pieces and bends and a hull
/// of curved panels.
struct Assembly {
    osg::ref_ptr<osg::Group> scene;
    std::vector<Part> parts;
    /// Half of the ground's side, in metres; the ground is about the origin, z up.
    double halfExtent = 0.0;
};

/// As many modules as it takes for this many parts.
[[nodiscard]] Assembly buildAssembly(std::size_t parts, std::uint32_t seed);

}  // namespace osgAnalyticBin::assembly
