// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/bin/AnalyticMapping.h>

namespace osgAnalyticBin::core {

/// (latitude, longitude, altitude) to ECEF on an ellipsoid of revolution; in the plane of a map it is linear.
/// Source: [JJ] eq. (4), corrected; doc/theory/derivation.md, section 2.
class GeodeticMapping final : public AnalyticMapping {
public:
    /// Maps onto this ellipsoid.
    explicit GeodeticMapping(const Ellipsoid& ellipsoid) noexcept : _ellipsoid(ellipsoid) {}

    /// The ellipsoid that altitudes are above.
    [[nodiscard]] const Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }

    /// ECEF metres.
    [[nodiscard]] glm::dvec3 value(const glm::dvec3& parameters) const noexcept override;
    /// In closed form; column i is the derivative by parameter i.
    [[nodiscard]] glm::dmat3 jacobian(const glm::dvec3& parameters) const noexcept override;
    /// In closed form.
    [[nodiscard]] Hessians hessians(const glm::dvec3& parameters) const noexcept override;

    /// Guarantee: holds for every box of latitudes within the poles, any longitudes, any altitudes;
    /// tests: GeodeticMapping.RemainderHolds.
    [[nodiscard]] double remainder(const ParameterBox& box) const noexcept override;

    /// N + h and M + h cancel near the centres of curvature; tests: QuadraticBin.HoldsNearTheCentresOfCurvature.
    [[nodiscard]] double termMagnitude(const ParameterBox& box) const noexcept override;

private:
    Ellipsoid _ellipsoid;
};

/// The bin as a parameter box, rounded outward. Requires: not empty.
[[nodiscard]] ParameterBox parameterBox(const GeodeticBin& bin) noexcept;

}  // namespace osgAnalyticBin::core
