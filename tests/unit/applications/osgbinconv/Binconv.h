// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <osg/Node>

#include <cstddef>
#include <string>
#include <support/FailureText.h>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin::test {

/// For two minutes at most: what hangs ends with 124.
inline Outcome runBinconv(std::vector<std::string> words) {
    words.insert(words.begin(), OSGBINCONV_PROGRAM);
    return runStock("timeout 120 " + quoted(words), Modules::Present);
}

/// --index on a root file.
inline Outcome runIndex(const std::string& rootFile) {
    return runBinconv({"--quiet", "--index", rootFile});
}

/// The index beside a root file; an empty one where there is none.
inline osg::ref_ptr<BinIndex> indexOf(const std::string& rootFile) {
    std::string error;
    const osg::ref_ptr<BinIndex> index = readBinIndex(rootFile, nullptr, error);
    EXPECT_TRUE(index) << error;
    return index ? index : osg::ref_ptr<BinIndex>(new BinIndex);
}

inline void expectFailure(const Outcome& outcome, const std::string& what, int code = 1) {
    expectOneLine(outcome, "osgbinconv", what, code);
}

inline void expectSuccess(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.text, "");
}

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

/// A tile of a database, as OpenSceneGraph reads it.
struct DrawnTile {
    std::string file;
    std::size_t ordinal = 0;
    /// Indices of all tiles above it, the nearest first.
    std::vector<std::size_t> ancestors;
    /// Metres that its skirts hang down.
    double skirt = 0.0;
    double low = 0.0;
    double high = 0.0;
    std::uint64_t fingerprint = 0;
    /// All vertices that it draws itself, those of skirts included.
    std::vector<glm::dvec3> samples;
};

/// All tiles of a local database, each file read by its name.
[[nodiscard]] std::vector<DrawnTile> readAllTiles(const std::string& rootFile);

/// The ellipsoid of all databases here.
[[nodiscard]] core::Ellipsoid ellipsoidOfTests();

}  // namespace osgAnalyticBin::test
