// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <functional>
#include <iosfwd>
#include <string>

namespace osgAnalyticBin {

/// Writes a file atomically: a file of that name is replaced when the new one is complete; on failure nothing is left
/// behind.
/// `write`: whether the stream took everything. Returns: whether the file was written; otherwise `error` says why not.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool writeWholeFile(const std::string& path,
                                                        const std::function<bool(std::ostream&)>& write,
                                                        std::string& error);

}  // namespace osgAnalyticBin
