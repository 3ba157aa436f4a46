// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Descriptions as text: a line for each database, part and frame, with the fields that differ from the default. A view
// starts from the view before it.
//
//     database rows=2 levels=1 options=occlusion=on,edges=off
//     tower hook=own tile=0.0.3.2 frame=2 low=-500 high=30000
//     view eye=6878137,0,0 at=0,0,0 up=0,0,1 frustum=-0.2,0.2,-0.2,0.2,1,1e8
//     expect spheres=52 bins=31      or: expect culled=20 (at least)
//
// Bars separate values, as in hook=tile|globe: each makes a scene of its own, several such fields all combinations.

#pragma once

#include "Description.h"

#include <istream>

namespace osgAnalyticBin::test {

/// Numbers of drawables that all frames of a scene together deliver. A field below 0 is not compared.
struct Expectation {
    int spheres = -1;  ///< without bins
    int bins = -1;     ///< with them
    int culled = -1;   ///< how many fewer with them, at least

    [[nodiscard]] bool holdsFor(int withSpheres, int withBins) const {
        return (spheres < 0 || spheres == withSpheres) && (bins < 0 || bins == withBins) &&
               (culled < 0 || withSpheres - withBins >= culled);
    }
};

struct NamedScene {
    Description description;
    std::optional<Expectation> expected;
};

/// Throws std::runtime_error with the line that cannot be read. Lines that begin with # are remarks.
[[nodiscard]] std::vector<NamedScene> readScenes(std::istream& in);

/// Copies, each with one of the fields, or one of the options, that are not the default set back to it.
[[nodiscard]] std::vector<Part> simpler(const Part& part);
[[nodiscard]] std::vector<DatabaseSpec> simpler(const DatabaseSpec& database);

[[nodiscard]] std::string toText(const Part& part);
[[nodiscard]] std::string toText(const Description& description);
[[nodiscard]] std::string toText(const Expectation& expectation);

}  // namespace osgAnalyticBin::test
