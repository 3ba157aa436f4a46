// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles that are read later, as the DatabasePager reads them: through the options of their PagedLOD. How long the pager
// keeps those out of view: its own rule, and CullOptions::expiry; time is simulated. And tiles that might be shared: by
// osgDB's object cache (Options::CACHE_NODES), and by read callbacks that keep what they have read.

#include "KitTest.h"
#include "PagedFlight.h"

#include <osgDB/FileCache>
#include <osgDB/FileNameUtils>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;
const AnalyticBin kPagedBin(core::GeodeticBin::fromDegrees({0, 22.5}, {0, 22.5}, {-100, 5000}));

osg::ref_ptr<osg::PagedLOD> makePagedTile(const std::string& fileName) {
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(300));
    osg::ref_ptr<osg::PagedLOD> paged = makePaged(geometry, fileName);
    setStoredBin(*paged, kPagedBin);
    return paged;
}

osgDB::Options* readOptionsOf(osg::PagedLOD& paged) {
    return dynamic_cast<osgDB::Options*>(paged.getDatabaseOptions());
}

class Paging : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(osgDB::writeNodeFile(*makeGroup({makePagedTile("grandchildren.osgb")}), file("children.osgb")));
        _root->addChild(_paged);
    }
    [[nodiscard]] std::string file(const std::string& name) const { return _folder / name; }

    osg::ref_ptr<osg::Node> readChildren() {
        return osgDB::readRefNodeFile(file("children.osgb"), readOptionsOf(*_paged));
    }
    // A tile below a transform.
    osg::ref_ptr<osg::PagedLOD> addMoved() {
        osg::ref_ptr<osg::PagedLOD> tile = makePagedTile("children.osgb");
        _root->addChild(makeTransform(osg::Matrixd::translate(1, 2, 3), {tile}));
        return tile;
    }

    TemporaryFolder _folder;
    osg::ref_ptr<osg::CoordinateSystemNode> _root = new osg::CoordinateSystemNode;
    osg::ref_ptr<osg::PagedLOD> _paged = makePagedTile("children.osgb");
};

TEST_F(Paging, TilesReadLaterGetBinsAndPassThemOn) {
    _root->setEllipsoidModel(new osg::EllipsoidModel(3396190.0, 3376200.0));
    installBins(*_root, by(Method::Exact));
    const osg::ref_ptr<osg::Node> children = readChildren();
    ASSERT_TRUE(children);
    auto* tile = dynamic_cast<osg::PagedLOD*>(children->asGroup()->getChild(0));
    ASSERT_NE(tile, nullptr);
    const auto* const callback = installedOn(*tile);
    ASSERT_NE(callback, nullptr);
    EXPECT_EQ(callback->getBin(), kPagedBin);
    EXPECT_EQ(callback->getCullOptions().method, Method::Exact);
    EXPECT_EQ(callback->getRadiiText(), "3396190 3376200");
    EXPECT_TRUE(tile->getCullingActive());
    ASSERT_NE(readOptionsOf(*tile), nullptr);
    EXPECT_NE(readOptionsOf(*tile)->getReadFileCallback(), nullptr);
}

// As OSG has it: the options' own comes before the Registry's.
TEST_F(Paging, ReadFileCallbacksAndOptionsOfTheUserStillWork) {
    for (const bool hasOwn : {true, false}) {
        const osg::ref_ptr<CountedReads> own = new CountedReads, registrys = new CountedReads;
        const osg::ref_ptr<osgDB::Options> users = new osgDB::Options("their own=option");
        if (hasOwn) users->setReadFileCallback(own);
        _paged->setDatabaseOptions(users);
        osgDB::Registry::instance()->setReadFileCallback(registrys);
        installBins(*_root);
        installBins(*_root);  // twice must not chain twice
        EXPECT_EQ(readOptionsOf(*_paged)->getOptionString(), "their own=option");
        const osg::ref_ptr<osg::Node> children = readChildren();
        osgDB::Registry::instance()->setReadFileCallback(nullptr);
        ASSERT_TRUE(children);
        EXPECT_EQ(own->total(), hasOwn ? 1 : 0);
        EXPECT_EQ(registrys->total(), hasOwn ? 0 : 1);
        EXPECT_EQ(users->getReadFileCallback(), hasOwn ? own.get() : nullptr) << "theirs is not changed";
        removeBins(*_root);
    }
}

