// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/Node>
#include <osg/observer_ptr>

#include <array>

namespace osgAnalyticBin {

/// Whether a place lies within the latitudes and longitudes at which the tile or its descendants may draw. Another
/// technique may draw beyond those of the bin, by the margin that the application vouches for. True for a bin that is
/// not valid.
[[nodiscard]] bool isInColumn(const core::Geodetic& place, const AnalyticBinCullCallback& tile,
                              const core::Ellipsoid& ellipsoid);

/// The triangle of the shown terrain that an eye was last above: it usually stays above it for some frames.
class GroundBelow {
public:
    /// Whether the mesh, a tile's own, is below the eye along the ellipsoid's normal. False in doubt: where the normal
    /// meets no triangle, and for terrain tiles that have no mesh yet or whose technique may draw it elsewhere.
    /// Cost: a search through the mesh's triangles, or some ten products of vectors while the eye stays above the same
    /// triangle of a mesh that has not changed since bins were installed.
    [[nodiscard]] bool isBelow(const core::Geodetic& eye, osg::Node& mesh, const AnalyticBinCullCallback& tile,
                               const core::Ellipsoid& ellipsoid);

private:
    [[nodiscard]] bool isTriangleBelow(const glm::dvec3& eye, const glm::dvec3& up) const;

    osg::observer_ptr<const osg::Node> _mesh;
    osg::observer_ptr<const AnalyticBinCullCallback> _tile;
    int _uses = 0;
    std::array<glm::dvec3, 3> _triangle{};  // ECEF
};

}  // namespace osgAnalyticBin
