// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Ranks.h"
#include "Settings.h"

namespace osgbindem {

/// Builds the whole database, or what an earlier run of the same settings and rasters has left of it to do.
/// Throws Failure, Interrupted; then what is done is kept beside the output for the next run, finished subtrees only.
/// The other ranks only help; what went wrong there is thrown by the first one.
void buildDatabase(const Settings& settings, const Ranks& ranks);

}  // namespace osgbindem