// The callback of the tile in what was read from "children.osgb", under any number of groups.
AnalyticBinCullCallback* callbackIn(osg::Node* node) {
    while (node && !dynamic_cast<osg::PagedLOD*>(node)) node = node->asGroup()->getChild(0);
    return node ? installedOn(*node) : nullptr;
}

TEST_F(Paging, TilesReadLaterStandInTheFrameOfTheirParent) {
    const osg::ref_ptr<osg::PagedLOD> tile = addMoved();
    // the same file, in two places
    _paged->setDatabasePath(_folder.path());
    tile->setDatabasePath(_folder.path());
    ASSERT_EQ(_paged->getDatabasePath() + _paged->getFileName(1), file("children.osgb"));
    installBins(*_root);
    const osg::ref_ptr<osg::Node> here = readChildren(),
                                  there = osgDB::readRefNodeFile(file("children.osgb"), readOptionsOf(*tile));
    ASSERT_TRUE(callbackIn(here) && callbackIn(there));
    EXPECT_TRUE(callbackIn(here)->getLocalToEcef().isIdentity());
    EXPECT_EQ(callbackIn(there)->getLocalToEcef(), osg::Matrixd::translate(1, 2, 3));
}

TEST_F(Paging, AFileOfAServerIsKnownByItsNameInTheFileCache) {
    const osg::ref_ptr<osg::PagedLOD> tile = addMoved();
    _paged->setDatabasePath("http://server/here");
    tile->setDatabasePath("http://server/there");
    const osg::ref_ptr<osgDB::FileCache> cache = new osgDB::FileCache(_folder / "cache");
    const std::string copy = cache->createCacheFileName(tile->getDatabasePath() + "children.osgb");
    fs::create_directories(fs::path(copy).parent_path());
    fs::copy(file("children.osgb"), copy);
    installBins(*_root);
    osgDB::Registry::instance()->setFileCache(cache);
    const osg::ref_ptr<osg::Node> there = osgDB::readRefNodeFile(copy, readOptionsOf(*tile));
    osgDB::Registry::instance()->setFileCache(nullptr);
    ASSERT_NE(callbackIn(there), nullptr);
    EXPECT_EQ(callbackIn(there)->getLocalToEcef(), osg::Matrixd::translate(1, 2, 3));
}

TEST_F(Paging, PagedLodsWithoutOptionsShareOneOptionsObject) {
    const osg::ref_ptr<osg::PagedLOD> other = makePagedTile("other.osgb");
    _root->addChild(other);
    for (int i = 0; i < 2; ++i) {
        installBins(*_root);
        EXPECT_EQ(_paged->getDatabaseOptions(), other->getDatabaseOptions());
    }
}

TEST_F(Paging, MissingAndTruncatedFilesAreErrorsAndNothingElse) {
    installBins(*_root);
    const std::string bytes = textOfFile(file("children.osgb"));
    ASSERT_GT(bytes.size(), 500u);
    EXPECT_FALSE(osgDB::readRefNodeFile(file("absent.osgb"), readOptionsOf(*_paged)));
    for (std::size_t length = 0; length + 1 < bytes.size(); length += 1 + bytes.size() / 97) {
        // a new name each time: a file that failed is left alone for a while
        const std::string cut = _folder.write("cut_" + std::to_string(length) + ".osgb", bytes.substr(0, length));
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(cut, readOptionsOf(*_paged));
        EXPECT_FALSE(node) << "cut after " << length << " of " << bytes.size() << " bytes";
    }
}

