// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::support {

/// Locks an open file against other programs, until it is closed. `path`: by which it was opened.
/// Returns: false when another program has it, or has just deleted it.
[[nodiscard]] bool lockFile(int handle, const std::string& path);

/// Waits until everything in the file system of a folder is on the disk, as far as this machine has written it.
/// Throws Failure.
void flushToDisk(const std::string& folder);

}  // namespace osgAnalyticBin::support
