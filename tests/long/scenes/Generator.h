// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Description.h"

namespace osgAnalyticBin::test {

/// A random scene: the same for the same seed on every machine.
[[nodiscard]] Description randomDescription(std::uint64_t seed);

}  // namespace osgAnalyticBin::test
