// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/vec3.hpp>

namespace osgAnalyticBin::rivals {

/// One point that replaces a bin, as Cesium's horizon culling point: above the bin's middle in unit space, and so high
/// that the whole bin is hidden if the point is. It hides less than the bin itself. The height depends on the
/// occluder's depth. The object keeps the numbers that determine it: the middle, the angle from there to the bin's
/// farthest direction, and the bin's largest radius. Source: [R13]; doc/theory/horizon.md, section 9.
class HorizonPoint final {
public:
    /// `bin` holds the margin already. A bin more than a quarter turn from its middle is never hidden.
    explicit HorizonPoint(const core::HorizonBin& bin) noexcept;

    /// Guarantee: true only if the bin that the point was made for is hidden; test: Soundness.HasNoFalseVerdict.
    /// Cost: about a dozen multiplications and a square root.
    [[nodiscard]] bool isHiddenFrom(const core::HorizonEye& eye) const noexcept;

private:
    glm::dvec3 _direction{1.0, 0.0, 0.0};       // to the bin's middle, unit length in unit space
    double _cosSpread = 1.0, _sinSpread = 0.0;  // the largest angle from there to a direction of the bin
    double _inverseRadius = 0.0;                // of the farthest point, rounded down; zero: never hidden
};

}  // namespace osgAnalyticBin::rivals
