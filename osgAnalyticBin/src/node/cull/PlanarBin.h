// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/PlaneSet.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <osg/BoundingBox>
#include <osg/BoundingSphere>
#include <osg/Matrixd>

#include <array>
#include <cmath>

namespace osgAnalyticBin {

/// The bin of a tile of a map: a box in map coordinates, seen from another frame, where it is a parallelepiped.
/// Guarantee: verdicts are proofs, rounding included; tests: PlanarBin.*.
/// Cost: one product of vectors a plane for most bins, else four.
class PlanarBin final {
public:
    /// `box` is not empty; `mapToLocal` is affine.
    PlanarBin(const osg::BoundingBoxd& box, const osg::Matrixd& mapToLocal);

    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

    /// As core::classify() over planes does, with the rounding that the set knows already.
    [[nodiscard]] core::Side classify(const core::PlaneSet& planes, core::PlaneMask& undecided) const noexcept;

    /// A point of the bin that is farthest along the direction.
    [[nodiscard]] glm::dvec3 supportPoint(const glm::dvec3& direction) const noexcept;

    /// A point of the bin: its middle.
    [[nodiscard]] const glm::dvec3& hullPoint() const noexcept { return _center; }

    /// No point is farther from the origin.
    [[nodiscard]] double reach() const noexcept { return _reach; }

    /// Whether a point lies in the bin, up to a millionth of its size.
    [[nodiscard]] bool holds(const osg::Vec3d& point) const noexcept;

    /// A sphere that holds the bin.
    [[nodiscard]] osg::BoundingSphere boundingSphere() const;

private:
    [[nodiscard]] core::Side classify(const core::Plane& plane, double planeRounding) const noexcept;

    glm::dvec3 _center;
    std::array<glm::dvec3, 3> _halfAxes;
    double _radius = 0.0;
    double _reach = 0.0;
    double _rounding = 0.0;
};

inline core::Side PlanarBin::classify(const core::Plane& plane) const noexcept {
    return classify(plane, core::roundingOf(plane));
}

inline core::Side PlanarBin::classify(const core::PlaneSet& planes, core::PlaneMask& undecided) const noexcept {
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const core::PlaneMask bit = core::PlaneMask{1} << i;
        if (!(undecided & bit)) continue;
        const core::Side side =
            classify(planes[i], planes.blocks()[i / core::PlaneBlock::kLanes].rounding[i % core::PlaneBlock::kLanes]);
        if (side == core::Side::Outside) return side;
        if (side == core::Side::Inside) undecided &= ~bit;
    }
    return undecided == 0 ? core::Side::Inside : core::Side::Straddling;
}

inline core::Side PlanarBin::classify(const core::Plane& plane, double planeRounding) const noexcept {
    const double distance = plane.distance(_center);
    const double slack = _rounding + planeRounding;
    // Written so that NaN is Straddling. The sphere settles most bins.
    if (distance < -_radius - slack) return core::Side::Outside;
    if (distance >= _radius + slack) return core::Side::Inside;
    const double half = std::abs(glm::dot(plane.normal, _halfAxes[0])) +
                        std::abs(glm::dot(plane.normal, _halfAxes[1])) + std::abs(glm::dot(plane.normal, _halfAxes[2]));
    if (distance + half < -slack) return core::Side::Outside;
    if (distance - half >= slack) return core::Side::Inside;
    return core::Side::Straddling;
}

}  // namespace osgAnalyticBin
