// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BezierSolid.h"

#include <osgAnalyticBin/mappings/FormulaRounding.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace osgAnalyticBin::assembly {

namespace {

// Rounding may put parts of the unit interval slightly outside of it; the margin for the bound's own rounding covers
// this.
constexpr double kBeyond = 1e-15;

bool isWithinUnitCube(const core::ParameterBox& box) {
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const bool within =
            box.center[axis] - box.halfSize[axis] >= -kBeyond && box.center[axis] + box.halfSize[axis] <= 1.0 + kBeyond;
        if (!within) return false;
    }
    return true;
}

// The control points of the same curve over [from, to].
void cut(std::vector<glm::dvec3>& points, double from, double to) {
    const std::size_t degree = points.size() - 1;
    // De Casteljau at `to` leaves the left part; the last point stands still at every level.
    for (std::size_t level = 1; level <= degree; ++level) {
        for (std::size_t i = degree; i >= level; --i) points[i] = points[i - 1] * (1.0 - to) + points[i] * to;
    }
    const double split = to > 0.0 ? from / to : 0.0;
    for (std::size_t level = 1; level <= degree; ++level) {
        for (std::size_t i = 0; i + level <= degree; ++i) {
            points[i] = points[i] * (1.0 - split) + points[i + 1] * split;
        }
    }
}

ControlNet cutNet(ControlNet net, const core::ParameterBox& box) {
    const auto cutLine = [&](std::size_t count, glm::length_t axis, auto&& at) {
        std::vector<glm::dvec3> line(count);
        for (std::size_t k = 0; k < count; ++k) line[k] = at(k);
        cut(line, std::max(box.center[axis] - box.halfSize[axis], 0.0), box.center[axis] + box.halfSize[axis]);
        for (std::size_t k = 0; k < count; ++k) at(k) = line[k];
    };
    for (std::size_t i = 0; i <= net.degreeU; ++i) {
        cutLine(net.degreeV + 1, 1, [&](std::size_t j) -> glm::dvec3& { return net.at(i, j); });
    }
    for (std::size_t j = 0; j <= net.degreeV; ++j) {
        cutLine(net.degreeU + 1, 0, [&](std::size_t i) -> glm::dvec3& { return net.at(i, j); });
    }
    return net;
}

// (1 - t) a + t b, point by point.
ControlNet between(const ControlNet& a, const ControlNet& b, double t) {
    ControlNet net = a;
    for (std::size_t i = 0; i < net.points.size(); ++i) net.points[i] = a.points[i] * (1.0 - t) + b.points[i] * t;
    return net;
}

ControlNet difference(const ControlNet& a, const ControlNet& b, double factor) {
    ControlNet net = a;
    for (std::size_t i = 0; i < net.points.size(); ++i) net.points[i] = factor * (a.points[i] - b.points[i]);
    return net;
}

// The net of the derivative by u or v: degree times the differences.
ControlNet derivative(const ControlNet& net, int axis) {
    const std::size_t du = axis == 0 ? 1 : 0;
    const std::size_t dv = axis == 1 ? 1 : 0;
    const auto degree = static_cast<double>(axis == 0 ? net.degreeU : net.degreeV);
    if (degree == 0.0) return {0, 0, {glm::dvec3(0.0)}};
    ControlNet result{net.degreeU - du, net.degreeV - dv, {}};
    for (std::size_t i = 0; i <= result.degreeU; ++i) {
        for (std::size_t j = 0; j <= result.degreeV; ++j) {
            result.points.push_back(degree * (net.at(i + du, j + dv) - net.at(i, j)));
        }
    }
    return result;
}

ControlNet derivative(ControlNet net, int byU, int byV) {
    for (int k = 0; k < byU; ++k) net = derivative(net, 0);
    for (int k = 0; k < byV; ++k) net = derivative(net, 1);
    return net;
}

// By the convex-hull property, a bound of the patch's length.
double largest(const ControlNet& net) {
    double result = 0.0;
    for (const glm::dvec3& p : net.points) result = std::max(result, glm::length(p));
    return result;
}

