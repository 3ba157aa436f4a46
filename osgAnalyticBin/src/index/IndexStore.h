// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <functional>
#include <string>

namespace osgAnalyticBin::indexing {

/// Whether all files of a database are those that an index with stamps was made from. `checkpoint`: called for each
/// file; what it throws ends the comparison. Cost: one call of the file system a file.
[[nodiscard]] bool areCurrent(const BinIndex::Stamps& stamps, const DatabaseFiles& files,
                              const std::function<void()>& checkpoint);

/// The file in the user's cache folder that keeps the index of a database:
/// "$XDG_CACHE_HOME/osgAnalyticBin/CHECKSUM.bins", or below "$HOME/.cache", on Windows below "%LOCALAPPDATA%", by
/// a checksum of the absolute path of the root file. Returns: empty where there is no such folder.
[[nodiscard]] std::string cachedIndexName(const std::string& rootFile);

/// Keeps an index in the cache folder. A file is replaced when the new one is complete. Of several processes that write
/// the same file, the last one keeps its own. Returns: the path; empty, with the reason in `error`, when the index
/// could not be kept.
[[nodiscard]] std::string keepIndex(const BinIndex& index, const std::string& rootFile, std::string& error);

}  // namespace osgAnalyticBin::indexing
