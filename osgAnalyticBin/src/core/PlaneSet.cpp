// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "kernels/PlaneKernels.h"

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

namespace osgAnalyticBin::core {

namespace {

Side classifyNumbers(const double* numbers, bool isExact, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    const kernels::PlaneSides sides =
        kernels::activeKernels.bin(numbers, isExact, planes.blocks(), undecided & planes.all());
    undecided &= ~sides.inside();
    if (sides.outside() != 0) return Side::Outside;
    return undecided == 0 ? Side::Inside : Side::Straddling;
}

}  // namespace

Side classify(const ExactGeodeticBin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    return classifyNumbers(bin.numbers().data(), true, planes, undecided);
}

Side classify(const QuadraticBin& bin, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    return classifyNumbers(bin.numbers().data(), false, planes, undecided);
}

}  // namespace osgAnalyticBin::core
