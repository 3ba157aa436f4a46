// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BezierSolid.h"

#include <vector>

namespace osgAnalyticBin::test {

/// The knots of a B-spline in one direction: not decreasing, count of control points + degree + 1 of them.
using Knots = std::vector<double>;

/// A B-spline patch with thickness as the Bezier solids of its knot spans: across a knot a spline is not three times
/// differentiable, so each span has a bin of its own. The nets have `degree + number of spans` points in a direction
/// for simple inner knots; `assembly::ControlNet::degreeU` and `degreeV` count them less one, as for Bezier nets.
/// Source: doc/theory/mappings.md, section 6.
/// Guarantee: the solids map the unit cube to the same points as the spline maps the spans; tests: BsplineSolid.*.
/// Requires: nets of equal size; knots.size() = points + degree + 1 in both directions.
/// Returns: row by row in u, spans without width left out.
[[nodiscard]] std::vector<assembly::BezierSolid> bezierSolids(const assembly::ControlNet& inner,
                                                              const assembly::ControlNet& outer, const Knots& knotsU,
                                                              const Knots& knotsV);

}  // namespace osgAnalyticBin::test
