// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which words of OSG's option string the pseudo-loader takes for its own, refuses, or reports. The string is one for
// all plugins. Needs OSG_LIBRARY_PATH. What the options mean is tested in PluginTest.cpp and kit/CullOptionsTest.cpp.

#include <osgAnalyticBin/CullOptions.h>

#include <gtest/gtest.h>
#include <osgDB/PluginQuery>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <set>
#include <support/CapturedNotes.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

const std::string kUnknown = "known neither to osgAnalyticBin nor to another plugin";

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

TEST_F(OptionString, ItemsThatLookLikeOursAreRefused) {
    for (const auto& [text, meant] : {std::pair{"metod=exact", "method="},
                                      {"Method=exact", "method="},
                                      {"mehtod=exact", "method="},
                                      {"horizont=off", "horizon="},
                                      {"height=-500..9000", "heights="},
                                      {"idnex=off", "index="},
                                      {"inherit_viewpoint=on", "inheritviewpoint="},
                                      {"compressed;skirt=all", "skirts="},
                                      {"method", "method="},
                                      {"precision 17,edges", "edges="}}) {
        const osgDB::ReaderWriter::ReadResult result = read(text);
        EXPECT_TRUE(result.error()) << text;
        EXPECT_NE(result.message().find(meant), std::string::npos) << text << ": " << result.message();
    }
}

TEST_F(OptionString, UnknownItemsBesideOursAreReported) {
    const test::CapturedNotes notes;
    EXPECT_TRUE(read("speed=9 method=exact").success());
    EXPECT_EQ(notes.count("\"speed=9\" in the option string is " + kUnknown), 1u);
    EXPECT_TRUE(read("method=exact,speed=9;colour=red").success());
    EXPECT_EQ(notes.count(kUnknown), 3u);
}

TEST_F(OptionString, WhatIsForOtherPluginsAloneIsLeftToThem) {
    const test::CapturedNotes notes;
    for (const char* text : {"", "speed=9", "OSG_CURL_TIMEOUT=9 precision 17", "noTriStripPolygons flip;colour=red",
                             "method=exact compressed dds_flip", "precision 17,horizon=off"}) {
        EXPECT_TRUE(read(text).success()) << text;
    }
    EXPECT_EQ(notes.count(""), 0u);
}

TEST_F(OptionString, ItemsOfLoadedPluginsAreNotReported) {
    // as when a database comes from a server, or its tiles have text
    for (const char* extension : {"curl", "osgb", "freetype"})
        osgDB::Registry::instance()->loadLibrary(osgDB::Registry::instance()->createLibraryNameForExtension(extension));
    const test::CapturedNotes notes;
    EXPECT_TRUE(read("method=exact OSG_CURL_CONNECTTIMEOUT=5 Compressor=zlib").success());
    EXPECT_EQ(notes.count(""), 0u);
}

TEST_F(OptionString, NoOptionOfAPluginOfOsgIsRefused) {
    // plugins that are asked and not loaded; freetype's "index=" is one of ours too
    std::set<std::string> options;
    for (const char* extension :
         {"3ds", "curl",       "dae", "dds", "dxf", "freetype", "gles", "ive",  "jpeg", "lwo",
          "obj", "openflight", "osg", "ply", "png", "stl",      "tga",  "tiff", "trk",  "txp"}) {
        osgDB::ReaderWriterInfoList plugins;
        (void)osgDB::queryPlugin(osgDB::Registry::instance()->createLibraryNameForExtension(extension), plugins);
        for (const auto& plugin : plugins)
            for (const auto& option : plugin->options) options.insert(option.first);
    }
    ASSERT_GT(options.size(), 50u);
    std::set<std::string> own;
    for (const std::string& key : cullOptionKeys()) own.insert(key);
    for (const std::string& option : options) {
        const std::string key = option.substr(0, option.find_first_of("= <"));
        if (own.count(key) > 0) continue;
        EXPECT_TRUE(read(key + "=1").success()) << option;
    }
}

// A fault that no test noticed: an option that was parsed, and missing from `osgconv --format analyticbin`.
TEST_F(OptionString, EveryOptionIsListedAndEveryListedOneIsKnown) {
    osgDB::ReaderWriter* reader = osgDB::Registry::instance()->getReaderWriterForExtension("analyticbin");
    ASSERT_NE(reader, nullptr);
    std::set<std::string> listed;
    for (const auto& option : reader->supportedOptions()) {
        const std::string key = option.first.substr(0, option.first.find('='));
        EXPECT_TRUE(listed.insert(key).second) << key << " is listed twice";
        EXPECT_FALSE(option.second.empty()) << key;
        std::string error;
        const bool takesAnyName = key == "ground";
        EXPECT_EQ(cullOptionsFromText(key + "=?", error).has_value(), takesAnyName) << key;
        EXPECT_EQ(error.find("unknown parameter"), std::string::npos) << error;
    }
    const std::vector<std::string> keys = cullOptionKeys();
    EXPECT_EQ(listed, std::set<std::string>(keys.begin(), keys.end()));
    // and the parser's own advice
    std::string error;
    EXPECT_FALSE(cullOptionsFromText("?=1", error));
    for (const std::string& key : listed) EXPECT_NE(error.find(key + '='), std::string::npos) << error;
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
