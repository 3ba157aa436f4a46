// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <string>

namespace osgAnalyticBin {

/// What markPhotogrammetrySet() was told.
[[nodiscard]] std::string metadataFileOf(const osg::Node& set);

/// What setPhotogrammetryFile() was told.
[[nodiscard]] std::string photogrammetryFileOf(const osg::Node& tile);

}  // namespace osgAnalyticBin
