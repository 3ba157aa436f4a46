// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/FileRecord.h>

#include <osg/Node>

#include <string>

namespace osgAnalyticBin::indexing {

/// What an index needs to know of the scene of one file: its tiles with their surfaces, and the files paged below them.
/// The scene is not changed. Throws Failure when it names files outside of the database's folder.
[[nodiscard]] FileRecord surveyFile(osg::Node& scene, const std::string& file, const FilePlace& place,
                                    const DatabaseFiles& files);

}  // namespace osgAnalyticBin::indexing
