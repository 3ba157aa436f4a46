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

TEST(GlobeOptions, AreReadFromTheNameOfTheFile) {
    EXPECT_EQ(optionsOf("20.proceduralglobe").levels, 20);
    EXPECT_EQ(optionsOf("folder/0.proceduralglobe").levels, 0);
    const GlobeOptions options = optionsOf("(levels=3,cells=8,relief=1200.5,lod=2.5,bins=off).proceduralglobe");
    EXPECT_EQ(options.levels, 3);
    EXPECT_EQ(options.cells, 8);
    EXPECT_EQ(options.relief, 1200.5);
    EXPECT_EQ(options.lod, 2.5);
    EXPECT_FALSE(options.bins);
    EXPECT_EQ(optionsOf("7.(cells=4).proceduralglobe").levels, 7);
    EXPECT_EQ(optionsOf("7.(cells=4).proceduralglobe").cells, 4);
}

TEST(GlobeOptions, OfTheNameWinOverTheOptionString) {
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
    EXPECT_EQ(optionsOf(rootFileOf(options)), options);
    const osgbindem::TileId tile{23, (16 << 23) - 1, (8 << 23) - 1};
    const auto name = globeNameOf(childrenFileOf(tile, options), "levels=3");
    EXPECT_EQ(name.options, options);
    ASSERT_TRUE(name.tile);
    EXPECT_EQ(*name.tile, tile);
}

TEST(GlobeOptions, ErrorsNameWhatIsWrongAndWhatIsAllowed) {
    for (const char* const name :
         {"25.proceduralglobe", "-1.proceduralglobe", "1.5.proceduralglobe", "earth.proceduralglobe"})
        EXPECT_NE(errorOf(name).find("number of levels"), std::string::npos) << name;
    for (const char* const item : {"levels=25", "cells=3", "cells=66", "cells=0", "relief=-1", "relief=20001",
                                   "lod=0.5", "bins=maybe", "colour=red", "levels"}) {
        const std::string error = errorOf(std::string("(") + item + ").proceduralglobe");
        EXPECT_NE(error.find(std::string("\"") + item + "\"; allowed are"), std::string::npos) << error;
    }
    EXPECT_NE(errorOf("3.proceduralglobe", "cells=3").find("malformed"), std::string::npos);
}

TEST(GlobeOptions, TilesOutsideTheGlobeHaveNoChildren) {
    for (const char* const tile : {"3-0-0", "0-16-0", "0-0-8", "1-32-0", "2--1-0"})
        EXPECT_NE(errorOf(std::string(tile) + ".(levels=3).proceduralglobe").find("has no children"), std::string::npos)
            << tile;
}

}  // namespace
}  // namespace osgAnalyticBin::globe
