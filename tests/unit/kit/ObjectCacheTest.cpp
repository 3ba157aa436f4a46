// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles that might be shared: by osgDB's object cache (Options::CACHE_NODES), and by read callbacks that keep what they
// have read. A node may then be in a scene already.

#include "CountedReads.h"
#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

const AnalyticBin kCachedBin(core::GeodeticBin::fromDegrees({0, 22.5}, {0, 22.5}, {-100, 5000}));

osg::ref_ptr<osg::PagedLOD> makeCachedTile(const std::string& fileName) {
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->addChild(new osg::Group, 1e6f, 1e10f);
    paged->setFileName(1, fileName);
    paged->setRange(1, 0.0f, 1e6f);
    setStoredBin(*paged, kCachedBin);
    return paged;
}

// The callback of the tile in what was read from "children.osgb", under any number of groups.
AnalyticBinCullCallback* callbackIn(osg::Node* node) {
    while (node && !dynamic_cast<osg::PagedLOD*>(node)) node = node->asGroup()->getChild(0);
    return node ? dynamic_cast<AnalyticBinCullCallback*>(node->getCullCallback()) : nullptr;
}

class ObjectCache : public ::testing::Test {
protected:
    void SetUp() override {
        const osg::ref_ptr<osg::Group> children = new osg::Group;
        children->addChild(makeCachedTile("grandchildren.osgb"));
        ASSERT_TRUE(osgDB::writeNodeFile(*children, _file));
    }
    void TearDown() override { osgDB::Registry::instance()->clearObjectCache(); }

    // Options of a tile below a globe whose read callback is `reader`.
    osg::ref_ptr<osgDB::Options> pagingOptions(osgDB::Options::CacheHintOptions hint,
                                               const osg::EllipsoidModel& ellipsoid = osg::EllipsoidModel(),
                                               const CullOptions& cullOptions = {}) {
        const osg::ref_ptr<osgDB::Options> own = new osgDB::Options;
        own->setObjectCacheHint(hint);
        own->setReadFileCallback(_reader);
        const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
        root->setEllipsoidModel(new osg::EllipsoidModel(ellipsoid));
        const osg::ref_ptr<osg::PagedLOD> tile = makeCachedTile("children.osgb");
        tile->setDatabaseOptions(own);
        root->addChild(tile);
        installBins(*root, cullOptions);
        return dynamic_cast<osgDB::Options*>(tile->getDatabaseOptions());
    }

    TemporaryFolder _folder;
    const std::string _file = _folder / "children.osgb";
    osg::ref_ptr<osgDB::ReadFileCallback> _reader = new CountedReads;
};

// They outlive what belongs to an application.
TEST_F(ObjectCache, NothingOfOursIsInOsgsCaches) {
    const osg::ref_ptr<osgDB::Options> plain = new osgDB::Options;
    plain->setObjectCacheHint(osgDB::Options::CACHE_ALL);
    for (const bool isRead : {false, true}) {
        osgDB::Registry::instance()->clearObjectCache();
        _reader = isRead ? new CountedReads : nullptr;
        osg::ref_ptr<osgDB::Options> options = pagingOptions(osgDB::Options::CACHE_ALL);
        const osg::observer_ptr<osgDB::ReadFileCallback> ours = options->getReadFileCallback();
        osg::ref_ptr<osg::Node> some = osgDB::readRefNodeFile(_file, options);
        osg::ref_ptr<osg::Node> others = osgDB::readRefNodeFile(_file, options);
        ASSERT_TRUE(callbackIn(some) && callbackIn(others));
        EXPECT_NE(callbackIn(some), callbackIn(others));
        EXPECT_FALSE(osgDB::Registry::instance()->getObjectCache()->getRefFromObjectCache(_file, plain));
        options = nullptr;
        some = others = nullptr;
        EXPECT_FALSE(ours.valid()) << isRead;
    }
}

