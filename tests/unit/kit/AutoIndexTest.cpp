// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The index that is made in the background, and what tiles are culled by before there is one.

#include "KitTest.h"

#include <osgDB/ObjectWrapper>

#include <thread>

namespace osgAnalyticBin::test {
namespace {

constexpr double kSeconds = 60.0;

class AutoIndex : public ::testing::Test {
protected:
    AutoIndex() {
        ::setenv("XDG_CACHE_HOME", _cache.path().c_str(), 1);
        write(700.0, 900.0);
    }
    ~AutoIndex() override { ::unsetenv("XDG_CACHE_HOME"); }

    void write(double leafHeight, double singleHeight) {
        _file = writeMeshDatabase(_folder.path(), leafHeight, singleHeight);
    }
    void open() {
        _scene = osgDB::readRefNodeFile(_file);
        ASSERT_TRUE(_scene);
        _root = dynamic_cast<osg::PagedLOD*>(_scene->asGroup()->getChild(0));
        ASSERT_TRUE(_root);
        EXPECT_EQ(installBins(*_scene, {}, _file), 1u);
    }
    [[nodiscard]] bool isRootWhole() const { return highOfRoot() < CullOptions::kTerrainOnEarth.upper; }
    [[nodiscard]] double highOfRoot() const { return installedOn(*_root)->getBin().bin().altitude().upper; }
    // What the kit has written into the cache folder.
    [[nodiscard]] std::vector<std::string> keptFiles() const {
        std::vector<std::string> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(_cache.path()))
            if (entry.is_regular_file()) files.push_back(entry.path().string());
        return files;
    }
    void expectOneWholeIndex() const {
        ASSERT_EQ(keptFiles().size(), 1u);
        std::string error;
        EXPECT_TRUE(BinIndex::read(keptFiles().front(), error)) << error;
    }

