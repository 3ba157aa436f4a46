// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What goes wrong ends in one line, a code other than zero, and no files.

#include "BenchProgram.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using test::Outcome;
using test::TemporaryFolder;

constexpr const char* kOnePose =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "down,20,30,10000000,20,30,0,40,1000000,20000000\n";

void expectOneLine(const Outcome& outcome, const std::string& part, int code = 1) {
    EXPECT_EQ(outcome.code, code) << outcome.text;
    EXPECT_EQ(outcome.linesWith("osgbinbench: "), 1) << outcome.text;
    EXPECT_EQ(outcome.linesWith(part), 1) << outcome.text;
}

void expectUsageError(const Outcome& outcome, const std::string& part) {
    expectOneLine(outcome, part, 2);
}

TEST(Errors, OfTheCommandLineNameTheOption) {
    const TemporaryFolder folder;
    const std::string good = "none.osgb --path " + test::quoted(folder.write("p.csv", kOnePose));
    expectUsageError(test::runBenchBlind("reprot"), "the commands are report and scale");
    expectUsageError(test::runBenchBlind(good + " --methods sphere,cube"), "unknown method \"cube\"");
    expectUsageError(test::runBenchBlind(good + " --methods sphere+horizon"), "unknown method \"sphere+horizon\"");
    expectUsageError(test::runBenchBlind(good + " --options horizon=off"), "--options: leave +horizon out");
    expectUsageError(test::runBenchBlind(good + " --options edges=off"), "--options: name methods with or without");
    expectUsageError(test::runBenchBlind(good + " --options occlusion=on"),
                     "--options: name methods with or without +occlusion");
    expectUsageError(test::runBenchBlind(good + " --size 640"), "--size: \"640\"");
    expectUsageError(test::runBenchBlind(good + " --size 640x480x3"), "--size: ");
    expectUsageError(test::runBenchBlind(good + " --threading Many"), "--threading: unknown model \"Many\"");
    expectUsageError(test::runBenchBlind(good + " --options horizont=3"), "--options: unknown parameter");
    expectUsageError(test::runBenchBlind(good + " --options method=paper"), "--options: ");
    expectUsageError(test::runBenchBlind(good + " --vertical-scale 0"), "--vertical-scale");
    for (const std::string option : {"--vertical-scale", "--frame-rate", "--timeout", "--expiry"})
        expectUsageError(test::runBenchBlind(good + ' ' + option + " nan"), option);
    expectUsageError(test::runBenchBlind(good + " --expiry own"), "--expiry: own");
    expectUsageError(test::runBenchBlind(good + " --flush -1"), "--flush");
    expectUsageError(test::runBenchBlind(good + " --frames 10 --pictures pictures"), "--pictures: ");
    expectUsageError(test::runBenchBlind(good + " --jumps --report page.html"), "--report: ");
    expectUsageError(test::runBenchBlind(good + " --draw"), "--draw: ");
    expectOneLine(test::runBenchBlind(good + " --csv " + folder.path() + "/absent/p.csv"), "--csv: there is no folder");
}

TEST(Errors, OfThePathNameTheLine) {
    const TemporaryFolder folder;
    const std::string broken = folder.write("p.csv", std::string(kOnePose) + "low,20,30,abc,20,30,0,40,1,2\n");
    expectOneLine(test::runBenchBlind("x.osgb --path " + test::quoted(broken)), "p.csv:3: eyeAlt");
}

TEST(Errors, SayThatThereIsNoDisplay) {
    const TemporaryFolder folder;
    expectOneLine(test::runBenchBlind("x.osgb --path " + test::quoted(folder.write("p.csv", kOnePose))), "no display");
}

TEST(Errors, OfTheDatabaseLeaveNoTable) {
    if (!test::hasDisplay()) GTEST_SKIP() << "needs xvfb-run";
    const TemporaryFolder folder;
    const std::string path = test::quoted(folder.write("p.csv", kOnePose));
    const std::string csv = folder / "poses.csv";
    const Outcome outcome =
        test::runBench(test::quoted(folder / "absent.osgb") + " --path " + path + " --csv " + test::quoted(csv));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.linesWith("absent.osgb: cannot be read"), 1) << outcome.text;
    EXPECT_LE(outcome.linesWith(""), 2) << outcome.text;  // progress, then what went wrong
    EXPECT_FALSE(std::filesystem::exists(csv));
}

}  // namespace
}  // namespace osgAnalyticBin