// Of a piece between two nets, for steps of its width in u and v and of half its thickness in w.
// doc/theory/mappings.md, section 6: the factors are the permutations of the differential
double differentialBound(const ControlNet& bottom, const ControlNet& top) {
    constexpr std::array<double, 4> kFace{1.0, 3.0, 3.0, 1.0};  // uuu, uuv, uvv, vvv
    constexpr std::array<double, 3> kThickness{3.0, 6.0, 3.0};  // uuw, uvw, vvw
    const ControlNet thickness = difference(top, bottom, 0.5);
    double sum = 0.0;
    for (int v = 0; v <= 3; ++v) {
        const double face = std::max(largest(derivative(bottom, 3 - v, v)), largest(derivative(top, 3 - v, v)));
        sum += kFace[static_cast<std::size_t>(v)] * face;
    }
    for (int v = 0; v <= 2; ++v) {
        sum += kThickness[static_cast<std::size_t>(v)] * largest(derivative(thickness, 2 - v, v));
    }
    return sum;
}

}  // namespace

BezierSolid::BezierSolid(ControlNet inner, ControlNet outer) : _inner(std::move(inner)), _outer(std::move(outer)) {
    assert(_inner.degreeU == _outer.degreeU && _inner.degreeV == _outer.degreeV);
    assert(_inner.points.size() == (_inner.degreeU + 1) * (_inner.degreeV + 1));
    assert(_outer.points.size() == _inner.points.size());
}

double BezierSolid::remainder(const core::ParameterBox& box) const noexcept {
    if (!isWithinUnitCube(box)) return std::numeric_limits<double>::infinity();
    // The hull of a net is tighter on a piece: four pieces, whose width is a half size of the box.
    double differential = 0.0;
    for (const double u : {-0.5, 0.5}) {
        for (const double v : {-0.5, 0.5}) {
            core::ParameterBox piece = box;
            piece.center += glm::dvec3(u * box.halfSize.x, v * box.halfSize.y, 0.0);
            piece.halfSize *= glm::dvec3(0.5, 0.5, 1.0);
            const ControlNet bottom = cutNet(between(_inner, _outer, box.center.z - box.halfSize.z), piece);
            const ControlNet top = cutNet(between(_inner, _outer, box.center.z + box.halfSize.z), piece);
            differential = std::max(differential, differentialBound(bottom, top));
        }
    }
    return core::withRounding(differential / 6.0, roundingSize());
}

double BezierSolid::triangleSagBound(const core::ParameterBox& box, const glm::dvec3& cell) const noexcept {
    if (!isWithinUnitCube(box)) return std::numeric_limits<double>::infinity();
    const ControlNet bottom = cutNet(between(_inner, _outer, box.center.z - box.halfSize.z), box);
    const ControlNet top = cutNet(between(_inner, _outer, box.center.z + box.halfSize.z), box);
    const ControlNet thickness = difference(top, bottom, 1.0);
    // A cell's share of the box, in each parameter
    glm::dvec3 share(0.0);
    for (glm::length_t i = 0; i < 3; ++i) share[i] = box.halfSize[i] > 0.0 ? 0.5 * cell[i] / box.halfSize[i] : 0.0;
    const auto face = [&](int byU, int byV) {
        return std::max(largest(derivative(bottom, byU, byV)), largest(derivative(top, byU, byV)));
    };
    // doc/theory/mappings.md, section 9
    const double sum =
        face(2, 0) * share.x * share.x + face(0, 2) * share.y * share.y +
        2.0 * (face(1, 1) * share.x * share.y + largest(derivative(thickness, 1, 0)) * share.x * share.z +
               largest(derivative(thickness, 0, 1)) * share.y * share.z);
    return core::withRounding(sum / 8.0, 6.0 * roundingSize());
}

double BezierSolid::roundingSize() const noexcept {
    // The cuts' rounding is multiplied by the cube of the degree, and by 8 of the differences.
    const auto degree = static_cast<double>(std::max(_inner.degreeU, _inner.degreeV) + 1);
    return 32.0 * degree * degree * degree * degree * std::max(largest(_inner), largest(_outer));
}

}  // namespace osgAnalyticBin::assembly
