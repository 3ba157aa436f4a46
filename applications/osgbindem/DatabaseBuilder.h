// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Settings.h"

namespace osgbindem {

/// Builds the whole database. Throws Failure, Interrupted; then nothing is left behind.
void buildDatabase(const Settings& settings);

}  // namespace osgbindem
