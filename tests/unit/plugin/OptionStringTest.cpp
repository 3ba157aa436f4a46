// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which words of OSG's option string the pseudo-loader takes for its own. The string is one for all plugins. Needs
// OSG_LIBRARY_PATH. What the options mean is tested in PluginTest.cpp and kit/CullOptionsTest.cpp.

#include <osgAnalyticBin/CullOptions.h>

#include <gtest/gtest.h>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <support/CapturedNotes.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

class OptionString : public ::testing::Test {
protected:
    void SetUp() override {
        _database = test::writeSyntheticDatabase(_folder.path());
        ASSERT_FALSE(_database.empty());
    }
    // What the pseudo-loader itself answers.
    osgDB::ReaderWriter::ReadResult read(const std::string& optionString) const {
        osgDB::ReaderWriter* reader = osgDB::Registry::instance()->getReaderWriterForExtension("analyticbin");
        if (!reader) return {"no pseudo-loader"};
        const osg::ref_ptr<osgDB::Options> options = new osgDB::Options(optionString);
        return reader->readNode(_database + ".analyticbin", options.get());
    }
    test::TemporaryFolder _folder;
    std::string _database;
};

TEST_F(OptionString, WhatIsForOtherPluginsAloneIsLeftToThem) {
    const test::CapturedNotes notes;
    for (const char* text : {"", "speed=9", "OSG_CURL_TIMEOUT=9 precision 17", "noTriStripPolygons flip;colour=red",
                             "method=exact compressed dds_flip", "precision 17,horizon=off"}) {
        EXPECT_TRUE(read(text).success()) << text;
    }
    EXPECT_EQ(notes.count(""), 0u);
}

TEST_F(OptionString, TheListedDefaultOfHeightsIsTheDefault) {
    osgDB::ReaderWriter* reader = osgDB::Registry::instance()->getReaderWriterForExtension("analyticbin");
    ASSERT_NE(reader, nullptr);
    const auto listed = reader->supportedOptions().find("heights=LOW..HIGH");
    ASSERT_NE(listed, reader->supportedOptions().end());
    const std::string low = std::to_string(static_cast<int>(CullOptions::kTerrainOnEarth.lower));
    const std::string high = std::to_string(static_cast<int>(CullOptions::kTerrainOnEarth.upper));
    EXPECT_NE(listed->second.find(low + ".." + high), std::string::npos) << listed->second;
}

}  // namespace
}  // namespace osgAnalyticBin
