// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "OcclusionKernels.h"
#include "ScalarTests.h"

#include <algorithm>

namespace osgAnalyticBin::core::kernels {

namespace scalar {

#define INLINE inline
#define NOINLINE inline
#define ATTRIBUTES
#include "BinStages.inl"
#include "FamilyStages.inl"
#include "OcclusionStages.inl"
#undef INLINE
#undef NOINLINE
#undef ATTRIBUTES

namespace {

PlaneSides bin(const double* numbers, bool isExact, const PlaneBlock* blocks, std::uint32_t undecided) {
    return classifyBin<double>({numbers, isExact}, blocks, undecided);
}

void family(const FamilyData& data, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict) {
    classifyFamily<double, double>(data, blocks, masks, verdict);
}

std::uint64_t hidden(const FamilyData& data, const HorizonEyeData& eye, std::uint64_t candidates) {
    return hiddenOfFamily<double, double>(data, eye, candidates);
}

}  // namespace

}  // namespace scalar

constexpr PlaneKernels kScalarKernels{scalar::bin, scalar::family, scalar::hidden};
constexpr OcclusionKernels kScalarOcclusion{scalar::columnsOf<double>,   scalar::wallsOf<double>,
                                            scalar::outlineOf<double>,   scalar::isAboveOneOf<double>,
                                            scalar::raiseStrips<double>, scalar::coversHeights<double>};

// Constant initialisation, which needs the numbers in the same file: code that classifies before this file is
// initialised gets the scalar form.
PlaneKernels activeKernels = kScalarKernels;
OcclusionKernels activeOcclusion = kScalarOcclusion;

#ifdef OSGANALYTICBIN_SIMD
namespace {

struct ChooseAtStart {
    ChooseAtStart() noexcept { chooseKernels(); }
};
const ChooseAtStart kChooseAtStart;

}  // namespace
#else
void chooseKernels() noexcept {}
#endif

}  // namespace osgAnalyticBin::core::kernels
