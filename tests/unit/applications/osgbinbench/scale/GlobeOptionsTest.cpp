// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GlobeOptions.h"

#include <gtest/gtest.h>

#include <support/FailureText.h>

namespace osgAnalyticBin::globe {
namespace {

GlobeOptions optionsOf(const std::string& name, const std::string& optionString = {}) {
    return globeNameOf(name, optionString).options;
}

std::string errorOf(const std::string& name, const std::string& optionString = {}) {
    return test::failureOf([&] { (void)globeNameOf(name, optionString); });
}

TEST(GlobeOptions, AreReadFromTheNameOfTheFileWhichWinsOverTheOptionString) {
    EXPECT_EQ(optionsOf("20.proceduralglobe").levels, 20);
    EXPECT_EQ(optionsOf("folder/0.proceduralglobe").levels, 0);
    EXPECT_EQ(optionsOf("7.(cells=4).proceduralglobe").levels, 7);
    EXPECT_EQ(optionsOf("7.(cells=4).proceduralglobe").cells, 4);
    const GlobeOptions options = optionsOf("7.proceduralglobe", "method=exact levels=3,cells=4");
    EXPECT_EQ(options.levels, 7);
    EXPECT_EQ(options.cells, 4);
}

TEST(GlobeOptions, NamesOfFilesReadBackToTheSame) {
    GlobeOptions options;
    options.levels = 24;
    options.cells = 2;
    options.relief = 0.1;
    options.lod = 5.5;
    options.bins = false;
    EXPECT_EQ(optionsOf("(levels=24,cells=2,relief=0.1,lod=5.5,bins=off).proceduralglobe"), options);
    EXPECT_EQ(optionsOf(rootFileOf(options)), options);
    const tiles::TileId tile{23, (16 << 23) - 1, (8 << 23) - 1};
    const auto name = globeNameOf(childrenFileOf(tile, options), "levels=3");
    EXPECT_EQ(name.options, options);
    ASSERT_TRUE(name.tile);
    EXPECT_EQ(*name.tile, tile);
}

TEST(GlobeOptions, ErrorsNameWhatIsWrongAndWhatIsAllowed) {
    const auto expectError = [](const std::string& name, const std::string& what) {
        EXPECT_NE(errorOf(name).find(what), std::string::npos) << name << ": " << errorOf(name);
    };
    for (const std::string name : {"25", "-1", "1.5", "earth"})
        expectError(name + ".proceduralglobe", "number of levels");
    for (const std::string item : {"levels=25", "cells=3", "cells=66", "cells=0", "relief=-1", "relief=20001",
                                   "lod=0.5", "bins=maybe", "colour=red", "levels"})
        expectError("(" + item + ").proceduralglobe", "\"" + item + "\"; allowed are");
    for (const std::string tile : {"3-0-0", "0-16-0", "0-0-8", "1-32-0", "2--1-0"})
        expectError(tile + ".(levels=3).proceduralglobe", "has no children");
    EXPECT_NE(errorOf("3.proceduralglobe", "cells=3").find("malformed"), std::string::npos);
}

}  // namespace
}  // namespace osgAnalyticBin::globe