// Registered before OSG's own is loaded, or after it. Its files are no native ones, as encrypted files are not.
TEST_F(Paging, AnApplicationsReaderOfNativeNamesIsAsked) {
    class ByName : public osgDB::ReaderWriter {
    public:
        ByName() { supportsExtension("osgb", "known by name alone"); }
        ReadResult readNode(const std::string& name, const osgDB::Options*) const override {
            if (osgDB::getSimpleFileName(name) != "encrypted.osgb") return ReadResult::FILE_NOT_HANDLED;
            return makeGroup({makePagedTile("grandchildren.osgb")}).get();
        }
    };
    osgDB::Registry& registry = *osgDB::Registry::instance();
    // with the head of a native file: for others OSG's reader leaks its options
    (void)_folder.write("encrypted.osgb", textOfFile(file("children.osgb")).substr(0, 8) + std::string(24, '\0'));
    for (const bool isFirst : {false, true}) {
        const osg::ref_ptr<osgDB::ReaderWriter> own = new ByName, osgs = registry.getReaderWriterForExtension("osgb");
        if (isFirst) registry.removeReaderWriter(osgs);
        registry.addReaderWriter(own);
        installBins(*_root);
        EXPECT_TRUE(osgDB::readRefNodeFile(file("encrypted.osgb"), readOptionsOf(*_paged))) << isFirst;
        if (isFirst) registry.addReaderWriter(osgs);
        EXPECT_TRUE(readChildren()) << isFirst;
        registry.removeReaderWriter(own);
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

CullOptions withExpiry(double seconds, Method method = Method::Quadratic) {
    CullOptions options = by(method);
    options.expiry = seconds;
    return options;
}

TEST(PagingExpiry, IsRaisedOnPagedChildrenWhereNobodyHasSetIt) {
    const auto node = makePagedTile("finer.osgb");
    node->setFileName(2, "finest.osgb");
    node->setMinimumExpiryTime(2, 1.0);
    for (const double seconds : {3.0, 8.0, 1.0, 0.5, 0.0}) {
        installBins(*node, withExpiry(seconds));
        EXPECT_EQ(node->getMinimumExpiryTime(0), 0.0);  // not paged
        EXPECT_DOUBLE_EQ(node->getMinimumExpiryTime(1), seconds);
        EXPECT_EQ(node->getMinimumExpiryTime(2), 1.0);
    }
    for (const Method method : {Method::Sphere, Method::None}) {
        installBins(*node);
        EXPECT_DOUBLE_EQ(node->getMinimumExpiryTime(1), 3.0) << "by default";
        installBins(*node, withExpiry(3.0, method));
        EXPECT_EQ(node->getMinimumExpiryTime(1), 0.0) << "OSG's rule";
        EXPECT_EQ(node->getMinimumExpiryTime(2), 1.0);
    }
    for (const double seconds : {7.0, 3.0}) {
        installBins(*node);
        node->setMinimumExpiryTime(1, seconds);
        installBins(*node, withExpiry(3.0, Method::Sphere));
        EXPECT_EQ(node->getMinimumExpiryTime(1), seconds) << "set by the user";
    }
}

// Fewer than the scene has at first, so that the pager drops whatever it may.
constexpr unsigned int kSmallTarget = 10;
constexpr int kFramesOfNearlyTwoSeconds = 118;

TEST(TurningTheHead, AndBackWithinTwoSecondsReadsNothingAgainUnlikeByOsgsOwnRule) {
    const TemporaryFolder folder;
    const std::string file = writeSyntheticDatabase(folder.path());
    ASSERT_FALSE(file.empty());
    for (const CullOptions& options : {CullOptions(), withExpiry(0.0)}) {
        const osg::ref_ptr<CountedReads> reads = new CountedReads;
        osgDB::Registry::instance()->setReadFileCallback(reads);
        const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(file);
        installBins(*scene, options);
        PagedFlight flight(*scene, kSmallTarget);
        ASSERT_TRUE(flight.load(lookDown(+1)));
        const std::size_t files = reads->counts().size();
        ASSERT_GT(files, 2u);
        flight.frames(lookDown(-1), kFramesOfNearlyTwoSeconds);
        EXPECT_GT(reads->counts().size(), files);
        ASSERT_TRUE(flight.load(lookDown(+1)));
        EXPECT_EQ(reads->most() > 1, options.expiry == 0.0);
        osgDB::Registry::instance()->setReadFileCallback(nullptr);
    }
}

// A file that was asked for before the tile above was fitted anew, and is read after. It counts for the tile as it is,
// and has no more tiles fitted anew: that would go on for as long as files are awaited.
TEST(PagedLate, FilesCountForTheTileThatWasFittedAnewMeanwhile) {
    const TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(writeMeshDatabase(folder.path(), 12000.0, 900.0));
    auto& paged = dynamic_cast<osg::PagedLOD&>(*scene->asGroup()->getChild(0));
    installBins(*scene);
    const osg::ref_ptr<osgDB::Options> queued = readOptionsOf(paged);
    const auto before = installedOn(paged)->getInstalledTile();
    setCullOptions(*scene, {});
    const osg::ref_ptr<AnalyticBinCullCallback> fitted = installedOn(paged);
    ASSERT_NE(fitted->getInstalledTile(), before);
    const osg::ref_ptr<osg::Node> children =
        osgDB::readRefNodeFile(paged.getDatabasePath() + paged.getFileName(1), queued);
    ASSERT_TRUE(children);
    update(*scene);
    EXPECT_EQ(installedOn(paged), fitted);
    EXPECT_GE(fitted->getBin().bin().altitude().upper, 11999.0);
}

// With a sphere that does not hold what was loaded there.
TEST(PagedSets, AskForNothingOutOfViewWhenAllIsPagedOut) {
    const osg::ref_ptr<osg::Group> set = new osg::Group;
    markPhotogrammetrySet(*set);
    const osg::ref_ptr<osg::PagedLOD> tile = new osg::PagedLOD;
    tile->setCenter(osg::Vec3());
    tile->setRadius(1.0f);
    tile->setFileName(0, "gone.osgb");
    tile->setRange(0, 0.0f, 1e10f);
    set->addChild(tile);
    EXPECT_EQ(installBins(*set), 1u);
    tile->addChild(makeTower(osg::Vec3d(0.0, 0.0, 300.0)));
    (void)set->getBound();
    EXPECT_FALSE(tile->getCullingActive());
    tile->osg::Group::removeChildren(0, 1);  // as the pager does it
    MeshGlobe camera;
    const osg::ref_ptr<Requests> requests = new Requests;
    camera.visitor->setDatabaseRequestHandler(requests);
    const auto asked = [&](double y) {
        requests->files.clear();
        (void)cull(*set, CullView::lookAt({0, -500, 0}, {0, y, 0}, {0, 0, 1}, 40.0), *camera.visitor);
        return requests->files.size();
    };
    EXPECT_EQ(asked(0.0), 1u);
    EXPECT_EQ(asked(-1000.0), 0u);
}

class ObjectCache : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(osgDB::writeNodeFile(*makeGroup({makePagedTile("grandchildren.osgb")}), _file));
    }
    void TearDown() override { osgDB::Registry::instance()->clearObjectCache(); }

    // Options of a tile below a globe whose read callback is `reader`.
    osg::ref_ptr<osgDB::Options> pagingOptions(osgDB::Options::CacheHintOptions hint) {
        const osg::ref_ptr<osgDB::Options> own = new osgDB::Options;
        own->setObjectCacheHint(hint);
        own->setReadFileCallback(_reader);
        const osg::ref_ptr<osg::PagedLOD> tile = makePagedTile("children.osgb");
        tile->setDatabaseOptions(own);
        installBins(*makeGlobe({tile}));
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
        osg::ref_ptr<osg::Node> some = osgDB::readRefNodeFile(_file, options),
                                others = osgDB::readRefNodeFile(_file, options);
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
        const osg::ref_ptr<osg::PagedLOD> tile = makePagedTile("children.osgb");
        tile->setDatabaseOptions(own);
        const auto root = makeGlobe({tile});
        installBins(*root);
        kept = osgDB::readRefNodeFile(_file, static_cast<osgDB::Options*>(tile->getDatabaseOptions()));
        tile->addChild(kept);
        kept = root;
        std::exit(callbackIn(tile) ? 0 : 1);
    };
    EXPECT_EXIT(end(), ::testing::ExitedWithCode(0), "");
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
    const auto scene = makeGroup({keeper->kept});
    for (const auto hint : {osgDB::Options::CACHE_NONE, osgDB::Options::CACHE_ALL})
        EXPECT_EQ(osgDB::readRefNodeFile(_file, pagingOptions(hint)), scene->getChild(0));
    EXPECT_EQ(callbackIn(scene->getChild(0)), nullptr);
}

}  // namespace
}  // namespace osgAnalyticBin::test
