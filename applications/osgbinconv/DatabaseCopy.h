// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "IndexBuilder.h"

#include <string>

namespace osgbinconv {

struct CopyOptions {
    bool overwrite = false;
    /// Whether osg::ClusterCullingCallbacks stay in the copy.
    bool keepClusters = false;
};

/// Writes a copy of a database with the bins in its files, in the format of the output's extension. The original is
/// not touched. Throws Failure or Interrupted; then nothing of the copy is left.
void copyDatabase(const DatabaseFiles& files, const std::string& output, const CopyOptions& copy,
                  const WalkOptions& walk);

}  // namespace osgbinconv
