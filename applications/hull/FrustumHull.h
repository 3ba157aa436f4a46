// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::hull {

/// The corners of a frustum, from its planes; prepared once per frustum. Side planes alone make an apex and the rays
/// between two planes; with near and far planes there are eight corners. An orthographic frustum without near and far
/// planes has none: nothing is beyond a face of a bin then.
/// Source: doc/theory/horizon.md, section 6.
class FrustumHull final {
public:
    /// The sides, near and far.
    static constexpr std::size_t kMostPlanes = 6;
    /// Of six planes.
    static constexpr std::size_t kMostCorners = 8;

    /// Planes above kMostPlanes, planes without a unit normal, and corners above kMostCorners are left out, which is
    /// sound. `planes` is anything whose planes[i] gives a Plane, in any order.
    template <class Planes>
    FrustumHull(const Planes& planes, std::size_t count) noexcept {
        for (std::size_t i = 0; i < count && i < kMostPlanes; ++i)
            if (core::isUsable(planes[i])) _planes[_planeCount++] = planes[i];
        findCorners();
    }

    /// An apex counts once for every three of its planes.
    [[nodiscard]] std::size_t cornerCount() const noexcept { return _cornerCount; }
    /// Requires: i < cornerCount().
    [[nodiscard]] const glm::dvec3& corner(std::size_t i) const noexcept { return _corners[i].point; }

    /// Guarantee: true only if no point x with |x| <= reach and face.distance(x) >= 0 is inside all planes.
    [[nodiscard]] bool isBehind(const core::Plane& face, double reach) const noexcept;

private:
    struct Corner {
        glm::dvec3 point{0.0};
        std::array<std::size_t, 3> planes{};
        glm::dmat3 weights{0.0};  // column i times a normal is the share of plane i in it
    };

    void findCorners() noexcept;
    void addCorner(std::size_t i, std::size_t j, std::size_t k) noexcept;
    [[nodiscard]] bool proves(const Corner& corner, const core::Plane& face, double reach) const noexcept;

    std::array<core::Plane, kMostPlanes> _planes{};
    std::array<Corner, kMostCorners> _corners{};
    std::size_t _planeCount = 0;
    std::size_t _cornerCount = 0;
};

/// The faces of a bin that a frustum may lie beyond: two meridian planes (for bins narrower than half a turn), the top,
/// and supporting planes to the south and north; prepared once per bin. All point into the bin.
/// Source: doc/theory/horizon.md, section 6.
class ReverseBin final {
public:
    /// `exact` is the same bin, with its margin. Cost: sines and cosines of the edges, three support values.
    ReverseBin(const core::ExactGeodeticBin& exact, const core::GeodeticBin& bin) noexcept;

    /// Two meridians, the top, south and north.
    static constexpr std::size_t kMostFaces = 5;

    /// Faces that the bin has.
    [[nodiscard]] std::size_t faceCount() const noexcept { return _faceCount; }
    /// Requires: i < faceCount().
    [[nodiscard]] const core::Plane& face(std::size_t i) const noexcept { return _faces[i]; }
    /// No point of the bin, margin included, is farther from the earth's centre; metres.
    [[nodiscard]] double reach() const noexcept { return _reach; }

private:
    void addFace(const core::ExactGeodeticBin& exact, const glm::dvec3& outward) noexcept;

    std::array<core::Plane, kMostFaces> _faces{};
    std::size_t _faceCount = 0;
    double _reach;
};

/// The usual reverse test: whether the frustum is wholly beyond one face of a body, such as a ReverseBin.
/// Guarantee: true only if no point of the bin that the body is made for, margin included, is inside all of the
/// frustum's planes; tests: Soundness.HasNoFalseVerdict. Cost: up to so many faces times eight corners, three
/// multiplications each; most faces end at their first corner.
template <class Body>
[[nodiscard]] bool isSeparated(const Body& body, const FrustumHull& frustum) noexcept {
    for (std::size_t i = 0; i < body.faceCount() && frustum.cornerCount() > 0; ++i)
        if (frustum.isBehind(body.face(i), body.reach())) return true;
    return false;
}

}  // namespace osgAnalyticBin::hull
