// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Names and parameters of the pseudo-loader.

#include "Failure.h"
#include "FlightOptions.h"

#include <osgAnalyticBin/NameParameters.h>

#include <gtest/gtest.h>

#include <support/FailureText.h>

namespace osgAnalyticBin::flight {
namespace {

TEST(NameParameters, AreWhatStandsInTheLastBrackets) {
    const NameParameters name = nameParametersFrom("a.b/path.csv.(out=x (1)/y.z,frames=3)");
    EXPECT_EQ(name.name, "a.b/path.csv");
    EXPECT_EQ(name.parameters, "out=x (1)/y.z,frames=3");
}

TEST(NameParameters, MayBeMissing) {
    for (const char* const name : {"path.csv", "earth (1)", ""}) {
        EXPECT_EQ(nameParametersFrom(name).name, name);
        EXPECT_TRUE(nameParametersFrom(name).parameters.empty());
    }
}

TEST(NameParameters, NeedNoName) {
    EXPECT_TRUE(nameParametersFrom("(levels=12)").name.empty());
    EXPECT_EQ(nameParametersFrom("(levels=12)").parameters, "levels=12");
}

TEST(FlightOptions, ReadsEveryParameter) {
    FlightOptions options;
    readBracketed(options.parameters(), "out=/tmp/a folder, frames=3 ,timeout=1.5");
    EXPECT_EQ(options.out, "/tmp/a folder");
    EXPECT_EQ(options.frames, 3);
    EXPECT_EQ(options.timeout, 1.5);
}

TEST(FlightOptions, NamesAnUnknownOrMalformedParameter) {
    for (const char* const bad : {"speed=3", "frames=0", "frames=1.5", "frames=many", "timeout=-1", "out=", "frames"}) {
        FlightOptions options;
        const std::string error = test::failureOf([&] { readBracketed(options.parameters(), bad); });
        EXPECT_NE(error.find(bad), std::string::npos) << error;
    }
}

TEST(FlightOptions, PassesOverTheOptionsOfOtherPlugins) {
    FlightOptions options;
    readOptionString(options.parameters(), "method=sphere frames=7 dds_flip");
    EXPECT_EQ(options.frames, 7);
    EXPECT_THROW(readOptionString(options.parameters(), "method=sphere frames=seven"), support::Failure);
}

}  // namespace
}  // namespace osgAnalyticBin::flight
