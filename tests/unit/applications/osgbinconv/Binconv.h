// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TestRaster.h"

#include <osgAnalyticBin/BinIndex.h>

#include <DatabaseFixture.h>
#include <support/Programs.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

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

inline void expectNoIndex(const std::string& rootFile) {
    EXPECT_FALSE(std::filesystem::exists(rootFile + ".bins"));
    EXPECT_FALSE(std::filesystem::exists(rootFile + ".bins.part"));
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

/// Writes a database: "synthetic", "bindem" or, where samples of them are, VirtualPlanetBuilder's "terrain" and
/// "polygonal". Returns: its root file; empty when that fails.
[[nodiscard]] inline std::string makeDatabase(const std::string& kind, const TemporaryFolder& folder) {
    const std::string file = folder / "earth.osgb";
    if (kind == "synthetic") return writeSyntheticDatabase(folder.path());
    if (kind == "bindem") {
        const std::string globe = TestRaster::globe(2.5, hills).write(folder / "heights.tif");
        const std::vector<std::string> words{
            OSGBINDEM_PROGRAM, "--quiet", "--levels", "1", "--cells", "8", globe, "-o", file};
        return runStock(quoted(words), Modules::Present).code == 0 ? file : std::string();
    }
    std::filesystem::copy(SAMPLE_DATA "/vpb/" + kind, folder.path(), std::filesystem::copy_options::recursive);
    return file;
}

/// A flat tile of one degree, its south-west corner on the equator, that pages the named file; no name: a leaf.
[[nodiscard]] inline osg::ref_ptr<osg::Node> makeSmallTile(const std::string& pagedFile, double westDeg = 0.0) {
    const osg::ref_ptr<osg::Node> mesh = makeMeshTile(extentsDeg(0, 1, westDeg, westDeg + 1), 100.0, 5);
    if (pagedFile.empty()) return mesh;
    return makePaged(mesh, pagedFile);
}

/// Writes a file with a tile; a root file has a CoordinateSystemNode above it. Makes the folders of the path.
inline void writeFile(const std::string& path, osg::Node& tile) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    if (!osgDB::writeNodeFile(tile, path)) throw std::runtime_error("cannot write " + path);
}
inline void writeRoot(const std::string& path, osg::Node& tile) {
    writeFile(path, *makeGlobe({&tile}));
}

}  // namespace osgAnalyticBin::test
