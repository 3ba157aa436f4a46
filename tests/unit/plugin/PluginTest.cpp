// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The pseudo-loader, called as an application calls it: by a file name. Needs OSG_LIBRARY_PATH.

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinIndex.h>

#include <gtest/gtest.h>
#include <osgDB/Archive>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <support/AnyScene.h>
#include <support/CapturedNotes.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

// The callbacks below a node, and the options of the last.
struct Counted {
    int count = 0;
    int withoutSpheres = 0;
    CullOptions options;
};

Counted counted(osg::Node& scene) {
    Counted found;
    test::visitNodes(scene, [&found](osg::Node& node) {
        if (const auto* callback = dynamic_cast<AnalyticBinCullCallback*>(node.getCullCallback())) {
            ++found.count;
            found.options = callback->getCullOptions();
        }
        if (!node.getCullingActive()) ++found.withoutSpheres;
    });
    return found;
}

class Plugin : public ::testing::Test {
protected:
    osg::ref_ptr<osg::Node> read(const std::string& suffix, const std::string& optionString = {}) {
        const osg::ref_ptr<osgDB::Options> options = new osgDB::Options(optionString);
        return osgDB::readRefNodeFile(_database + suffix, options.get());
    }

    const test::TemporaryFolder _folder;
    const std::string _database = test::writeSyntheticDatabase(_folder.path());
};

TEST_F(Plugin, TheObjectCacheKeepsTheDatabaseWithAndWithoutBinsApart) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_ALL);
    const auto read = [&](const std::string& suffix) { return osgDB::readRefNodeFile(_database + suffix, options); };
    const osg::ref_ptr<osg::Node> plain = read(""), bins = read(".analyticbin"),
                                  exact = read(".(method=exact).analyticbin");
    ASSERT_TRUE(plain && bins && exact);
    EXPECT_EQ(counted(*plain).count, 0);
    EXPECT_EQ(counted(*bins).options.method, Method::Quadratic);
    EXPECT_EQ(counted(*exact).options.method, Method::Exact);
    EXPECT_EQ(read(""), plain);
    EXPECT_EQ(read(".analyticbin"), bins);
    osgDB::Registry::instance()->clearObjectCache();
}

TEST_F(Plugin, SaysOnceHowManyTilesHaveBins) {
    const test::CapturedNotes notes(osg::NOTICE);
    const int tiles = counted(*read(".analyticbin")).count;
    ASSERT_GT(tiles, 0);
    EXPECT_EQ(notes.count("has bins on " + std::to_string(tiles) + " tiles"), 1u);
    (void)read(".(method=sphere).analyticbin");
    EXPECT_EQ(notes.count("has bins"), 1u);
}

// The same through the option string; the file name wins.
TEST_F(Plugin, TakesParametersInThePseudoLoadersManner) {
    const CullOptions options = counted(*read(".(method=exact,expiry=1.25).analyticbin")).options;
    EXPECT_EQ(options.method, Method::Exact);
    EXPECT_EQ(options.expiry, 1.25);
    EXPECT_EQ(counted(*read(".analyticbin", "other=1 method=exact")).options.method, Method::Exact);
    EXPECT_EQ(counted(*read(".(method=exact).analyticbin", "method=none")).options.method, Method::Exact);
}

TEST_F(Plugin, SphereInstallsNothingAndNoneSwitchesCullingOff) {
    for (const char* method : {"sphere", "none"}) {
        const Counted counter = counted(*read(std::string(".(method=") + method + ").analyticbin"));
        EXPECT_EQ(counter.count, 0);
        EXPECT_EQ(counter.withoutSpheres, 0);
    }
}

TEST_F(Plugin, RefusesWhatItDoesNotKnow) {
    for (const char* suffix : {".(method=cube).analyticbin", ".(method=paper).analyticbin", ".(speed=9).analyticbin",
                               ".(method).analyticbin"})
        EXPECT_FALSE(read(suffix)) << suffix;
    EXPECT_FALSE(read(".analyticbin", "method=cube"));
    EXPECT_FALSE(osgDB::readRefNodeFile(_folder / "absent.osgb.analyticbin"));
    EXPECT_FALSE(osgDB::readRefNodeFile(".analyticbin"));
}

