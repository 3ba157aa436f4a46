// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/occlusion/BinHull.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace osgAnalyticBin::core {

/// The part of an eye's view that earth covers: a picture on the vertical plane in front of the eye, cut into strips of
/// equal width, each with the heights that earth in front covers. What lies behind that earth is hidden.
/// Positions in the picture: x = right / forward, y = up / forward, of the vector from the eye.
/// Source: doc/occlusion.md, sections 1 and 4.
class HorizonBuffer final {
public:
    /// Strips of the picture.
    static constexpr std::size_t kStrips = 512;

    /// `forward` and `up` are unit vectors and perpendicular; up is the eye's vertical. `across`: the range of x
    /// that the camera can see, or more; what is beside it hides nothing, and nobody asks for it. `drawing`: by how
    /// much corners of triangles may be drawn in another place of the picture, in x and in y; bodies count as larger by
    /// it.
    HorizonBuffer(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up, const Interval& across,
                  double drawing = 0.0);

    /// Adds earth. It hides what is no nearer than its farthest corner. Earth beside or behind the eye is left out.
    void add(const EarthColumn& column);

    /// Lines of sight below this position in the picture are never hidden: they may meet terrain in front of the near
    /// plane, which is not drawn. Default: minus infinity.
    void setLowest(double y) noexcept { _lowest = y; }

    /// Whether all lines of sight from the eye to a body meet added earth before the body, as far as they lie within
    /// `across`. Bodies have to be asked for front to back, by nearest(): one that is nearer than earth that was used
    /// for another gets false.
    /// Guarantee: true is a proof, rounding included; tests: HorizonBuffer.*.
    /// Cost: one comparison per strip that the body spans. Earth that is used for the first time costs some twenty
    /// operations per strip that it spans.
    [[nodiscard]] bool hides(const BinHull& body);

    /// The distance along `forward` of the body's nearest point, metres.
    [[nodiscard]] double nearest(const BinHull& body) const noexcept;

private:
    // Earth that is not in the strips yet. The heap has the nearest on top.
    struct Pending {
        double farthest;
        std::array<glm::dvec2, 4> top, bottom;
        double error;    // in the picture
        double highest;  // of the top
        [[nodiscard]] bool operator<(const Pending& other) const noexcept { return farthest > other.farthest; }
    };

    [[nodiscard]] double edge(std::size_t strip) const noexcept {
        return _across.lower + _step * static_cast<double>(strip);
    }
    void use(double distance);
    void raise(const Pending& earth);
    [[nodiscard]] std::size_t stripAt(double x, double toRight) const noexcept;
    [[nodiscard]] bool isAboveKnown(std::size_t first, std::size_t last, double height) const noexcept;
    void cover(std::size_t strip, const Interval& heights);

    glm::dvec3 _eye, _forward, _right, _up;
    Interval _across;
    double _step;
    double _drawing;
    double _lowest = -std::numeric_limits<double>::infinity();
    double _reached = 0.0;  // the farthest corner of the earth that is in the strips
    std::vector<Pending> _pending;
    std::array<Interval, kStrips> _covered;  // empty: nothing
};

}  // namespace osgAnalyticBin::core
