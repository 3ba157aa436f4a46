// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BoxIndex.h>

#include <osg/ref_ptr>

#include <string>
#include <vector>

namespace osgAnalyticBin {

/// Reads these root files of a set, and all that is paged below them, each file once. Returns: their boxes, with stamps
/// of all files, also of those that are missing; nullptr when it was stopped.
[[nodiscard]] osg::ref_ptr<BoxIndex> surveyBoxes(const std::string& metadataFile, const std::vector<std::string>& roots,
                                                 int threads, const BoxIndexProgress& progress);

}  // namespace osgAnalyticBin
