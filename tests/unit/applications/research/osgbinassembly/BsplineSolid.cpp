// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BsplineSolid.h"

#include <cassert>
#include <utility>

namespace osgAnalyticBin::test {

namespace {

using Line = std::vector<glm::dvec3>;

// The polar form of the polynomial of span [knots[span], knots[span + 1]], at the given arguments.
glm::dvec3 blossom(const Line& points, const Knots& knots, std::size_t span, const std::vector<double>& arguments) {
    const std::size_t degree = arguments.size();
    const auto first = points.begin() + static_cast<Line::difference_type>(span - degree);
    Line work(first, first + static_cast<Line::difference_type>(degree + 1));
    for (std::size_t level = 1; level <= degree; ++level) {
        for (std::size_t i = degree; i >= level; --i) {
            const double left = knots[span - degree + i];
            const double right = knots[span + 1 + i - level];
            const double t = (arguments[level - 1] - left) / (right - left);
            work[i] = work[i - 1] * (1.0 - t) + work[i] * t;
        }
    }
    return work[degree];
}

Line bezierLine(const Line& points, const Knots& knots, std::size_t span, std::size_t degree) {
    Line result;
    for (std::size_t j = 0; j <= degree; ++j) {
        std::vector<double> arguments(degree, knots[span]);
        for (std::size_t k = 0; k < j; ++k) arguments[k] = knots[span + 1];
        result.push_back(blossom(points, knots, span, arguments));
    }
    return result;
}

assembly::ControlNet bezierNet(const assembly::ControlNet& net, const Knots& knotsU, std::size_t spanU,
                               const Knots& knotsV, std::size_t spanV) {
    const std::size_t degreeU = knotsU.size() - net.degreeU - 2;
    const std::size_t degreeV = knotsV.size() - net.degreeV - 2;
    assembly::ControlNet rows{net.degreeU, degreeV, {}};
    for (std::size_t i = 0; i <= net.degreeU; ++i) {
        Line row;
        for (std::size_t j = 0; j <= net.degreeV; ++j) row.push_back(net.at(i, j));
        for (const glm::dvec3& p : bezierLine(row, knotsV, spanV, degreeV)) rows.points.push_back(p);
    }
    assembly::ControlNet result{degreeU, degreeV, Line((degreeU + 1) * (degreeV + 1))};
    for (std::size_t j = 0; j <= degreeV; ++j) {
        Line column;
        for (std::size_t i = 0; i <= net.degreeU; ++i) column.push_back(rows.at(i, j));
        const Line bezier = bezierLine(column, knotsU, spanU, degreeU);
        for (std::size_t i = 0; i <= degreeU; ++i) result.at(i, j) = bezier[i];
    }
    return result;
}

// The spans of the spline's domain that have a width, by the index of their left knot.
std::vector<std::size_t> spans(const Knots& knots, std::size_t lastPoint) {
    std::vector<std::size_t> result;
    for (std::size_t i = knots.size() - lastPoint - 2; i <= lastPoint; ++i) {
        if (knots[i] < knots[i + 1]) result.push_back(i);
    }
    return result;
}

}  // namespace

std::vector<assembly::BezierSolid> bezierSolids(const assembly::ControlNet& inner, const assembly::ControlNet& outer,
                                                const Knots& knotsU, const Knots& knotsV) {
    assert(inner.degreeU == outer.degreeU && inner.degreeV == outer.degreeV);
    assert(knotsU.size() >= inner.degreeU + 3 && knotsV.size() >= inner.degreeV + 3);
    std::vector<assembly::BezierSolid> result;
    for (const std::size_t u : spans(knotsU, inner.degreeU)) {
        for (const std::size_t v : spans(knotsV, inner.degreeV)) {
            result.emplace_back(bezierNet(inner, knotsU, u, knotsV, v), bezierNet(outer, knotsU, u, knotsV, v));
        }
    }
    return result;
}

}  // namespace osgAnalyticBin::test
