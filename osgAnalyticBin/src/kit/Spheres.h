// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingSphere>
#include <osg/Matrixd>
#include <osg/Vec3>
#include <osg/Vec3d>

namespace osgAnalyticBin {

/// An upper bound of the factor by which the linear part of a matrix stretches lengths.
[[nodiscard]] double stretchOf(const osg::Matrixd& matrix);

/// A sphere, rounded outward to float, about the given one under an affine matrix.
[[nodiscard]] osg::BoundingSphere movedSphere(const osg::BoundingSphere& sphere, const osg::Matrixd& matrix);

/// A float sphere that holds the given double one.
[[nodiscard]] osg::BoundingSphere roundedOutward(const osg::Vec3d& center, double radius);

}  // namespace osgAnalyticBin
