// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How the index of a photogrammetry set is made: see BinIndex.

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/Export.h>

#include <osg/ref_ptr>

#include <cstddef>
#include <functional>
#include <string>

namespace osgAnalyticBin {

/// Callbacks of makeBoxIndex(). Never two of them run at the same time.
struct BoxIndexProgress {
    /// A file is done; `share` of the whole set, the sum is 1.
    std::function<void(std::size_t boxes, double share)> fileDone;
    /// A file cannot be read; `line` names the file and the reason.
    std::function<void(const std::string& line)> unreadable;
    /// Called after each file. Returns: false to stop; then no index is made.
    std::function<bool()> goesOn;
};

/// Makes the index of a set, to be kept as binIndexName(): reads every file of it once, in several threads. Files that
/// are missing or cannot be read draw nothing, and count as empty.
/// Returns: nullptr when the set has no tiles, or when it was stopped; then `error` says why.
[[nodiscard]] OSGANALYTICBIN_EXPORT osg::ref_ptr<BinIndex> makeBoxIndex(const std::string& metadataFile, int threads,
                                                                        const BoxIndexProgress& progress,
                                                                        std::string& error);

/// As makeBoxIndex(), with stamps of all files, also of those that are missing.
[[nodiscard]] osg::ref_ptr<BinIndex> makeStampedBoxIndex(const std::string& metadataFile, int threads,
                                                         const BoxIndexProgress& progress, std::string& error);

}  // namespace osgAnalyticBin
