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

/// Builds what has changed of a database since its rasters were other ones; the result is that of buildDatabase().
/// Throws Failure, Interrupted; then the database is as it was, or, if the new files were on their way into it already,
/// the next run of the program brings in the rest.
void updateDatabase(const Settings& settings);

}  // namespace osgbindem
