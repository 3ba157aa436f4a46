// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Inverse.h"

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

// Tolerance for the product of a matrix and its inverse. It is exceeded only if rounding errors grow a hundred thousand
// times.
constexpr double kInverseTolerance = 1e-10;

// Without the translations, which are as large as the earth. Written so that NaN is no inverse.
bool areInverse(const osg::Matrixd& a, const osg::Matrixd& b) {
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double product = a(i, 0) * b(0, k) + a(i, 1) * b(1, k) + a(i, 2) * b(2, k);
            if (!(std::abs(product - (i == k ? 1.0 : 0.0)) <= kInverseTolerance)) return false;
        }
    }
    return true;
}

}  // namespace

bool isAffine(const osg::Matrixd& m) {
    return m(0, 3) == 0.0 && m(1, 3) == 0.0 && m(2, 3) == 0.0 && m(3, 3) == 1.0;
}

bool hasFiniteNumbers(const osg::Matrixd& matrix) {
    // infinity times zero is no number
    double sum = 0.0;
    for (int i = 0; i < 16; ++i) sum += 0.0 * matrix.ptr()[i];
    return sum == 0.0;
}

std::optional<osg::Matrixd> affineInverse(const osg::Matrixd& matrix) {
    osg::Matrixd inverse;
    if (!isAffine(matrix) || !hasFiniteNumbers(matrix) || !inverse.invert(matrix)) return std::nullopt;
    if (!hasFiniteNumbers(inverse) || !areInverse(matrix, inverse) || !areInverse(inverse, matrix)) return std::nullopt;
    return inverse;
}

bool areNearlyEqual(const osg::Matrixd& a, const osg::Matrixd& b, double reach) {
    constexpr double kRounding = 1e-13;  // a micrometre on the earth
    double largest = 0.0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a(i / 3, i % 3)));
    for (int i = 0; i < 12; ++i) {
        const double tolerance = kRounding * (i < 9 ? largest : reach);
        if (!(std::abs(a(i / 3, i % 3) - b(i / 3, i % 3)) <= tolerance)) return false;
    }
    return isAffine(a) && isAffine(b);
}

}  // namespace osgAnalyticBin
