// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/Vec3.h>

#include <cmath>

namespace osgAnalyticBin::assembly {

/// The formula of a torus' solid wall, for AutodiffMapping: the bend of a pipe. (bend angle, tube angle, tube radius)
/// to origin + (bendRadius + r cos tube) (cos bend x + sin bend y) + r sin tube z. The parameter box chooses the piece.
/// Source: doc/theory/mappings.md, section 5.
/// Guarantee: on boxes up to 90 degrees wide in both angles the remainder is at most 3 times the model's error;
/// tests: TorusSegment.*.
class TorusSegment final {
public:
    /// The radius of the circle along which the tube's middle runs, in metres.
    TorusSegment(const core::Frame& frame, double bendRadius) noexcept : _frame(frame), _bendRadius(bendRadius) {}

    /// Radians, radians, metres.
    template <class T>
    [[nodiscard]] core::Vec3<T> operator()(T bend, T tube, T radius) const {
        using std::cos;
        using std::sin;
        const T distance = radius * cos(tube) + _bendRadius;
        return core::combined<T>(_frame.origin, distance * cos(bend), _frame.x, distance * sin(bend), _frame.y,
                                 radius * sin(tube), _frame.z);
    }

    /// See AnalyticMapping; holds for every box.
    [[nodiscard]] double remainder(const core::ParameterBox& box) const noexcept;

private:
    core::Frame _frame;
    double _bendRadius;
};

}  // namespace osgAnalyticBin::assembly
