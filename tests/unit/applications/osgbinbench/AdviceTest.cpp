// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The three sentences that osgbinbench ends with.

#include "EmptyRows.h"
#include "Output.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::bench {
namespace {

using Sentences = std::vector<std::string>;

const std::vector<std::string> kPoses{"far_1", "near_1"};

MethodFigures figuresOf(const std::string& method, std::uint64_t far, std::uint64_t near, double farMs, double nearMs) {
    MethodFigures figures{method, emptyRows(2)};
    figures.rows[0]["drawn_tiles"] = figures.rows[0]["files_requested"] = far;
    figures.rows[1]["drawn_tiles"] = figures.rows[1]["files_requested"] = near;
    figures.rows[0]["cull_ms"] = farMs;
    figures.rows[1]["cull_ms"] = nearMs;
    return figures;
}

TEST(Advice, ComparesWithTheBetterOfTheOthersInEachFigure) {
    const Sentences sentences =
        adviceOf(kPoses, {figuresOf("sphere", 90, 30, 1.0, 1.0), figuresOf("cluster", 60, 20, 2.0, 2.0),
                          figuresOf("bins", 30, 10, 0.6, 0.6)});
    EXPECT_EQ(sentences,
              (Sentences{"Bins are worth it for this database: they draw 40 tiles where cluster callbacks draw "
                         "80 (0.50 times).",
                         "They read 40 files where cluster callbacks read 80 (0.50 times), and a cull takes "
                         "0.600 ms where it takes 1.000 ms with spheres (0.60 times).",
                         "They help on every path that was flown."}));
}

TEST(Advice, NamesTheTimeWithColdCachesWhereItWasMeasured) {
    std::vector<MethodFigures> methods{figuresOf("sphere", 30, 30, 1.0, 1.0), figuresOf("bins", 10, 10, 0.5, 0.5)};
    methods[0].rows[0]["cull_cold_ms"] = 4.0;
    methods[1].rows[0]["cull_cold_ms"] = 3.0;
    EXPECT_NE(adviceOf(kPoses, methods)[1].find("(0.50 times, and 0.75 times with cold caches)"), std::string::npos);
}

TEST(Advice, SaysWhereBinsDoNotHelp) {
    const Sentences sentences =
        adviceOf(kPoses, {figuresOf("sphere", 30, 30, 1.0, 1.0), figuresOf("bins", 10, 30, 0.5, 1.5)});
    ASSERT_EQ(sentences.size(), 3U);
    EXPECT_EQ(sentences[2],
              "They do not help, or cost time, here: near (1.00 times the tiles, 1.50 times the cull time).");
}

TEST(Advice, AdvisesAgainstBinsThatOnlyCostTime) {
    const Sentences sentences =
        adviceOf(kPoses, {figuresOf("sphere", 30, 30, 1.0, 1.0), figuresOf("bins", 30, 30, 1.2, 1.2)});
    EXPECT_EQ(sentences.front().rfind("Bins are not worth it for this database:", 0), 0U) << sentences.front();
}

TEST(Advice, NeedsBinsAndWhatTheyAreComparedWith) {
    EXPECT_TRUE(adviceOf(kPoses, {figuresOf("sphere", 1, 1, 1.0, 1.0)}).empty());
    EXPECT_TRUE(adviceOf(kPoses, {figuresOf("none", 1, 1, 1.0, 1.0), figuresOf("bins", 1, 1, 1.0, 1.0)}).empty());
}

}  // namespace
}  // namespace osgAnalyticBin::bench
