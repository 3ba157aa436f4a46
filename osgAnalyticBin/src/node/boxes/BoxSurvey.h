// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BoxIndex.h>

#include <osg/ref_ptr>

#include <string>

namespace osgAnalyticBin {

/// As makeBoxIndex(), with stamps of all files, also of those that are missing.
[[nodiscard]] osg::ref_ptr<BoxIndex> surveyBoxes(const std::string& metadataFile, int threads,
                                                 const BoxIndexProgress& progress, std::string& error);

}  // namespace osgAnalyticBin
