// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Diagrams: what their data say, and that gnuplot draws them. Skipped where gnuplot is not installed.

#include "EmptyRows.h"
#include "Failure.h"
#include "Output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::bench {
namespace {

using report::Diagram;
using report::plot;
using support::Failure;

const std::vector<std::string> kPlotPoses{"down_1", "down_2", "far_1"};

MethodFigures figuresOf(const std::string& method, std::uint64_t drawn, double cullMs) {
    MethodFigures figures{method, emptyRows(kPlotPoses.size())};
    for (report::Json& pose : figures.rows) {
        pose["truth_tiles"] = 4;
        pose["drawn_tiles"] = drawn;
        pose["files_requested"] = 3;
        pose["cull_ms"] = cullMs;
        pose["cull_spread_ms"] = cullMs / 4.0;
    }
    return figures;
}

std::vector<Diagram> diagrams() {
    return diagramsOf(kPlotPoses,
                      {figuresOf("none", 40, 2.0), figuresOf("sphere", 8, 1.0), figuresOf("a+b_c", 4, 0.5)});
}

const Diagram& named(const std::vector<Diagram>& diagrams, const std::string& name) {
    return *std::find_if(diagrams.begin(), diagrams.end(), [&](const Diagram& d) { return d.name == name; });
}

std::string firstBytes(const std::string& file, std::size_t count) {
    std::ifstream input(file, std::ios::binary);
    std::string bytes(count, '\0');
    input.read(bytes.data(), static_cast<std::streamsize>(count));
    return bytes;
}

/// Another search path for programs, as long as it lives.
class SearchPath {
public:
    explicit SearchPath(const std::string& path) : _before(std::getenv("PATH")) { setenv("PATH", path.c_str(), 1); }
    ~SearchPath() { setenv("PATH", _before.c_str(), 1); }
    SearchPath(const SearchPath&) = delete;
    SearchPath& operator=(const SearchPath&) = delete;

private:
    std::string _before;
};

bool hasGnuplot() {
    return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

TEST(Plot, DataHoldRatiosAndMeansByPathWithoutTheReference) {
    const std::vector<Diagram> all = diagrams();
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(named(all, "drawn").data, "path,sphere,a+b_c\ndown,2,1\nfar,2,1\n");
    EXPECT_EQ(named(all, "files").data, "path,sphere,a+b_c\ndown,3,3\nfar,3,3\n");
    EXPECT_EQ(named(all, "cull").data,
              "path,sphere,sphere half spread,a+b_c,a+b_c half spread\n"
              "down,1,0.125,0.5,0.0625\nfar,1,0.125,0.5,0.0625\n");
}

TEST(Plot, ShowsTheReferenceWhereItIsAlone) {
    EXPECT_EQ(named(diagramsOf(kPlotPoses, {figuresOf("none", 8, 1.0)}), "drawn").data, "path,none\ndown,2\nfar,2\n");
}

TEST(Plot, DrawsEveryDiagramTwice) {
    if (!hasGnuplot()) GTEST_SKIP() << "needs gnuplot";
    const test::TemporaryFolder folder;
    const std::string place = folder / "a folder/figures";
    plot(place, diagrams());
    for (const Diagram& diagram : diagrams()) {
        EXPECT_EQ(firstBytes(place + "/" + diagram.name + ".png", 4), "\x89PNG") << diagram.name;
        EXPECT_NE(firstBytes(place + "/" + diagram.name + ".svg", 300).find("<svg"), std::string::npos) << diagram.name;
        EXPECT_EQ(test::textOfFile(place + "/" + diagram.name + ".csv"), diagram.data);
    }
}

TEST(Plot, DrawsPosesThatNothingIsCountedAt) {
    if (!hasGnuplot()) GTEST_SKIP() << "needs gnuplot";
    const test::TemporaryFolder folder;
    EXPECT_NO_THROW(plot(folder.path(), diagramsOf({"a", "b"}, {{"sphere", emptyRows(2)}})));
}

TEST(Plot, KeepsDataAndScriptsWhereThereIsNoGnuplot) {
    const test::TemporaryFolder folder;
    const SearchPath nowhere(folder.path());
    try {
        plot(folder.path(), diagrams());
        ADD_FAILURE() << "drawn without gnuplot";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("gnuplot is not installed"), std::string::npos) << failure.what();
    }
    for (const Diagram& diagram : diagrams()) {
        EXPECT_EQ(test::textOfFile(folder / (diagram.name + ".csv")), diagram.data);
        EXPECT_EQ(test::textOfFile(folder / (diagram.name + ".gp")), diagram.script);
    }
}

TEST(Plot, SaysWhichScriptFailed) {
    if (!hasGnuplot()) GTEST_SKIP() << "needs gnuplot";
    const test::TemporaryFolder folder;
    EXPECT_THROW(plot(folder.path(), {{"broken", "", "plot 1 with nothing\n"}}), Failure);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
