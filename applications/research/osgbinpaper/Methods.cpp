// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Methods.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

namespace osgAnalyticBin::paper {

using core::Side;

Frustum::Frustum(const Camera& camera) noexcept : hull(camera.planes(), camera.planes().size()) {
    for (const core::Plane& plane : camera.planes()) planes.push_back(plane);
}

TileBins::TileBins(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin)
    : box(ellipsoid, bin),
      corners(core::GeodeticMapping(ellipsoid), core::parameterBox(bin)),
      paper(core::GeodeticMapping(ellipsoid), core::parameterBox(bin)),
      quadratic(core::quadraticOrExact(ellipsoid, bin)),
      exact(ellipsoid, bin),
      reverse(exact, bin) {}

Side TileBins::classify(Method method, const core::PlaneSet& planes, core::PlaneMask& undecided) const noexcept {
    switch (method) {
        case Method::Box:
            return core::classify(box, planes, undecided);
        case Method::Corners:
            return core::classify(corners, planes, undecided);
        case Method::Paper:
            return core::classify(paper, planes, undecided);
        case Method::Quadratic:
            return core::classify(quadratic, planes, undecided);
        case Method::Exact:
        case Method::Hull:
            break;
    }
    return core::classify(exact, planes, undecided);
}

Side TileBins::classify(Method method, const Frustum& frustum) const noexcept {
    core::PlaneMask undecided = frustum.planes.all();
    const Side side = classify(method, frustum.planes, undecided);
    if (method != Method::Hull || side != Side::Straddling) return side;
    const std::size_t count = frustum.planes.size();
    const bool isApart =
        isSeparated(reverse, frustum.hull) || core::isSeparated(exact, frustum.planes, count, undecided, count);
    return isApart ? Side::Outside : Side::Straddling;
}

Side TileBins::classify(Method method, const core::Plane& plane) const noexcept {
    core::PlaneSet one;
    one.push_back(plane);
    core::PlaneMask undecided = one.all();
    return classify(method, one, undecided);
}

}  // namespace osgAnalyticBin::paper
