// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Object>
#include <osg/observer_ptr>

#include <array>
#include <optional>

namespace osgAnalyticBin {

/// A tile's own mesh, where it is drawn.
struct Ground {
    const osg::Object& tile;  ///< its bin: a new one where bins are installed again
    osg::Node& mesh;
    const osg::Matrixd& localToEcef;
    double low;     ///< metres above the ellipsoid; the mesh is not below
    bool isAsRead;  ///< the mesh has not changed since bins were installed
};

/// The triangle of the shown terrain that an eye was last above: it usually stays above it for some frames.
class GroundBelow {
public:
    /// Whether the mesh is below the eye along the ellipsoid's normal. False in doubt: where the normal meets no
    /// triangle, where something in the mesh cannot be read, and for terrain tiles that have no mesh yet.
    /// Cost: a search through the mesh's triangles; while the eye stays above the same triangle of a mesh that has not
    /// changed, a second one, and then some ten products of vectors if nothing of the mesh is above that triangle.
    /// Where something is, each view searches once.
    [[nodiscard]] bool isBelow(const core::Geodetic& eye, const Ground& ground, const core::Ellipsoid& ellipsoid);

private:
    [[nodiscard]] bool isTriangleBelow(const glm::dvec3& eye, const glm::dvec3& up) const;
    // Whether nothing of the mesh hangs over the triangle.
    [[nodiscard]] bool isTriangleOpen(const Ground& ground, const glm::dvec3& up);

    osg::observer_ptr<const osg::Object> _tile;
    osg::observer_ptr<const osg::Node> _mesh;
    osg::Matrixd _localToEcef;
    int _uses = 0;
    std::optional<bool> _isOpen;            // the triangle is, once it is known
    std::array<glm::dvec3, 3> _triangle{};  // ECEF
};

}  // namespace osgAnalyticBin
