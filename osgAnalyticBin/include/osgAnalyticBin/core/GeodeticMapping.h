// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/AnalyticMapping.h>
#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

namespace osgAnalyticBin::core {

/// (latitude, longitude, altitude) to ECEF on an ellipsoid of revolution.
/// Source: [JJ] eq. (4), corrected; doc/derivation.md, section 2.
class GeodeticMapping final : public AnalyticMapping {
public:
    explicit GeodeticMapping(const Ellipsoid& ellipsoid) noexcept : _ellipsoid(ellipsoid) {}

    [[nodiscard]] const Ellipsoid& ellipsoid() const noexcept { return _ellipsoid; }

    [[nodiscard]] glm::dvec3 value(const glm::dvec3& parameters) const noexcept override;
    [[nodiscard]] glm::dmat3 jacobian(const glm::dvec3& parameters) const noexcept override;
    [[nodiscard]] Hessians hessians(const glm::dvec3& parameters) const noexcept override;

    /// Guarantee: holds for every box of latitudes within the poles, any longitudes, any altitudes;
    /// tests: GeodeticMapping.ThirdDerivativeBoundHolds.
    [[nodiscard]] double thirdDerivativeBound(const ParameterBox& box) const noexcept override;

private:
    Ellipsoid _ellipsoid;
};

/// The bin as a parameter box, rounded outward. Requires: not empty.
[[nodiscard]] ParameterBox parameterBox(const GeodeticBin& bin) noexcept;

}  // namespace osgAnalyticBin::core
