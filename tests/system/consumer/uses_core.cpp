// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The mathematics without OpenSceneGraph: is a tile in front of a plane? A box without an end is none.

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <cstdlib>
#include <limits>

int main() {
    using namespace osgAnalyticBin::core;
    const GeodeticMapping mapping(Ellipsoid(6378137.0, 6356752.314245));
    const GeodeticBin tile = GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 8848.0});
    const QuadraticBin bin(mapping, parameterBox(tile));
    const bool right = bin.classify({{1.0, 0.0, 0.0}, -6.0e6}) == Side::Inside &&
                       bin.classify({{1.0, 0.0, 0.0}, -6.5e6}) == Side::Outside;
    const GeodeticBin endless({0.0, 1.0}, {0.0, std::numeric_limits<double>::infinity()}, {0.0, 1.0});
    return right && endless.empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
