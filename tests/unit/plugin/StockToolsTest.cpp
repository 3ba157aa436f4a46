// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The stock osgviewer and osgconv, with and without the modules on OSG's plugin path. Pictures are compared in
// applications/osgbinflight/; here it is what the programs say, and how they end.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;

using test::Modules;
using test::Outcome;

class StockTools : public ::testing::Test {
protected:
    void SetUp() override {
        _database = test::writeSyntheticDatabase(_folder.path());
        ASSERT_FALSE(_database.empty());
    }

    test::TemporaryFolder _folder;
    std::string _database;
};

TEST_F(StockTools, WithoutTheModulesADatabaseOpensWithOneWarning) {
    const std::string copy = _folder / "copy.osgt";
    const Outcome outcome = test::runOsgconv(test::quoted(_database) + ' ' + test::quoted(copy), Modules::Absent);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(outcome.linesWith("Unsupported wrapper class"), 1) << outcome.text;
    const std::string text = test::textOfFile(copy);
    EXPECT_NE(text.find("osg::PagedLOD"), std::string::npos);
    EXPECT_EQ(text.find("CullingActive"), std::string::npos);  // nothing stored switches culling off
}

TEST_F(StockTools, WithTheModulesADatabaseSurvivesOsgconv) {
    const std::string copy = _folder / "copy.osgt";
    const Outcome outcome = test::runOsgconv(test::quoted(_database) + ' ' + test::quoted(copy), Modules::Present);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(outcome.linesWith("Unsupported"), 0) << outcome.text;
    const std::string text = test::textOfFile(copy);
    EXPECT_NE(text.find("osgAnalyticBin::InstallBinsCallback"), std::string::npos);
    EXPECT_EQ(text.find("CullingActive"), std::string::npos);
}

TEST_F(StockTools, AWrongParameterIsOneClearLineAndAFailure) {
    const std::string copy = _folder / "copy.osgb";
    const Outcome outcome = test::runOsgconv(
        test::quoted(_database + ".(method=cube).analyticbin") + ' ' + test::quoted(copy), Modules::Present);
    EXPECT_NE(outcome.code, 0);
    EXPECT_EQ(outcome.linesWith("bad method \"cube\" (use method=quadratic|exact|sphere|none)"), 1) << outcome.text;
    EXPECT_FALSE(fs::exists(copy));
}

}  // namespace
}  // namespace osgAnalyticBin
