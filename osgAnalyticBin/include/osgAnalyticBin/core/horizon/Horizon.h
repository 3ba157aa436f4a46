// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/bin/KernelData.h>

#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace osgAnalyticBin::core {

/// The data of a bin for the horizon test; prepared once, for every eye and every depth of the occluder. Directions and
/// radii are those of unit space: ECEF divided by the ellipsoid's radii.
/// Source: doc/theory/horizon.md, section 2.
class HorizonBin final {
public:
    /// `margin` (metres) is added on all sides: what is drawn may leave the bin by that much.
    /// Bins of any width are taken. One that is empty, or reaches below half the smallest radius of curvature, is never
    /// hidden.
    /// Cost: the sines and cosines of the bin's edges.
    HorizonBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin = 0.0) noexcept;

    /// What the test reads.
    [[nodiscard]] const std::array<double, row::kHorizonRows>& numbers() const noexcept { return _numbers; }

private:
    void setLongitude(const GeodeticBin& bin) noexcept;
    void setLatitude(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept;
    void setRadius(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept;

    // Longitudes within the half width of the middle, scaled latitudes from south to north. At first the whole globe,
    // which is never hidden.
    std::array<double, row::kHorizonRows> _numbers{1.0, 0.0, 0.0, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0};
};

/// An eye, or the viewing direction of an orthographic camera, together with the body that hides: the ellipsoid scaled
/// about its centre so that it lies `depth` or more below the surface. Prepared once per camera and frame.
/// Frame: the ellipsoid's own; a globe that is moved, turned or scaled uniformly needs its eye brought there.
/// Requires: the eye is above the drawn surface (not checked: ellipsoid and depth do not tell where that is). The
/// occluder stands for this surface, which encloses it. For an eye between the occluder and the surface, nearly every
/// bin would be hidden although nothing is drawn in front of it; the caller has to exclude that.
/// Source: doc/theory/horizon.md, sections 1, 3 and 4.
class HorizonEye final {
public:
    /// `depth` (metres, positive down) is that of the lowest surface that can be drawn: terrain and sag of its meshes.
    /// Requires: the eye is above the drawn surface, as the class says (not checked).
    /// Returns: nullopt when nothing can be said to be hidden: eye inside the occluder, a depth of more than half of
    /// the smaller radius, values that are not finite.
    [[nodiscard]] static std::optional<HorizonEye> fromEye(const Ellipsoid& ellipsoid, double depth,
                                                           const glm::dvec3& eyeEcef) noexcept;

    /// For orthographic cameras. `viewDirection` points from the camera to the scene, of any length but zero; what lies
    /// before `nearPointEcef`, a point of the near plane, is cut away and hides nothing.
    /// Returns: nullopt as above, and when the near plane is not wholly before the occluder.
    [[nodiscard]] static std::optional<HorizonEye> fromDirection(const Ellipsoid& ellipsoid, double depth,
                                                                 const glm::dvec3& viewDirection,
                                                                 const glm::dvec3& nearPointEcef) noexcept;

    /// Guarantee: true only if the segment from every point of the bin, margin included, to the eye (the half line
    /// against the viewing direction) meets the occluder, for b/a from 0.01 to 10;
    /// tests: Soundness.HasNoFalseVerdict, Soundness.HasNoFalseVerdictNearTies.
    /// Requires: a bin prepared for the same ellipsoid.
    /// Cost: about 35 multiplications and two or three square roots; no trigonometry.
    [[nodiscard]] bool hides(const HorizonBin& bin) const noexcept;

    /// For balls, in ECEF and metres: how far the occluder is along a line of sight to a point of the ball, as a share
    /// of the way to the point. Requires: an eye, and not a viewing direction; its own ellipsoid.
    /// Guarantee: where it is less than 1, no line of sight has a larger share, and each meets the occluder; otherwise
    /// one may not; test: Horizon.SharesOfBallsAreUpperBounds. Source: doc/theory/horizon.md, section 12.
    [[nodiscard]] double shareBefore(const Ellipsoid& ellipsoid, const glm::dvec3& centre,
                                     double radius) const noexcept;

    /// What the test reads.
    [[nodiscard]] const HorizonEyeData& data() const noexcept { return _data; }

private:
    HorizonEye(const glm::dvec3& direction, double cosDip, double sinDip, double scale) noexcept;

    HorizonEyeData _data;
};

}  // namespace osgAnalyticBin::core
