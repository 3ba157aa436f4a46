// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <string>

namespace osgAnalyticBin::test {

/// A flat tile of one degree, its south-west corner on the equator, that pages the named file; no name: a leaf.
[[nodiscard]] osg::ref_ptr<osg::Node> makeSmallTile(const std::string& pagedFile, double westDeg = 0.0);

/// Writes a file with a tile; a root file has a CoordinateSystemNode above it. Makes the folders of the path.
void writeSmallFile(const std::string& path, osg::Node& tile, bool isRoot = false);

}  // namespace osgAnalyticBin::test
