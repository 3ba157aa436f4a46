// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/KernelData.h>
#include <osgAnalyticBin/core/occlusion/BinBody.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace osgAnalyticBin::core {

/// The part of an eye's view that earth covers: a picture on the vertical plane in front of the eye, cut into strips of
/// equal width, each with the heights that earth in front covers. What lies behind that earth is hidden.
/// All points are in the frame of the eye: the eye is the origin, x points to the right, y points forward, and z points
/// up along the eye's vertical. A point is at x = right / forward, y = up / forward in the picture.
/// Source: doc/theory/occlusion.md, sections 1, 4 and 8.
class HorizonBuffer final {
public:
    /// Strips of the picture.
    static constexpr std::size_t kStrips = 256;

    /// `eyeToCentre`: metres from the eye to the centre of the globe, for rounding. `across`: the range of x that the
    /// camera can see, or more; earth beside it hides nothing, and callers do not ask for bodies beside it. `drawing`:
    /// how far from its place in the picture the corner of a triangle may be drawn, in x and in y; outlines are
    /// enlarged by it. `depthStep`: the depth buffer may store the same depth for two points on a line of
    /// sight if their 1 / forward differs by at most this (1/m). `eyes`: metres that the eye may be away from its place
    /// along each axis: what is hidden is hidden from all these eyes, which look along the same axes.
    HorizonBuffer(double eyeToCentre, const Interval& across, double drawing = 0.0, double depthStep = 0.0,
                  const glm::dvec3& eyes = glm::dvec3(0.0));

    /// Adds earth. A column hides bodies that are farther than its farthest corner by more than a depth step. Earth
    /// beside or behind the eye is left out. `owner`: see restart(). Cost: some ten nanoseconds a column.
    void add(const EarthColumns& columns, std::uint32_t owner = 0);

    /// Takes away the earth of these owners. hides() then begins anew with the nearest body. Cost: some nanoseconds for
    /// each column that is left.
    void restart(const std::vector<std::uint32_t>& without);

    /// Lines of sight below this position in the picture are never hidden: they may meet terrain in front of the near
    /// plane, which is not drawn. Default: minus infinity. Returns: whether it was lower.
    bool raiseLowest(double y) noexcept {
        const bool isRaised = y > _lowest;
        if (isRaised) _lowest = y;
        return isRaised;
    }

    /// Where a body is in the picture.
    struct Outline {
        double nearest;    ///< metres along `forward` from the eye's place, of its nearest point
        Interval across;   ///< of the picture, only where the body is in front of all eyes
        Interval heights;  ///< likewise
        double distance;   ///< metres from the eye's place to its nearest corner
        bool isBeside;     ///< left or right of the picture, or behind the eye
    };
    /// Guarantee: no point of the body is outside of its outline, rounding included; tests: HorizonBuffer.*.
    [[nodiscard]] Outline outlineOf(const BinHull& body) const noexcept;
    /// The same of a ball, by its own roundness.
    [[nodiscard]] Outline outlineOf(const BinBall& ball) const noexcept;

    /// Whether all of a ball is left or right of the picture, or behind all eyes.
    /// Guarantee: what is in such a ball has an outline that is beside the picture; test:
    /// HorizonBuffer.FindsBallsBesideThePicture.
    [[nodiscard]] bool isBeside(const BinBall& ball) const noexcept;

    /// Whether all lines of sight from the eye to a body meet added earth before the body, as far as they lie within
    /// `across`. Bodies have to be asked for front to back, by `nearest`: one that is nearer than earth that was used
    /// for another gets false.
    /// Guarantee: true is a proof, rounding included; tests: HorizonBuffer.*.
    /// Cost: one comparison per strip that the body spans. Earth that is used for the first time costs some ten
    /// operations per strip that it spans.
    [[nodiscard]] bool hides(const Outline& body);

    /// Sorts all earth that was added, for hidesInAnyOrder(). After it add() and hides() may not be called until
    /// restart() has been.
    void sort();
    /// Whether sort() was called.
    [[nodiscard]] bool isSorted() const noexcept { return !_firstSteps.empty(); }

    /// As hides(), for bodies in any order. Requires: isSorted().
    /// Guarantee: true is a proof, rounding included; tests: SortedEarth.*.
    /// Cost: a search among some ten numbers per strip that the body spans.
    [[nodiscard]] bool hidesInAnyOrder(const Outline& body) const noexcept;

    /// Whether no line of sight to a body may meet terrain in front of the near plane: see raiseLowest().
    [[nodiscard]] bool isAboveLowest(const Outline& body) const noexcept { return body.heights.lower >= _lowest; }

    /// Metres from the eye's place to the nearest upper corner of all earth in front of it; infinite where there is
    /// none.
    [[nodiscard]] double nearestEarth() const noexcept { return std::sqrt(_nearestEarth2); }

    /// The heights that are covered in a strip so far; an empty interval if nothing is covered.
    [[nodiscard]] Interval covered(std::size_t strip) const noexcept { return {_lower[strip], _upper[strip]}; }

private:
    // The picture of an upright quadrilateral of earth: kernels::WallRow says what the numbers are.
    using Wall = std::array<double, 8>;
    // Walls that are not in the strips yet wait in lists, one for each range of distances.
    static constexpr std::size_t kRanges = 40 * 64;
    struct Waiting {
        Wall wall;
        std::int32_t next;  // in the list; kNone: the last one
        std::uint32_t owner;
    };
    static constexpr std::int32_t kNone = -1;

    struct Strips {
        std::size_t first, last;  // the one behind the last
    };
    // What sorted earth up to a distance covers in a strip.
    struct Step {
        double farthest;
        Interval heights;
    };

    [[nodiscard]] static std::size_t rangeOf(double distance) noexcept;
    [[nodiscard]] double farthestBefore(const Outline& body) const noexcept;
    [[nodiscard]] Strips stripsOf(const Outline& body) const noexcept;
    void coverNothing();
    void wait(Waiting& waiting);
    void use(double distance);
    void useList(std::size_t range, double distance);
    [[nodiscard]] std::size_t stripAt(double x, double toRight) const noexcept;
    [[nodiscard]] Strips stripsOf(const Wall& wall) const noexcept;
    [[nodiscard]] bool isAboveKnown(const Strips& strips, double height) const noexcept;

    PictureData _picture;
    double _perStep;
    double _depthStep;
    double _nearestEarth2 = std::numeric_limits<double>::infinity();  // squared
    double _lowest = -std::numeric_limits<double>::infinity();
    double _reached = 0.0;  // the farthest corner of the earth that is in the strips
    std::vector<Waiting> _walls;
    std::array<std::int32_t, kRanges> _lists;
    std::size_t _nearestList = kRanges;  // those before it are empty
    std::array<double, kStrips> _lower,
        _upper;                            // ends of the covered interval; nothing is covered where _lower > _upper
    std::vector<Step> _steps;              // strip by strip, by distance
    std::vector<std::size_t> _firstSteps;  // of the strips, and their end; empty: not sorted
};

}  // namespace osgAnalyticBin::core
