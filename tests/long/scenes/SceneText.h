// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Descriptions as text: a line for each database, part and frame, with what is not as in a plain one.
//
//     database rows=2 levels=1 options=occlusion=on,edges=off
//     tower hook=own tile=0.0.3.2 frame=2 low=-500 high=30000
//     view eye=6878137,0,0 at=0,0,0 up=0,0,1 frustum=-0.2,0.2,-0.2,0.2,1,1e8
//     expect spheres=52 bins=31

#pragma once

#include "Description.h"

#include <istream>
#include <optional>

namespace osgAnalyticBin::test {

/// Drawables that are delivered in all frames of a scene, without bins and with them.
struct Expectation {
    int spheres = 0, bins = 0;

    [[nodiscard]] bool operator==(const Expectation& other) const {
        return spheres == other.spheres && bins == other.bins;
    }
};

struct NamedScene {
    Description description;
    std::optional<Expectation> expected;
};

/// Throws std::runtime_error with the line that cannot be read. Lines that begin with # are remarks.
[[nodiscard]] NamedScene readScene(std::istream& in);

[[nodiscard]] std::string toText(const Part& part);
[[nodiscard]] std::string toText(const Description& description);
[[nodiscard]] std::string toText(const Expectation& expectation);

}  // namespace osgAnalyticBin::test
