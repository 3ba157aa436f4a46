// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <string>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

/// Whether there is such a database: "synthetic" and "bindem" always, VirtualPlanetBuilder's "terrain" and "polygonal"
/// where samples of them are.
[[nodiscard]] bool isAtHand(const std::string& kind);

/// Writes a database of that kind. Returns: its root file; empty when that fails.
[[nodiscard]] std::string makeDatabase(const std::string& kind, const TemporaryFolder& folder);

/// A flat tile of one degree, its south-west corner on the equator, that pages the named file; no name: a leaf.
[[nodiscard]] osg::ref_ptr<osg::Node> makeSmallTile(const std::string& pagedFile, double westDeg = 0.0);

/// Writes a file with a tile; a root file has a CoordinateSystemNode above it. Makes the folders of the path.
void writeFile(const std::string& path, osg::Node& tile);
void writeRoot(const std::string& path, osg::Node& tile);

}  // namespace osgAnalyticBin::test
