// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Spheres.h"

#include "../core/FloatRounding.h"

#include <cmath>

namespace osgAnalyticBin {

namespace {

// float(x) is off by at most half a unit of 2^-23 relative; the radius takes up three such coordinates.
constexpr double kRadiusRounding = 1.2e-7;

}  // namespace

// The Frobenius norm; where the rows have one length and are at right angles, exactly the scale.
double stretchOf(const osg::Matrixd& m) {
    double squares = 0.0;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) squares += m(row, column) * m(row, column);
    }
    const double uniform = squares / 3.0;
    constexpr double kTolerance = 1e-9;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) {
            const double dot = m(i, 0) * m(j, 0) + m(i, 1) * m(j, 1) + m(i, 2) * m(j, 2);
            if (std::abs(dot - (i == j ? uniform : 0.0)) > kTolerance * uniform) return std::sqrt(squares);
        }
    }
    return std::sqrt(uniform) * (1.0 + 2.0 * kTolerance);
}

osg::BoundingSphere roundedOutward(const osg::Vec3d& center, double radius) {
    const double outward = radius + kRadiusRounding * (center.length() + radius);
    return osg::BoundingSphere(osg::Vec3(center), core::roundedUp(outward));
}

osg::BoundingSphere movedSphere(const osg::BoundingSphere& sphere, const osg::Matrixd& matrix) {
    return roundedOutward(osg::Vec3d(sphere.center()) * matrix, double(sphere.radius()) * stretchOf(matrix));
}

}  // namespace osgAnalyticBin
