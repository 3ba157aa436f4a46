// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"

namespace osgbindem {

/// Builds what has changed of a database since its rasters were other ones; the result is that of buildDatabase().
/// Throws Failure, Interrupted; then the database is as it was, or, if the new files were on their way into it already,
/// the next run of the program brings in the rest.
void updateDatabase(const Settings& settings);

}  // namespace osgbindem
