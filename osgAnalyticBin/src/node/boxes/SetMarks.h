// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <string>

namespace osgAnalyticBin {

/// The file that markPhotogrammetrySet() recorded.
[[nodiscard]] std::string metadataFileOf(const osg::Node& set);

/// The file that setPhotogrammetryFile() recorded.
[[nodiscard]] std::string photogrammetryFileOf(const osg::Node& tile);

}  // namespace osgAnalyticBin
