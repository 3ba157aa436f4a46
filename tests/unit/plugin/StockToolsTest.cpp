// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The stock osgviewer and osgconv, with and without the modules on OSG's plugin path: what the programs say, and how
// they end; pictures are compared in applications/osgbinflight/. And a database packed by the stock osgarchive. Oracle:
// what is drawn from the files. Needs OSG_LIBRARY_PATH.

#include "PagedFlight.h"

#include <osgDB/ReadFile>

#include <support/Programs.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;

using test::Modules;
using test::Outcome;

class StockTools : public ::testing::Test {
protected:
    [[nodiscard]] Outcome convert(const std::string& from, const std::string& to, Modules modules) const {
        return test::runOsgconv(test::quoted(from) + ' ' + test::quoted(to), modules);
    }

    const test::TemporaryFolder _folder;
    const std::string _database = test::writeSyntheticDatabase(_folder.path());
};

// Without the modules it opens with one warning. Nothing stored switches culling off.
TEST_F(StockTools, ADatabaseSurvivesOsgconvWithAndWithoutTheModules) {
    for (const Modules modules : {Modules::Present, Modules::Absent}) {
        const bool isAbsent = modules == Modules::Absent;
        const std::string copy = _folder / "copy.osgt";
        const Outcome outcome = convert(_database, copy, modules);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        EXPECT_EQ(outcome.linesWith(isAbsent ? "Unsupported wrapper class" : "Unsupported"), isAbsent ? 1 : 0)
            << outcome.text;
        const std::string text = test::textOfFile(copy);
        EXPECT_NE(text.find(isAbsent ? "osg::PagedLOD" : "osgAnalyticBin::InstallBinsCallback"), std::string::npos);
        EXPECT_EQ(text.find("CullingActive"), std::string::npos);
    }
}

TEST_F(StockTools, AWrongParameterIsOneClearLineAndAFailure) {
    const std::string copy = _folder / "copy.osgb";
    const Outcome outcome = convert(_database + ".(method=cube).analyticbin", copy, Modules::Present);
    EXPECT_NE(outcome.code, 0);
    EXPECT_EQ(outcome.linesWith("bad method \"cube\" (use method=quadratic|exact|sphere|none)"), 1) << outcome.text;
    EXPECT_FALSE(fs::exists(copy));
}

using test::CullView;
using test::PagedFlight;

class Archive : public StockTools {
protected:
    void SetUp() override {
        if (!fs::exists(OSGARCHIVE_FILE)) GTEST_SKIP() << "needs osgarchive";
        pack(Modules::Present);
        ASSERT_TRUE(fs::exists(_archive));
    }
    void TearDown() override { osgDB::Registry::instance()->clearArchiveCache(); }
    // The first file is the one that opening the archive reads.
    Outcome pack(Modules modules) const {
        Outcome outcome = test::runStock("sh -c \"cd " + _folder.path() + " && " + OSGARCHIVE_FILE +
                                             " -a packed/globe.osga -i globe.osgb tiles_*.osgb\"",
                                         modules);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return outcome;
    }
    // Returns: what is drawn when everything in view is loaded.
    std::multiset<std::string> drawnFrom(osg::Node& scene) const {
        PagedFlight flight(scene);
        EXPECT_TRUE(flight.load(_view));
        return flight.drawn();
    }

    const std::string _archive = _folder.makeFolder("packed") + "/globe.osga";
    const CullView _view = CullView::lookAt({6.7e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 60.0);
};

TEST_F(Archive, IsDrawnAsItsFilesAreAndEveryTileHasItsBin) {
    const osg::ref_ptr<osg::Node> files = osgDB::readRefNodeFile(_database + ".analyticbin");
    const std::multiset<std::string> drawn = drawnFrom(*files);
    for (const char* suffix : {".analyticbin", ".(method=exact).analyticbin", ""}) {
        const osg::ref_ptr<osg::Node> packed = osgDB::readRefNodeFile(_archive + suffix);
        ASSERT_TRUE(packed) << suffix;
        EXPECT_EQ(drawnFrom(*packed), drawn) << suffix;
        EXPECT_GT(test::tilesWith<AnalyticBinCullCallback>(*packed), 32u) << suffix;
    }
}

// osgarchive reads and writes each file anew, and drops what it does not know.
TEST_F(Archive, PackedWithoutTheModulesLosesTheDatabasesRequestAndKeepsTheBins) {
    fs::remove(_archive);
    const Outcome outcome = pack(Modules::Absent);
    EXPECT_EQ(outcome.linesWith("Unsupported wrapper class"), 1) << outcome.text;
    const osg::ref_ptr<osg::Node> plain = osgDB::readRefNodeFile(_archive);
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->getUpdateCallback(), nullptr);
    const osg::ref_ptr<osg::Node> packed = osgDB::readRefNodeFile(_archive + ".analyticbin");
    EXPECT_GE(test::tilesWith<AnalyticBinCullCallback>(*packed), 32u);
}

}  // namespace
}  // namespace osgAnalyticBin
