// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseWalk.h"

#include <string>

namespace osgbinconv {

/// Whether a root file is the metadata of a photogrammetry set, "metadata.xml".
[[nodiscard]] bool isPhotogrammetry(const std::string& file);

/// Writes "metadata.xml.boxes" beside the metadata of a photogrammetry set. Throws Failure or Interrupted.
void writeBoxIndex(const std::string& metadataFile, const WalkOptions& options);

/// Compares "metadata.xml.boxes" with the set. Throws Failure when it does not fit, or Interrupted.
void checkBoxIndex(const std::string& metadataFile, const WalkOptions& options);

}  // namespace osgbinconv
