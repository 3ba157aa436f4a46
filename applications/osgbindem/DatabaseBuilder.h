// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"

namespace osgbindem {

/// Builds the whole database, or what an earlier run of the same settings and rasters has left of it to do.
/// Throws Failure, Interrupted; then what is done is kept beside the output for the next run, finished subtrees only.
void buildDatabase(const Settings& settings);

}  // namespace osgbindem
