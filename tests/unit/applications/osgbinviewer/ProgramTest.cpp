// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What osgbinviewer says when it cannot show a database: one line, and an exit code. No display is needed.

#include <gtest/gtest.h>

#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

Outcome runWithoutDisplay(const std::string& arguments) {
    return runStock("env -u DISPLAY timeout 60 " + quoted(VIEWER_FILE) + ' ' + arguments, Modules::Present);
}

void expectOneLine(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.text.rfind("osgbinviewer: ", 0), 0u) << outcome.text;
    EXPECT_NE(outcome.text.find(what), std::string::npos) << outcome.text;
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << outcome.text;
}

TEST(ViewerProgram, WithoutADisplayFailsWithOneLine) {
    expectOneLine(runWithoutDisplay("0.proceduralglobe"), "display");
    expectOneLine(runWithoutDisplay("0.proceduralglobe --steps at=home"), "display");
}

TEST(ViewerProgram, NamesTheDatabaseAsTheUserDid) {
    for (const char* options : {"", " --options edges=off"}) {
        const Outcome outcome = runWithoutDisplay(std::string("nope.osgb") + options);
        expectOneLine(outcome, "nope.osgb: ");
        EXPECT_EQ(outcome.text.find("edges"), std::string::npos) << outcome.text;
        EXPECT_EQ(outcome.text.find("analyticbin"), std::string::npos) << outcome.text;
    }
    const TemporaryFolder folder;
    expectOneLine(runWithoutDisplay(quoted(folder.write("broken.osgb", "no scene"))), "broken.osgb: ");
    expectOneLine(runWithoutDisplay("'0.proceduralglobe.(metod=exact).analyticbin'"), "metod");
}

TEST(ViewerProgram, RefusesAWrongCommandLine) {
    for (const char* const wrong : {"", "earth.osgb --options metod=exact", "earth.osgb --frobnicate"})
        EXPECT_EQ(runWithoutDisplay(wrong).code, 2) << wrong;
}

TEST(ViewerProgram, HelpAndVersionNeedNoDisplay) {
    EXPECT_EQ(runWithoutDisplay("--help").code, 0);
    EXPECT_EQ(runWithoutDisplay("--version").code, 0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
