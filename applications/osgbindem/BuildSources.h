// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"
#include "TileLayout.h"

#include <string>

namespace osgbindem {

/// Everything that decides the bytes of a database, as text: programs, settings, and each raster's files with their
/// sizes and times. Two runs with the same text build the same files.
[[nodiscard]] std::string describeSources(const Settings& settings, const TileLayout& layout);

}  // namespace osgbindem
