// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What osgbinviewer says when it cannot show a database: one line, and an exit code. No display is needed.

#include <support/Programs.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

Outcome runWithoutDisplay(const std::string& arguments) {
    return runStock("env -u DISPLAY timeout 60 " + quoted(VIEWER_FILE) + ' ' + arguments, Modules::Present);
}

void expectFailure(const std::string& arguments, const std::string& what) {
    expectOneLine(runWithoutDisplay(arguments), "osgbinviewer", what);
}

TEST(ViewerProgram, FailsWithOneLineThatNamesTheDatabaseAsTheUserDid) {
    for (const std::string options : {"", " --options edges=off"}) {
        const Outcome outcome = runWithoutDisplay("nope.osgb" + options);
        expectOneLine(outcome, "osgbinviewer", "nope.osgb: ");
        EXPECT_EQ(outcome.linesWith("edges") + outcome.linesWith("analyticbin"), 0) << outcome.text;
    }
    const TemporaryFolder folder;
    expectFailure(quoted(folder.write("broken.osgb", "no scene")), "broken.osgb: ");
    expectFailure("'0.proceduralglobe.(metod=exact).analyticbin'", "metod");
    expectFailure("0.proceduralglobe", "display");
    expectFailure("0.proceduralglobe --steps at=home", "display");
}

TEST(ViewerProgram, RefusesAWrongCommandLineAndHelpsWithoutADisplay) {
    for (const char* const wrong : {"", "earth.osgb --options metod=exact", "earth.osgb --frobnicate"})
        EXPECT_EQ(runWithoutDisplay(wrong).code, 2) << wrong;
    EXPECT_EQ(runWithoutDisplay("--help").code, 0);
    EXPECT_EQ(runWithoutDisplay("--version").code, 0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
