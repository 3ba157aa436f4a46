// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "kernels/PlaneKernels.h"

#include <osgAnalyticBin/core/PlaneSet.h>

namespace osgAnalyticBin::core {

Side classifyNumbers(const double* numbers, bool isExact, const PlaneSet& planes, PlaneMask& undecided) noexcept {
    const kernels::PlaneSides sides =
        kernels::activeKernels.bin(numbers, isExact, planes.blocks(), undecided & planes.all());
    undecided &= ~sides.inside();
    if (sides.outside() != 0) return Side::Outside;
    return undecided == 0 ? Side::Inside : Side::Straddling;
}

}  // namespace osgAnalyticBin::core
