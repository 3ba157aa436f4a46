// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/BoundingSphere>
#include <osg/Drawable>
#include <osg/Matrixd>

#include <array>
#include <vector>

namespace osgAnalyticBin::test {

using Triangle = std::array<osg::Vec3d, 3>;

/// The triangles of a drawable in another frame.
struct Triangles {
    std::vector<Triangle> surface;
    std::vector<Triangle> skirts;  ///< of strips
    osg::Vec3d center;
    double radius = -1.0;

    Triangles(const osg::Drawable& drawable, const osg::Matrixd& matrix);

    /// Whether one of them is met strictly between the ends of a segment.
    [[nodiscard]] bool block(const osg::Vec3d& from, const osg::Vec3d& to) const;
};

}  // namespace osgAnalyticBin::test
