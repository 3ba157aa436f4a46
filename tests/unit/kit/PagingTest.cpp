// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles that are read later, as the DatabasePager reads them: through the options of their PagedLOD.

#include "InstallerProbe.h"
#include "PagedFlight.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgDB/FileCache>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>
#include <thread>
#include <unistd.h>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;
using core::GeodeticBin;

const AnalyticBin kPagedBin(GeodeticBin::fromDegrees({0, 22.5}, {0, 22.5}, {-100, 5000}));

osg::ref_ptr<osg::PagedLOD> makePagedTile(const std::string& fileName) {
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(300));
    paged->addChild(geometry, 1e6f, 1e10f);
    paged->setFileName(1, fileName);
    paged->setRange(1, 0.0f, 1e6f);
    setStoredBin(*paged, kPagedBin);
    return paged;
}

osgDB::Options* optionsOf(osg::PagedLOD& paged) {
    return dynamic_cast<osgDB::Options*>(paged.getDatabaseOptions());
}

class Paging : public ::testing::Test {
protected:
    void SetUp() override {
        _folder = fs::temp_directory_path() / ("osganalyticbin_paging_" + std::to_string(::getpid()));
        fs::create_directories(_folder);
        osg::ref_ptr<osg::Group> children = new osg::Group;
        children->addChild(makePagedTile("grandchildren.osgb"));
        ASSERT_TRUE(osgDB::writeNodeFile(*children, file("children.osgb")));
        _root->addChild(_paged);
    }
    void TearDown() override { fs::remove_all(_folder); }

    [[nodiscard]] std::string file(const std::string& name) const { return (_folder / name).string(); }

    osg::ref_ptr<osg::Node> readChildren() { return osgDB::readRefNodeFile(file("children.osgb"), optionsOf(*_paged)); }

    fs::path _folder;
    osg::ref_ptr<osg::CoordinateSystemNode> _root = new osg::CoordinateSystemNode;
    osg::ref_ptr<osg::PagedLOD> _paged = makePagedTile("children.osgb");
};

TEST_F(Paging, TilesReadLaterGetBinsAndPassThemOn) {
    _root->setEllipsoidModel(new osg::EllipsoidModel(3396190.0, 3376200.0));
    CullOptions exact;
    exact.method = Method::Exact;
    installBins(*_root, exact);
    const osg::ref_ptr<osg::Node> children = readChildren();
    ASSERT_TRUE(children);
    auto* tile = dynamic_cast<osg::PagedLOD*>(children->asGroup()->getChild(0));
    ASSERT_NE(tile, nullptr);
    auto* callback = dynamic_cast<AnalyticBinCullCallback*>(tile->getCullCallback());
    ASSERT_NE(callback, nullptr);
    EXPECT_EQ(callback->getBin(), kPagedBin);
    EXPECT_EQ(callback->getCullOptions().method, Method::Exact);
    EXPECT_EQ(callback->getRadiiText(), "3396190 3376200");
    EXPECT_TRUE(tile->getCullingActive());
    ASSERT_NE(optionsOf(*tile), nullptr);
    EXPECT_NE(optionsOf(*tile)->getReadFileCallback(), nullptr);
}

class CountingReader : public osgDB::ReadFileCallback {
public:
    osgDB::ReaderWriter::ReadResult readNode(const std::string& name, const osgDB::Options* options) override {
        ++count;
        return osgDB::Registry::instance()->readNodeImplementation(name, options);
    }
    int count = 0;
};

TEST_F(Paging, AUsersReadFileCallbackAndOptionsStillWork) {
    const osg::ref_ptr<CountingReader> reader = new CountingReader;
    const osg::ref_ptr<osgDB::Options> users = new osgDB::Options("their own=option");
    users->setReadFileCallback(reader.get());
    _paged->setDatabaseOptions(users.get());
    installBins(*_root);
    installBins(*_root);  // twice must not chain twice
    EXPECT_EQ(optionsOf(*_paged)->getOptionString(), "their own=option");
    EXPECT_EQ(users->getReadFileCallback(), reader.get());  // theirs is not changed
    ASSERT_TRUE(readChildren());
    EXPECT_EQ(reader->count, 1);
}

