// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Heights.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <support/View.h>

namespace osgAnalyticBin::test {

/// Ways to cull tiles; all but kBoxHorizonPoint leave out what a core::HorizonBin says is hidden.
enum Method : std::size_t {
    kSphere,
    kBoxHorizonPoint,
    kCorners,
    kPaper,
    kQuadratic,
    kExact,
    kExactReverse,
    kExactHull,
    kExactReverseHull,
    kQuadraticReverseHull,
    kMethods
};
inline constexpr std::array<const char*, kMethods> kMethodNames{"sphere", "box+point", "corners", "paper", "quadratic",
                                                                "exact",  "+edges",    "+hull",   "+both", "quad+both"};

/// Leaves of the quadtree, from one camera or more.
struct Counts {
    std::uint64_t truth = 0;
    std::array<std::uint64_t, kMethods> kept{}, missed{};
    std::uint64_t hidden = 0, hiddenFound = 0;  // tiles of all levels in the frustum that are truly hidden

    void add(const Counts& other) {
        truth += other.truth;
        hidden += other.hidden;
        hiddenFound += other.hiddenFound;
        for (std::size_t m = 0; m < kMethods; ++m) {
            kept[m] += other.kept[m];
            missed[m] += other.missed[m];
        }
    }
};

/// Goes down a quadtree of 16 x 8 tiles that is refined by distance. `depth`: of the occluder, metres.
[[nodiscard]] Counts countLeaves(const View& view, const Heights& heights, double depth);

}  // namespace osgAnalyticBin::test