    TemporaryFolder _folder, _cache;
    std::string _file;
    osg::ref_ptr<osg::Node> _scene;
    osg::ref_ptr<osg::PagedLOD> _root;
};

TEST_F(AutoIndex, IsMadeInTheBackgroundAndUsedAtOnceTheNextTime) {
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    EXPECT_FALSE(isIndexAwaited(*_scene));
    EXPECT_TRUE(isRootWhole());
    EXPECT_NEAR(highOfRoot(), 900.0, 1.0);  // of a tile that is not loaded
    expectOneWholeIndex();
    std::string error;
    EXPECT_EQ(BinIndex::read(keptFiles().front(), error)->stamps().size(), 3u);
    EXPECT_FALSE(std::filesystem::exists(binIndexName(_file))) << "the database's folder is the user's";

    const CapturedNotes notes;
    open();
    EXPECT_FALSE(isIndexAwaited(*_scene));
    EXPECT_NEAR(highOfRoot(), 900.0, 1.0);
    EXPECT_EQ(notes.count(""), 0u);
}

TEST_F(AutoIndex, LoadedTilesGetItsBinsInUpdateTraversals) {
    open();
    const osg::ref_ptr<osg::Node> children = readBelow(*_root);
    putBelow(*_root, children);
    osg::Node& north = *children->asGroup()->getChild(1);
    const auto frame = [this] {
        (void)cull(*_scene, downTo(30, 20));
        update(*_scene);
    };
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (isIndexAwaited(*_scene) && std::chrono::steady_clock::now() < end) frame();
    for (int i = 0; i < 4; ++i) frame();
    EXPECT_TRUE(isRootWhole());
    EXPECT_NEAR(installedOn(north)->getBin().bin().altitude().upper, 900.0, 1.0);
}

// A file that was read before the index was complete, and comes into the scene after.
TEST_F(AutoIndex, TilesOnTheirWayGetItsBinsWhenTheyArrive) {
    open();
    const osg::ref_ptr<osg::Node> children = readBelow(*_root);
    osg::Node& north = *children->asGroup()->getChild(1);
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    EXPECT_TRUE(isRootWhole());
    putBelow(*_root, children);
    EXPECT_FALSE(installedOn(north)->getBin().bin().altitude().upper < CullOptions::kTerrainOnEarth.upper);
    update(*_scene);
    EXPECT_NEAR(installedOn(north)->getBin().bin().altitude().upper, 900.0, 1.0);
}

// A tile that nobody knows the extent of has no bounds in the index, and those above it have none either.
TEST_F(AutoIndex, TilesAboveOneWithoutBoundsKeepTheDeclaredHeights) {
    const std::string file = _folder.path() + "/children.osgb";
    const osg::ref_ptr<osg::Group> children = osgDB::readRefFile<osg::Group>(file);
    const osg::ref_ptr<osg::AutoTransform> sign = new osg::AutoTransform;
    sign->addChild(new osg::Geometry);
    children->getChild(0)->asGroup()->addChild(sign);
    ASSERT_TRUE(osgDB::writeNodeFile(*children, file));
    for (int i = 0; i < 2; ++i) {
        open();
        ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
        EXPECT_TRUE(installedOn(*_root)->getBin().valid()) << i;
        EXPECT_FALSE(isRootWhole()) << i;
        EXPECT_FALSE(isIndexAwaited(*_scene));
    }
}

// Neither have those above nodes that draw without drawables, beside the tiles of a file.
TEST_F(AutoIndex, TilesAboveLightsKeepTheDeclaredHeights) {
    const std::string file = _folder.path() + "/children.osgb";
    const osg::ref_ptr<osg::Group> children = osgDB::readRefFile<osg::Group>(file);
    osgDB::ObjectWrapper* const kind =
        osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper("osgSim::LightPointNode");
    ASSERT_TRUE(kind);
    const osg::ref_ptr<osg::Node> mast = dynamic_cast<osg::Node*>(kind->createInstance());
    ASSERT_TRUE(mast);
    mast->setInitialBound(osg::BoundingSphere(ecefDeg(40, 20, 5000), 10.0f));
    children->addChild(mast);
    ASSERT_TRUE(osgDB::writeNodeFile(*children, file));
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    EXPECT_FALSE(isRootWhole());
}

// Such files do not say where their tiles stand: all would be read, each time, for nothing.
TEST_F(AutoIndex, IsNotMadeWhereTheOptionsAloneNameTheGlobe) {
    const osg::ref_ptr<osg::Group> scene = osgDB::readRefFile<osg::Group>(_file);
    const std::string file = _folder.path() + "/bare.osgb";
    ASSERT_TRUE(osgDB::writeNodeFile(*makeGroup({scene->getChild(0)}), file));
    _scene = osgDB::readRefNodeFile(file);
    EXPECT_EQ(installBins(*_scene, optionsOf("globe=wgs84"), file), 1u);
    EXPECT_FALSE(isIndexAwaited(*_scene));
}

TEST_F(AutoIndex, SaysWhyItCannotBeMadeThoughNothingElseHappens) {
    const std::string file = _folder.path() + "/children.osgb";
    const osg::ref_ptr<osg::Group> children = osgDB::readRefFile<osg::Group>(file);
    children->addChild(makePaged(makeMeshTile(extentsDeg(10, 30, 0, 40), 200.0), "children.osgb"));
    ASSERT_TRUE(osgDB::writeNodeFile(*children, file));
    const CapturedNotes notes(osg::NOTICE);
    open();
    const auto draw = [this] {
        for (int i = 0; i < 4; ++i) {
            (void)cull(*_scene, downTo(30, 20));
            update(*_scene);
        }
    };
    draw();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (isIndexAwaited(*_scene) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_FALSE(isIndexAwaited(*_scene));
    draw();
    EXPECT_EQ(notes.count("is paged below itself"), 1u);
    EXPECT_FALSE(_scene->getUpdateCallback());
    EXPECT_FALSE(waitForIndex(*_scene, kSeconds));
}

// A user has made that one with osgbinconv, and has not made it again since the database changed.
TEST_F(AutoIndex, IsUsedTheNextTimeWhereOneBesideTheDatabaseIsOutOfDate) {
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    std::filesystem::copy_file(keptFiles().front(), binIndexName(_file));
    write(700.0, 1200.0);
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    EXPECT_NEAR(highOfRoot(), 1200.0, 1.0);
    open();
    EXPECT_FALSE(isIndexAwaited(*_scene));
    EXPECT_NEAR(highOfRoot(), 1200.0, 1.0);
}

TEST_F(AutoIndex, IsMadeWhereSomethingElseHasTheNameOfOneBesideTheDatabase) {
    (void)_folder.write("root.osgb.bins", "of another program");
    const CapturedNotes notes;
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    _scene = nullptr;
    EXPECT_EQ(notes.count("is another kind of file"), 1u);
    expectOneWholeIndex();
    EXPECT_EQ(textOfFile(binIndexName(_file)), "of another program");
    open();
    EXPECT_FALSE(isIndexAwaited(*_scene));
    EXPECT_NEAR(highOfRoot(), 900.0, 1.0);
}

TEST_F(AutoIndex, ABrokenOneGivesOneWarningAndIsMadeAnew) {
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    _scene = nullptr;
    const std::string kept = keptFiles().front();
    std::filesystem::resize_file(kept, std::filesystem::file_size(kept) - 20);
    const CapturedNotes notes;
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    _scene = nullptr;
    EXPECT_EQ(notes.count("index of bins ends too early"), 1u);
    expectOneWholeIndex();
}

TEST_F(AutoIndex, EndsWithItsBinsOrItsSceneAndLeavesNothingHalfWritten) {
    for (const bool isRemoved : {true, false}) {
        for (int i = 0; i < 20; ++i) {
            open();
            if (isRemoved) {
                removeBins(*_scene);
                EXPECT_FALSE(isIndexAwaited(*_scene));
            }
            _scene = nullptr;
            _root = nullptr;
            if (keptFiles().empty()) continue;
            expectOneWholeIndex();
            std::filesystem::remove(keptFiles().front());
        }
    }
}

TEST_F(AutoIndex, IsNotMadeWhereItIsOffOrTilesHaveStoredBins) {
    for (const char* const use : {"index=off", "index=on"}) {
        _scene = osgDB::readRefNodeFile(_file);
        (void)installBins(*_scene, optionsOf(use), _file);
        EXPECT_FALSE(isIndexAwaited(*_scene));
    }
    _scene = osgDB::readRefNodeFile(_file);
    setStoredBin(*_scene->asGroup()->getChild(0), AnalyticBin(extentsDeg(10, 50, 0, 40).withAltitude({-5e4, 900})));
    (void)installBins(*_scene, {}, _file);
    EXPECT_FALSE(isIndexAwaited(*_scene));
}

// The index that is there, or would be made, holds the files alone.
TEST_F(AutoIndex, IsNotUsedWhereTheApplicationReadsFilesItsOwnWay) {
    struct OwnReader : osgDB::ReadFileCallback {};
    open();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    osgDB::Registry& registry = *osgDB::Registry::instance();
    const osg::ref_ptr<osgDB::Options> users = new osgDB::Options;
    users->setReadFileCallback(new OwnReader);
    const auto expectNone = [this](const char* where) {
        _root = dynamic_cast<osg::PagedLOD*>(_scene->asGroup()->getChild(0));
        EXPECT_FALSE(isIndexAwaited(*_scene)) << where;
        EXPECT_FALSE(isRootWhole()) << where;
    };
    registry.setReadFileCallback(users->getReadFileCallback());
    open();
    registry.setReadFileCallback(nullptr);
    expectNone("of the registry");
    registry.setOptions(users);
    open();
    registry.setOptions(nullptr);
    expectNone("in the registry's options");
    _scene = osgDB::readRefNodeFile(_file);
    EXPECT_EQ(installBins(*_scene, {}, _file, users), 1u);
    expectNone("in the options of the read");
    _scene = osgDB::readRefNodeFile(_file);
    dynamic_cast<osg::PagedLOD&>(*_scene->asGroup()->getChild(0)).setDatabaseOptions(users);
    EXPECT_EQ(installBins(*_scene, {}, _file), 1u);
    expectNone("in the options of a tile");
}

TEST_F(AutoIndex, IsMadeWhereACallbackReadsFilesAsOsgDoes) {
    osgDB::Registry::instance()->setReadFileCallback(new osgDB::ReadFileCallback);
    open();
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
    EXPECT_TRUE(waitForIndex(*_scene, kSeconds));
    EXPECT_TRUE(isRootWhole());
}

// Also in a viewer whose time stands still, and in one that draws a single frame.
TEST(DeclaredBins, RequestAllFilesInTheFirstView) {
    struct Globe : MeshGlobe {
        Globe() {
            visitor->setDatabaseRequestHandler(requests);
            // just due, and long overdue
            for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i]->setRange(1, 0.0F, i % 2 ? 1e8F : 8e6F);
        }
        void look() {
            const osg::Vec3d eye = ecefDeg(22.5, 0.0, 3e6);
            (void)cull(*scene, CullView::lookAt(eye, {0, 0, 0}, {0, 0, 1}, 120.0), *visitor, ++frame);
        }
        osg::ref_ptr<Requests> requests = new Requests;
    } stock, globe;
    installBins(*globe.root);
    stock.look();
    globe.look();
    const std::size_t requested = globe.requests->nodes.size();
    EXPECT_GT(requested, 6u);
    for (std::size_t i = 0; i < stock.tiles.size(); ++i)
        EXPECT_LE(globe.requests->nodes.count(globe.tiles[i]), stock.requests->nodes.count(stock.tiles[i])) << i;
    globe.look();
    EXPECT_EQ(globe.requests->nodes.size(), requested) << "none was left for later";
}

// A plain of so many degrees on a globe: its files may hold any terrain on earth.
struct PlainGlobe : MeshGlobe {
    explicit PlainGlobe(double degrees = 0.2) {
        plain = makePaged(makeMeshTile(extentsDeg(10.0, 10.0 + degrees, 10.0, 10.0 + degrees), 0.0), "no.osgb", 1e9F);
        root->addChild(plain);
        visitor->setDatabaseRequestHandler(requests);
    }
    // From the south at this altitude, the lower edge of the picture this many degrees above the plain.
    [[nodiscard]] bool drawsPlain(double altitude, double above) {
        const double distance = 2.0e5;
        const double up = distance * std::tan((above + 5.0) / 57.29578);
        requests->files.clear();
        return draws(*plain, CullView::lookAt(ecefDeg(8.3, 10.1, altitude), ecefDeg(10.1, 10.1, up), {0, 0, 1}, 10.0));
    }