TEST_F(Paging, TheRegistrysReadFileCallbackStillWorks) {
    const osg::ref_ptr<CountingReader> reader = new CountingReader;
    osgDB::Registry::instance()->setReadFileCallback(reader.get());
    installBins(*_root);
    const osg::ref_ptr<osg::Node> children = readChildren();
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
    ASSERT_TRUE(children);
    EXPECT_EQ(reader->count, 1);
}

// As OSG has it.
TEST_F(Paging, AUsersReadFileCallbackWinsOverTheRegistrys) {
    const osg::ref_ptr<CountingReader> own = new CountingReader;
    const osg::ref_ptr<CountingReader> registrys = new CountingReader;
    const osg::ref_ptr<osgDB::Options> users = new osgDB::Options;
    users->setReadFileCallback(own.get());
    _paged->setDatabaseOptions(users.get());
    osgDB::Registry::instance()->setReadFileCallback(registrys.get());
    installBins(*_root);
    const osg::ref_ptr<osg::Node> children = readChildren();
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
    ASSERT_TRUE(children);
    EXPECT_EQ(own->count, 1);
    EXPECT_EQ(registrys->count, 0);
}

AnalyticBinCullCallback* firstCallback(osg::Node* file) {
    return file ? dynamic_cast<AnalyticBinCullCallback*>(file->asGroup()->getChild(0)->getCullCallback()) : nullptr;
}

TEST_F(Paging, GlobesOfOneSceneKeepTheirEllipsoidsAndOptionsApart) {
    const osg::ref_ptr<CountingReader> reader = new CountingReader;
    const osg::ref_ptr<osgDB::Options> users = new osgDB::Options("shared=by both");
    users->setReadFileCallback(reader.get());
    const osg::ref_ptr<osg::CoordinateSystemNode> mars = new osg::CoordinateSystemNode;
    mars->setEllipsoidModel(new osg::EllipsoidModel(3396190.0, 3376200.0));
    const osg::ref_ptr<osg::PagedLOD> marsTile = makePagedTile("children.osgb");
    mars->addChild(marsTile);
    _paged->setDatabaseOptions(users);
    marsTile->setDatabaseOptions(users);
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(_root);
    scene->addChild(mars);
    installBins(*scene);
    CullOptions exact;
    exact.method = Method::Exact;
    installBins(*mars, exact);

    const osg::ref_ptr<osg::Node> here = readChildren();
    const osg::ref_ptr<osg::Node> there = osgDB::readRefNodeFile(file("children.osgb"), optionsOf(*marsTile));
    ASSERT_NE(firstCallback(here), nullptr);
    ASSERT_NE(firstCallback(there), nullptr);
    EXPECT_NE(firstCallback(here)->getRadiiText(), "3396190 3376200");
    EXPECT_EQ(firstCallback(there)->getRadiiText(), "3396190 3376200");
    EXPECT_EQ(firstCallback(here)->getCullOptions().method, Method::Quadratic);
    EXPECT_EQ(firstCallback(there)->getCullOptions().method, Method::Exact);
    EXPECT_EQ(reader->count, 2);
    EXPECT_EQ(optionsOf(*marsTile)->getOptionString(), "shared=by both");
}

TEST_F(Paging, TilesReadLaterStandInTheFrameOfTheirParent) {
    const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(1, 2, 3));
    const osg::ref_ptr<osg::PagedLOD> tile = makePagedTile("children.osgb");
    moved->addChild(tile);
    _root->addChild(moved);
    // the same file, in two places
    _paged->setDatabasePath(_folder.string());
    tile->setDatabasePath(_folder.string());
    ASSERT_EQ(_paged->getDatabasePath() + _paged->getFileName(1), file("children.osgb"));
    installBins(*_root);
    const osg::ref_ptr<osg::Node> here = readChildren();
    const osg::ref_ptr<osg::Node> there = osgDB::readRefNodeFile(file("children.osgb"), optionsOf(*tile));
    ASSERT_NE(firstCallback(here), nullptr);
    ASSERT_NE(firstCallback(there), nullptr);
    EXPECT_TRUE(firstCallback(here)->getLocalToEcef().isIdentity());
    EXPECT_EQ(firstCallback(there)->getLocalToEcef(), osg::Matrixd::translate(1, 2, 3));
}

