// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/Vec3.h>

#include <cstddef>
#include <vector>

namespace osgAnalyticBin::assembly {

/// The control points of a Bezier patch, (degreeU + 1) rows of (degreeV + 1).
struct ControlNet {
    /// Along the rows' index.
    std::size_t degreeU = 0;
    /// Within a row.
    std::size_t degreeV = 0;
    /// Row by row, metres.
    std::vector<glm::dvec3> points;

    /// Point j of row i.
    [[nodiscard]] const glm::dvec3& at(std::size_t i, std::size_t j) const { return points[i * (degreeV + 1) + j]; }
    /// Point j of row i, to be set.
    [[nodiscard]] glm::dvec3& at(std::size_t i, std::size_t j) { return points[i * (degreeV + 1) + j]; }
};

/// The formula of a Bezier patch with thickness, for AutodiffMapping: a Bezier solid of degree 1 in w, between the
/// patch of the inner net (w = 0) and that of the outer net (w = 1). u, v, w are in [0, 1]. Source:
/// doc/theory/mappings.md, section 6. Guarantee: the bound holds for boxes within the unit cube and is infinite for
/// others; on whole smooth bicubic patches the remainder is at most 2.5 times the model's error; tests: BezierSolid.*.
/// Cost: the bound cuts the nets down to the box; it allocates.
class BezierSolid final {
public:
    /// Requires: both nets of the same degrees, at least 1 in each direction.
    BezierSolid(ControlNet inner, ControlNet outer);

    /// The patch at w = 0.
    [[nodiscard]] const ControlNet& inner() const noexcept { return _inner; }
    /// The patch at w = 1.
    [[nodiscard]] const ControlNet& outer() const noexcept { return _outer; }

    /// The point of the solid at u, v, w.
    template <class T>
    [[nodiscard]] core::Vec3<T> operator()(T u, T v, T w) const {
        const core::Vec3<T> a = point(_inner, u, v);
        const core::Vec3<T> b = point(_outer, u, v);
        return mixed(a, b, w);
    }

    /// See AnalyticMapping.
    [[nodiscard]] double remainder(const core::ParameterBox& box) const noexcept;

    /// See AutodiffMapping. Uses the convex-hull property, too, which gives far tighter bounds than intervals.
    [[nodiscard]] double triangleSagBound(const core::ParameterBox& box, const glm::dvec3& cell) const noexcept;

private:
    [[nodiscard]] double roundingSize() const noexcept;

    template <class T>
    [[nodiscard]] static core::Vec3<T> mixed(const core::Vec3<T>& a, const core::Vec3<T>& b, const T& t) {
        return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t};
    }

    // De Casteljau's steps, in place.
    template <class T>
    [[nodiscard]] static core::Vec3<T> reduced(std::vector<core::Vec3<T>>& points, const T& t) {
        for (std::size_t n = points.size() - 1; n > 0; --n) {
            for (std::size_t i = 0; i < n; ++i) points[i] = mixed(points[i], points[i + 1], t);
        }
        return points[0];
    }

    template <class T>
    [[nodiscard]] static core::Vec3<T> point(const ControlNet& net, const T& u, const T& v) {
        std::vector<core::Vec3<T>> column;
        for (std::size_t i = 0; i <= net.degreeU; ++i) {
            std::vector<core::Vec3<T>> row;
            for (std::size_t j = 0; j <= net.degreeV; ++j) {
                const glm::dvec3& p = net.at(i, j);
                row.push_back({T(p.x), T(p.y), T(p.z)});
            }
            column.push_back(reduced(row, v));
        }
        return reduced(column, u);
    }

    ControlNet _inner;
    ControlNet _outer;
};

}  // namespace osgAnalyticBin::assembly