    osg::ref_ptr<osg::PagedLOD> plain;
    osg::ref_ptr<Requests> requests = new Requests;
};

// So no more tiles are drawn and no more files are read than without bins.
TEST(DeclaredBins, TilesAreCulledByOsgsSphereToo) {
    for (const bool isTileByTile : {false, true}) {
        // smaller than the declared heights are high
        PlainGlobe globe(0.02), stock(0.02);
        installBins(*globe.root);
        BinStatistics::of(*globe.visitor).setTileByTile(isTileByTile);
        for (const double above : {-3.0, 1.0, 2.0, 5.0}) {
            const bool isDrawn = globe.drawsPlain(3000.0, above);
            EXPECT_LE(isDrawn, stock.drawsPlain(3000.0, above)) << above;
            EXPECT_EQ(globe.requests->files.count("no.osgb"), stock.requests->files.count("no.osgb")) << above;
            EXPECT_EQ(globe.requests->files.count("no.osgb"), above < 0.0 ? 1u : 0u) << above;
        }
    }
}

TEST(DeclaredBins, FinerTilesBesideTheMeshAboveThemAreDrawn) {
    const TemporaryFolder folder;
    ASSERT_TRUE(osgDB::writeNodeFile(*makeMeshTile(extentsDeg(10.0, 10.2, 10.2, 10.6), 0.0), folder / "east.osgb"));
    for (const bool isLoadedBefore : {true, false}) {
        PlainGlobe globe;
        globe.plain->setFileName(1, folder / "east.osgb");
        if (!isLoadedBefore) installBins(*globe.root);
        const osg::ref_ptr<osg::Node> east = readBelow(*globe.plain);
        ASSERT_TRUE(east);
        putBelow(*globe.plain, east);
        if (isLoadedBefore) installBins(*globe.root);
        const auto drawsEast = [&](double longitude) {
            return globe.draws(*east, CullView::lookAt(ecefDeg(10.1, longitude, 9500.0), ecefDeg(10.1, longitude, 0.0),
                                                       {0, 0, 1}, 20.0));
        };
        EXPECT_TRUE(drawsEast(10.5)) << isLoadedBefore;
        update(*globe.root);
        EXPECT_TRUE(drawsEast(10.5)) << isLoadedBefore;
        EXPECT_FALSE(drawsEast(11.0)) << isLoadedBefore;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