TEST_F(Paging, AFileOfAServerIsKnownByItsNameInTheFileCache) {
    const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(1, 2, 3));
    const osg::ref_ptr<osg::PagedLOD> tile = makePagedTile("children.osgb");
    _paged->setDatabasePath("http://server/here");
    tile->setDatabasePath("http://server/there");
    moved->addChild(tile);
    _root->addChild(moved);
    const osg::ref_ptr<osgDB::FileCache> cache = new osgDB::FileCache((_folder / "cache").string());
    const std::string copy = cache->createCacheFileName(tile->getDatabasePath() + "children.osgb");
    fs::create_directories(fs::path(copy).parent_path());
    fs::copy(file("children.osgb"), copy);
    installBins(*_root);
    osgDB::Registry::instance()->setFileCache(cache);
    const osg::ref_ptr<osg::Node> there = osgDB::readRefNodeFile(copy, optionsOf(*tile));
    osgDB::Registry::instance()->setFileCache(nullptr);
    ASSERT_NE(firstCallback(there), nullptr);
    EXPECT_EQ(firstCallback(there)->getLocalToEcef(), osg::Matrixd::translate(1, 2, 3));
}

TEST(PagedFlight, BinsAreInstalledInThePagersThreadAlone) {
    const test::TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(test::writeSyntheticDatabase(folder.path()));
    ASSERT_TRUE(scene);
    const osg::ref_ptr<test::ProbingReader> reader = new test::ProbingReader;
    osgDB::Registry::instance()->setReadFileCallback(reader);
    bool loaded = false;
    {
        test::PagedFlight flight(*scene);  // runs the database's own request, update and cull traversals in this thread
        loaded = flight.load(test::CullView::lookAt({6.7e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 60.0));
    }
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
    ASSERT_TRUE(loaded);
    EXPECT_GT(reader->files.size(), 4u);
    EXPECT_EQ(reader->visits.threads().size(), reader->files.size());
    for (const auto& [file, threads] : reader->visits.threads()) {
        ASSERT_EQ(threads.size(), 1u);
        EXPECT_NE(threads.front(), std::this_thread::get_id());
    }
}

TEST_F(Paging, PagedLodsWithoutOptionsShareOneOptionsObject) {
    const osg::ref_ptr<osg::PagedLOD> other = makePagedTile("other.osgb");
    _root->addChild(other);
    installBins(*_root);
    EXPECT_EQ(_paged->getDatabaseOptions(), other->getDatabaseOptions());
    installBins(*_root);
    EXPECT_EQ(_paged->getDatabaseOptions(), other->getDatabaseOptions());
}

TEST_F(Paging, MissingAndTruncatedFilesAreErrorsAndNothingElse) {
    installBins(*_root);
    std::ifstream whole(file("children.osgb"), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(whole)), std::istreambuf_iterator<char>());
    ASSERT_GT(bytes.size(), 500u);
    EXPECT_FALSE(osgDB::readRefNodeFile(file("absent.osgb"), optionsOf(*_paged)));
    for (std::size_t length = 0; length + 1 < bytes.size(); length += 1 + bytes.size() / 97) {
        // a new name each time: a file that failed is left alone for a while
        const std::string cut = file("cut_" + std::to_string(length) + ".osgb");
        std::ofstream(cut, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(length));
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(cut, optionsOf(*_paged));
        EXPECT_FALSE(node) << "cut after " << length << " of " << bytes.size() << " bytes";
    }
}

TEST_F(Paging, AnExceptionWhileReadingBecomesAnError) {
    class Thrower : public osgDB::ReadFileCallback {
        osgDB::ReaderWriter::ReadResult readNode(const std::string&, const osgDB::Options*) override {
            throw std::bad_alloc();
        }
    };
    const osg::ref_ptr<osgDB::Options> users = new osgDB::Options;
    users->setReadFileCallback(new Thrower);
    _paged->setDatabaseOptions(users.get());
    installBins(*_root);
    EXPECT_FALSE(readChildren());
}

}  // namespace
}  // namespace osgAnalyticBin
