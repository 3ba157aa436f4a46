// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/BinRows.h>
#include <osgAnalyticBin/core/KernelData.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

/// The tests for doubles, one bin and one plane at a time.
namespace osgAnalyticBin::core::kernels::scalar {

// In this order.
// clang-format off
#include "ScalarNumbers.inl"
#include "QuadraticTest.inl"
#include "ExactTest.inl"
#include "HorizonTest.inl"
#undef INLINE
#undef NOINLINE
#undef ATTRIBUTES
// clang-format on

}  // namespace osgAnalyticBin::core::kernels::scalar
