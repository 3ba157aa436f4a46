// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::support {

/// Writes a file under another name and renames it. Returns: false when that failed; what is there under its name stays
/// as it was then.
[[nodiscard]] bool replaceFile(const std::string& file, const std::string& text);

/// As replaceFile. Throws: Failure.
void writeFile(const std::string& file, const std::string& text);

/// The value with so many decimals.
[[nodiscard]] std::string withDecimals(double value, int decimals);

}  // namespace osgAnalyticBin::support
