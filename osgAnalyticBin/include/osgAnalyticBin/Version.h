// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

namespace osgAnalyticBin {

/// The version of the library that runs, "MAJOR.MINOR.PATCH".
[[nodiscard]] OSGANALYTICBIN_EXPORT const char* version() noexcept;

}  // namespace osgAnalyticBin
