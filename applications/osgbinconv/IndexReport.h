// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "IndexBuilder.h"

#include <string>

namespace osgbinconv {

/// Prints what is in an index, in a few lines. Throws Failure when it cannot be read.
void printIndex(const std::string& path);

/// Makes the index of a database anew, in memory, and compares the one beside it. Says in a line that they agree.
/// Throws Failure where they do not.
void checkIndex(const DatabaseFiles& files, const WalkOptions& options);

}  // namespace osgbinconv
