// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../../core/mesh/VerticalPassage.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Object>
#include <osg/observer_ptr>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

/// A tile's own mesh, where it is drawn.
struct Ground {
    const osg::Object& tile;  ///< its bin: a new one where bins are installed again
    osg::Node& mesh;
    const osg::Matrixd& localToEcef;
    double low, high;  ///< metres above the ellipsoid; the mesh is not below and not above
    bool isAsRead;     ///< the mesh has not changed since bins were installed
};

/// The triangles of the shown terrain about the vertical of an eye, which usually stays there for some frames.
class GroundBelow {
public:
    /// Whether the mesh is below the eye along the ellipsoid's normal. False in doubt: where the normal meets no
    /// triangle, where something in the mesh cannot be read, and for terrain tiles that have no mesh yet.
    /// Cost: a walk through the mesh's triangles; while the eye stays above one or two cells of a mesh that has not
    /// changed, some nanoseconds for each of up to 32 triangles.
    [[nodiscard]] bool isBelow(const core::Geodetic& eye, const Ground& ground, const core::Ellipsoid& ellipsoid);

private:
    /// The triangles that reach into a square column.
    struct Column {
        osg::observer_ptr<const osg::Object> tile;
        osg::observer_ptr<const osg::Node> mesh;
        osg::Matrixd localToEcef;
        int uses = 0;
        glm::dvec3 middle{}, right{}, ahead{};  // ECEF
        double reach = 0.0;                     // metres from the middle, to the right and ahead
        std::vector<core::TriangleCorners> triangles;

        [[nodiscard]] bool isOf(const Ground& ground) const;
        // The sides that a point is surely beyond, one bit for each.
        [[nodiscard]] std::uint8_t sidesBeyond(const glm::dvec3& point) const;
        [[nodiscard]] bool read(const Ground& ground, const glm::dvec3& eye, const glm::dvec3& up);
    };
    class ColumnWalk;

    // of several tiles: one may add to another, or belong to another database
    std::array<Column, 4> _columns;
    std::size_t _oldest = 0;
};

}  // namespace osgAnalyticBin
