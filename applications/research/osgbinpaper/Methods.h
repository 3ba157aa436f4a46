// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Camera.h"
#include "ComparisonBins.h"
#include "FrustumHull.h"

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>

#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

namespace osgAnalyticBin::paper {

/// What a tile is tested by; in the order of MethodBins.
enum class Method : std::size_t { Sphere, Box, Corners, Paper, Quadratic, Exact, Hull };

inline constexpr std::size_t kMethods = 7;
inline constexpr std::array<const char*, kMethods> kMethodNames{"sphere",    "box",   "corners", "paper",
                                                                "quadratic", "exact", "hull"};

[[nodiscard]] constexpr std::size_t indexOf(Method method) noexcept {
    return static_cast<std::size_t>(method);
}

/// The planes of a frustum and what the search for its hull needs; made once per camera.
struct Frustum {
    explicit Frustum(const Camera& camera) noexcept;

    core::PlaneSet planes;
    rivals::FrustumHull hull;
};

/// A sphere that holds the bin, about the middle of its box along the axes of ECEF.
class SphereBin final {
public:
    SphereBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin) noexcept;

    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

private:
    glm::dvec3 _center;
    double _radius;
};

/// The box along the axes of ECEF that holds the bin: another reading of "eight corners", and a sound one.
class BoxBin final {
public:
    BoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin) noexcept;

    [[nodiscard]] core::Side classify(const core::Plane& plane) const noexcept;

private:
    glm::dvec3 _center;
    glm::dvec3 _half;
};

/// Near to the truth: the exact bin, the reverse test, and the search for a parting plane between all pairs of sides.
struct HullBin {
    HullBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin) noexcept
        : exact(ellipsoid, bin), reverse(exact, bin) {}

    core::ExactGeodeticBin exact;
    rivals::ReverseBin reverse;
};

/// Where the bin lies with respect to the frustum; all planes are undecided at first.
template <class Bin>
[[nodiscard]] core::Side classify(const Bin& bin, const Frustum& frustum) noexcept {
    core::PlaneMask undecided = frustum.planes.all();
    return core::classify(bin, frustum.planes, undecided);
}

[[nodiscard]] core::Side classify(const HullBin& bin, const Frustum& frustum) noexcept;

/// The bins of a list of tiles, for every method; prepared once.
using MethodBins = std::tuple<std::vector<SphereBin>, std::vector<BoxBin>, std::vector<rivals::CornersBin>,
                              std::vector<rivals::PaperBin>, std::vector<core::QuadraticOrExact>,
                              std::vector<core::ExactGeodeticBin>, std::vector<HullBin>>;

[[nodiscard]] MethodBins methodBins(const core::Ellipsoid& ellipsoid, const std::vector<core::GeodeticBin>& bins);

/// Calls function(vector of the method's bins).
template <class Function>
void withBins(const MethodBins& bins, Method method, const Function& function) {
    switch (method) {
        case Method::Sphere:
            return function(std::get<indexOf(Method::Sphere)>(bins));
        case Method::Box:
            return function(std::get<indexOf(Method::Box)>(bins));
        case Method::Corners:
            return function(std::get<indexOf(Method::Corners)>(bins));
        case Method::Paper:
            return function(std::get<indexOf(Method::Paper)>(bins));
        case Method::Quadratic:
            return function(std::get<indexOf(Method::Quadratic)>(bins));
        case Method::Exact:
            return function(std::get<indexOf(Method::Exact)>(bins));
        case Method::Hull:
            return function(std::get<indexOf(Method::Hull)>(bins));
    }
}

}  // namespace osgAnalyticBin::paper
