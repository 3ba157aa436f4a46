// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Names and parameters of the pseudo-loader.

#include "FlightOptions.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::flight {
namespace {

TEST(FlightName, TakesTheBracketsOff) {
    const FlightName name = flightNameOf("a.b/path.csv.(out=x/y.z,frames=3).binflight");
    EXPECT_EQ(name.pathFile, "a.b/path.csv");
    EXPECT_EQ(name.parameters, "out=x/y.z,frames=3");
}

TEST(FlightName, NeedsNoBrackets) {
    EXPECT_EQ(flightNameOf("path.csv.binflight").pathFile, "path.csv");
    EXPECT_TRUE(flightNameOf("path.csv.binflight").parameters.empty());
}

TEST(FlightOptions, ReadsEveryParameter) {
    FlightOptions options;
    std::string error;
    ASSERT_TRUE(applyParameters("out=/tmp/a folder, frames=3 ,timeout=1.5", options, error)) << error;
    EXPECT_EQ(options.out, "/tmp/a folder");
    EXPECT_EQ(options.frames, 3);
    EXPECT_EQ(options.timeout, 1.5);
}

TEST(FlightOptions, NamesAnUnknownOrMalformedParameter) {
    for (const char* const bad : {"speed=3", "frames=0", "frames=1.5", "frames=many", "timeout=-1", "out=", "frames"}) {
        FlightOptions options;
        std::string error;
        EXPECT_FALSE(applyParameters(bad, options, error)) << bad;
        EXPECT_NE(error.find(bad), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST(FlightOptions, PassesOverTheOptionsOfOtherPlugins) {
    FlightOptions options;
    std::string error;
    ASSERT_TRUE(applyOptionString("method=sphere frames=7 dds_flip", options, error)) << error;
    EXPECT_EQ(options.frames, 7);
    EXPECT_FALSE(applyOptionString("method=sphere frames=seven", options, error));
}

}  // namespace
}  // namespace osgAnalyticBin::flight