// The Registry is destroyed after an application's statics.
TEST_F(ObjectCache, AProgramMayEndWithBinsInIt) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto end = [this] {
        static osg::ref_ptr<osg::Node> kept;
        static const std::vector<int> applications{1, 2, 3};
        struct Reader : osgDB::ReadFileCallback {
            ~Reader() override {
                if (applications.size() != 3) std::abort();
            }
        };
        const osg::ref_ptr<osgDB::Options> own = new osgDB::Options;
        own->setObjectCacheHint(osgDB::Options::CACHE_ALL);
        own->setReadFileCallback(new Reader);
        const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
        const osg::ref_ptr<osg::PagedLOD> tile = makeCachedTile("children.osgb");
        tile->setDatabaseOptions(own);
        root->addChild(tile);
        installBins(*root);
        kept = osgDB::readRefNodeFile(_file, static_cast<osgDB::Options*>(tile->getDatabaseOptions()));
        tile->addChild(kept);
        kept = root;
        std::exit(callbackIn(tile) ? 0 : 1);
    };
    EXPECT_EXIT(end(), ::testing::ExitedWithCode(0), "");
}

TEST_F(ObjectCache, ThoseWhoReadWithoutBinsShareNothingWithUs) {
    const osg::ref_ptr<osgDB::Options> plain = new osgDB::Options;
    plain->setObjectCacheHint(osgDB::Options::CACHE_ALL);
    const osg::ref_ptr<osg::Node> before = osgDB::readRefNodeFile(_file, plain);
    const osg::ref_ptr<osg::Node> ours = osgDB::readRefNodeFile(_file, pagingOptions(osgDB::Options::CACHE_ALL));
    EXPECT_NE(callbackIn(ours), nullptr);
    EXPECT_EQ(callbackIn(before), nullptr);
    EXPECT_EQ(osgDB::readRefNodeFile(_file, plain), before);
}

TEST_F(ObjectCache, InstallationsShareNothing) {
    CullOptions exact;
    exact.method = Method::Exact;
    const osg::EllipsoidModel wgs84;
    const osg::EllipsoidModel mars(3396190.0, 3376200.0);
    const auto marsOptions = pagingOptions(osgDB::Options::CACHE_ALL, mars);
    const auto earth = osgDB::readRefNodeFile(_file, pagingOptions(osgDB::Options::CACHE_ALL));
    const auto twin = osgDB::readRefNodeFile(_file, pagingOptions(osgDB::Options::CACHE_ALL));
    const auto planet = osgDB::readRefNodeFile(_file, marsOptions);
    const auto other = osgDB::readRefNodeFile(_file, pagingOptions(osgDB::Options::CACHE_ALL, wgs84, exact));
    const auto again = osgDB::readRefNodeFile(_file, marsOptions);
    ASSERT_TRUE(earth && twin && planet && other);
    EXPECT_NE(earth, twin);
    EXPECT_NE(callbackIn(earth)->getRadiiText(), "3396190 3376200");
    EXPECT_EQ(callbackIn(planet)->getRadiiText(), "3396190 3376200");
    EXPECT_EQ(callbackIn(earth)->getCullOptions().method, Method::Quadratic);
    EXPECT_EQ(callbackIn(other)->getCullOptions().method, Method::Exact);
    EXPECT_EQ(callbackIn(again)->getRadiiText(), "3396190 3376200");
}

// Others may draw it.
TEST_F(ObjectCache, ANodeThatAUsersCallbackKeepsGetsNoBins) {
    struct Keeper : osgDB::ReadFileCallback {
        osgDB::ReaderWriter::ReadResult readNode(const std::string&, const osgDB::Options*) override {
            return kept.get();
        }
        osg::ref_ptr<osg::Node> kept;
    };
    const osg::ref_ptr<Keeper> keeper = new Keeper;
    keeper->kept = osgDB::readRefNodeFile(_file);
    _reader = keeper;
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(keeper->kept);
    for (const auto hint : {osgDB::Options::CACHE_NONE, osgDB::Options::CACHE_ALL})
        EXPECT_EQ(osgDB::readRefNodeFile(_file, pagingOptions(hint)), scene->getChild(0));
    EXPECT_EQ(callbackIn(scene->getChild(0)), nullptr);
}

}  // namespace
}  // namespace osgAnalyticBin::test
