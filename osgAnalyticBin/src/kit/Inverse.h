// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Matrixd>

#include <optional>

namespace osgAnalyticBin {

/// Whether the matrix is affine: it has no perspective division.
[[nodiscard]] bool isAffine(const osg::Matrixd& matrix);

/// Whether no number of the matrix is infinite or NaN.
[[nodiscard]] bool hasFiniteNumbers(const osg::Matrixd& matrix);

/// The inverse of an affine matrix.
/// Returns: nullopt for any other matrix, for one with numbers that are not finite, and for one that is singular or so
/// close to singular that rounding affects the inverse: osg::Matrixd::invert() returns arbitrary numbers for these.
[[nodiscard]] std::optional<osg::Matrixd> affineInverse(const osg::Matrixd& matrix);

/// Whether two affine matrices are the same but for the rounding of products of matrices whose translations are up to
/// `reach`. Written so that NaN is not the same.
[[nodiscard]] bool areNearlyEqual(const osg::Matrixd& a, const osg::Matrixd& b, double reach);

}  // namespace osgAnalyticBin