TEST_F(Plugin, IsKnownToOsgByNameWithItsOptions) {
    osgDB::ReaderWriter* reader = osgDB::Registry::instance()->getReaderWriterForExtension("analyticbin");
    ASSERT_NE(reader, nullptr);
    EXPECT_TRUE(reader->acceptsExtension("analyticbin"));
    EXPECT_EQ(reader->supportedOptions().count("method=quadratic|exact|sphere|none"), 1u);
    const auto listed = reader->supportedOptions().find("heights=LOW..HIGH");
    ASSERT_NE(listed, reader->supportedOptions().end());
    const std::string low = std::to_string(static_cast<int>(CullOptions::kTerrainOnEarth.lower));
    const std::string high = std::to_string(static_cast<int>(CullOptions::kTerrainOnEarth.upper));
    EXPECT_NE(listed->second.find(low + ".." + high), std::string::npos) << listed->second;
}

// The option string is one for all plugins.
TEST_F(Plugin, LeavesToOtherPluginsWhatIsForThemAlone) {
    const test::CapturedNotes notes;
    for (const char* text : {"", "speed=9", "OSG_CURL_TIMEOUT=9 precision 17", "noTriStripPolygons flip;colour=red",
                             "method=exact compressed dds_flip", "precision 17,horizon=off"})
        EXPECT_TRUE(read(".analyticbin", text)) << text;
    EXPECT_EQ(notes.count(""), 0u);
}

osg::ref_ptr<BinIndex> makeIndex() {
    osg::ref_ptr<BinIndex> index = new BinIndex;
    index->setSource({"globe.osgb", 1, 2});
    index->setTiles("", {{AnalyticBin(core::GeodeticBin::fromDegrees({1, 2}, {3, 4}, {5, 6})), 5.0, 77}});
    return index;
}

TEST_F(Plugin, ReadsIndexesOfBinsByNameAndFromStreams) {
    const osg::ref_ptr<BinIndex> index = makeIndex();
    std::string error;
    ASSERT_TRUE(index->write(_folder / "globe.osgb.bins", error)) << error;
    const osg::ref_ptr<BinIndex> read =
        dynamic_cast<BinIndex*>(osgDB::readRefObjectFile(_folder / "globe.osgb.bins").get());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->find("", 0)->fingerprint, 77u);
    EXPECT_FALSE(osgDB::readRefNodeFile(_folder / "globe.osgb.bins"));

    // as osgdb_curl and archives do
    std::stringstream stream;
    ASSERT_TRUE(index->write(stream));
    osgDB::ReaderWriter* reader = osgDB::Registry::instance()->getReaderWriterForExtension("bins");
    ASSERT_NE(reader, nullptr);
    EXPECT_TRUE(dynamic_cast<BinIndex*>(reader->readObject(stream).getObject()));
    std::istringstream broken("no index");
    EXPECT_TRUE(reader->readObject(broken).error());
}

TEST_F(Plugin, ArchivesHoldIndexesBesideTheirDatabases) {
    const osg::ref_ptr<BinIndex> index = makeIndex();
    const std::string name = _folder / "globe.osga";
    {
        const osg::ref_ptr<osgDB::Archive> archive = osgDB::openArchive(name, osgDB::ReaderWriter::CREATE);
        ASSERT_TRUE(archive);
        ASSERT_TRUE(archive->writeObject(*index, "globe.osgb.bins").success());
        archive->close();
    }
    osgDB::Registry::instance()->clearArchiveCache();
    std::string error;
    const osg::ref_ptr<BinIndex> read = readBinIndex(name + "/globe.osgb", nullptr, error);
    ASSERT_TRUE(read) << error;
    EXPECT_EQ(read->find("", 0)->fingerprint, 77u);
    EXPECT_FALSE(readBinIndex(name + "/other.osgb", nullptr, error));
    EXPECT_EQ(error, "");
    osgDB::Registry::instance()->clearArchiveCache();
}

}  // namespace
}  // namespace osgAnalyticBin
