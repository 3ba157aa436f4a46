// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"

#include <optional>

namespace osgbindem {

/// Reads the command line, the program's name first. No raster is opened.
/// Returns: nullopt after help or version was printed. Throws Failure.
[[nodiscard]] std::optional<Settings> settingsFrom(int argc, const char* const* argv);

}  // namespace osgbindem
