// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Places and sizes of tiles whose surfaces the tests ask for.

#pragma once

#include "KitTest.h"

namespace osgAnalyticBin::test::surfaces {

using core::GeodeticBin;

inline const osg::ref_ptr<osg::EllipsoidModel> kModel = new osg::EllipsoidModel;
inline const core::Ellipsoid kEllipsoid(kModel->getRadiusEquator(), kModel->getRadiusPolar());

inline TileSurface surfaceOf(osg::Node& node, double sampleRatio = 1.0) {
    return tileSurface(node, *kModel, osg::Matrixd(), sampleRatio);
}

inline core::Interval altitudesOf(const std::vector<glm::dvec3>& points,
                                  const core::Ellipsoid& ellipsoid = kEllipsoid) {
    core::Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const glm::dvec3& point : points) {
        const double altitude = ellipsoid.toGeodetic(point).altitude;
        range = {std::min(range.lower, altitude), std::max(range.upper, altitude)};
    }
    return range;
}

struct TileCase {
    const char* name;
    GeodeticBin extents;
    unsigned int columns, rows;
};

// From the whole globe down to a tile of 20 metres between posts.
inline std::vector<TileCase> tileCases() {
    const auto rect = [](double south, double west, double north, double east) {
        return GeodeticBin::fromDegrees({south, north}, {west, east}, {0, 0});
    };
    return {{"globe", rect(-90, -180, 90, 180), 64, 64},      {"coarse globe", rect(-90, -180, 90, 180), 16, 9},
            {"hemisphere", rect(-90, -180, 90, 0), 64, 64},   {"north pole", rect(45, 0, 90, 90), 64, 64},
            {"south pole", rect(-90, -45, -67.5, 0), 16, 16}, {"date line", rect(40, 170, 50, 190), 33, 17},
            {"flat", rect(-22.5, 90, 0, 112.5), 8, 8},        {"across the equator", rect(-10, 10, 20, 30), 20, 30},
            {"south", rect(-60, 10, -45, 40), 20, 20},        {"small", rect(47, 10, 47.01, 10.02), 64, 64}};
}

}  // namespace osgAnalyticBin::test::surfaces
