// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "kernels/PlaneKernels.h"

#include <osgAnalyticBin/core/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/GeodeticQuadraticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/QuadraticBin.h>

namespace osgAnalyticBin::core {

namespace {

Side sideOf(const kernels::Verdict& verdict, PlaneMask& undecided) noexcept {
    undecided &= ~verdict.inside();
    if (verdict.outside() != 0) return Side::Outside;
    return undecided == 0 ? Side::Inside : Side::Straddling;
}

// One plane in a thousand: kept out of line, so that the others do not save registers for it.
[[gnu::noinline]] kernels::Verdict closedByExactRange(const QuadraticBin& bin, const PlaneSet& planes,
                                                      const kernels::Verdict& verdict) noexcept {
    PlaneMask outside = verdict.outside();
    PlaneMask inside = verdict.inside();
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const PlaneMask bit = PlaneMask{1} << i;
        if (!(verdict.open & bit)) continue;
        const Side side = bin.classifyByExactRange(planes[i]);
        if (side == Side::Outside) outside |= bit;
        if (side == Side::Inside) inside |= bit;
    }
    return kernels::Verdict::of(outside, inside);
}

}  // namespace

Side classify(const ExactGeodeticBin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    return sideOf(kernels::activeKernels.exact(bin.data(), planes.blocks(), undecided & planes.all()), undecided);
}

Side classify(const QuadraticBin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    kernels::Verdict verdict = kernels::activeKernels.quadratic(bin.data(), planes.blocks(), undecided & planes.all());
    if (verdict.open != 0) verdict = closedByExactRange(bin, planes, verdict);
    return sideOf(verdict, undecided);
}

Side classify(const GeodeticQuadraticBin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    kernels::Verdict verdict = kernels::activeKernels.geodetic(bin.data(), planes.blocks(), undecided & planes.all());
    if (verdict.open != 0) verdict = closedByExactRange(QuadraticBin(bin.data().quadratic), planes, verdict);
    return sideOf(verdict, undecided);
}

}  // namespace osgAnalyticBin::core
