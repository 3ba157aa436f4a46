// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace osgAnalyticBin::support {

/// Writes a file under another name and renames it, so that it is either complete or as it was before, and notices a
/// full disk. `write`: whether the stream took everything. Throws: Failure.
void writeFile(const std::string& file, const std::string& text);
void writeFile(const std::string& file, const std::function<bool(std::ostream&)>& write);

/// The bytes of a file; empty where it cannot be read.
[[nodiscard]] std::string contentOf(const std::string& file);

/// For what would only be found out at the end of a long run. Throws: Failure when the folder of a file, which an
/// option names, is not there; an empty name is none.
void requireFolderOf(const char* option, const std::string& file);

/// Makes a folder, and those above it, unless it is there. Throws: Failure.
void makeFolder(const std::string& folder);

/// The value with so many decimals.
[[nodiscard]] std::string withDecimals(double value, int decimals);

}  // namespace osgAnalyticBin::support
