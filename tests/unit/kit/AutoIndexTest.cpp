// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The index that is made in the background; one beside the database, and tiles that have changed since it was made.

#include "KitTest.h"

#include <osgDB/ObjectWrapper>

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
    // Reads what is below the root, and merges it, as the pager does.
    void read() {
        const osg::ref_ptr<osg::Node> children = readBelow(*_root);
        ASSERT_TRUE(children);
        _children = children->asGroup();
        _north = dynamic_cast<osg::PagedLOD*>(_children->getChild(1));
        ASSERT_TRUE(_north);
    }
    void page() {
        read();
        putBelow(*_root, _children);
    }
    // Has something else in the file below the root.
    void changeChildren(const std::function<void(osg::Group&)>& change) const {
        const std::string file = _folder / "children.osgb";
        const osg::ref_ptr<osg::Group> children = osgDB::readRefFile<osg::Group>(file);
        change(*children);
        ASSERT_TRUE(osgDB::writeNodeFile(*children, file));
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) {
            (void)cull(*_scene, downTo(30, 20));
            update(*_scene);
        }
    }
    [[nodiscard]] bool isRootWhole() const { return highOfRoot() < CullOptions::kTerrainOnEarth.upper; }
    [[nodiscard]] double highOfRoot() const { return highOf(*_root); }
    static double highOf(osg::Node& node) { return installedOn(node)->getBin().bin().altitude().upper; }
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
    osg::ref_ptr<osg::Group> _children;
    osg::ref_ptr<osg::PagedLOD> _root, _north;
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
    page();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (isIndexAwaited(*_scene) && std::chrono::steady_clock::now() < end) frames(1);
    frames(4);
    EXPECT_TRUE(isRootWhole());
    EXPECT_NEAR(highOf(*_north), 900.0, 1.0);
}

// A file that was read before the index was complete, and comes into the scene after.
TEST_F(AutoIndex, TilesOnTheirWayGetItsBinsWhenTheyArrive) {
    open();
    read();
    ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
    EXPECT_TRUE(isRootWhole());
    putBelow(*_root, _children);
    EXPECT_FALSE(highOf(*_north) < CullOptions::kTerrainOnEarth.upper);
    update(*_scene);
    EXPECT_NEAR(highOf(*_north), 900.0, 1.0);
}

// A tile that nobody knows the extent of has no bounds in the index, and those above it have none either. Neither have
// those above nodes that draw without drawables, beside the tiles of a file.
TEST_F(AutoIndex, TilesAboveOneWithoutBoundsOrLightsKeepTheDeclaredHeights) {
    const auto addSign = [](osg::Group& children) {
        const osg::ref_ptr<osg::AutoTransform> sign = new osg::AutoTransform;
        sign->addChild(new osg::Geometry);
        children.getChild(0)->asGroup()->addChild(sign);
    };
    const auto addLights = [](osg::Group& children) {
        osgDB::ObjectWrapper* const kind =
            osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper("osgSim::LightPointNode");
        ASSERT_TRUE(kind);
        const osg::ref_ptr<osg::Node> mast = dynamic_cast<osg::Node*>(kind->createInstance());
        ASSERT_TRUE(mast);
        mast->setInitialBound(osg::BoundingSphere(ecefDeg(40, 20, 5000), 10.0f));
        children.addChild(mast);
    };
    for (const auto& add : {std::function<void(osg::Group&)>(addSign), std::function<void(osg::Group&)>(addLights)}) {
        write(700.0, 900.0);
        changeChildren(add);
        for (int i = 0; i < 2; ++i) {
            open();
            ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
            EXPECT_TRUE(installedOn(*_root)->getBin().valid()) << i;
            EXPECT_FALSE(isRootWhole()) << i;
            EXPECT_FALSE(isIndexAwaited(*_scene));
        }
    }
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
    changeChildren([](osg::Group& children) {
        children.addChild(makePaged(makeMeshTile(extentsDeg(10, 30, 0, 40), 200.0), "children.osgb"));
    });
    const CapturedNotes notes(osg::NOTICE);
    open();
    frames(4);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (isIndexAwaited(*_scene) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_FALSE(isIndexAwaited(*_scene));
    frames(4);
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

// It is another program's file beside the database, or a broken one that was kept.
TEST_F(AutoIndex, OneThatCannotBeReadGivesOneWarningAndIsMadeAnew) {
    for (const bool isBroken : {false, true}) {
        if (isBroken) {
            std::filesystem::remove(binIndexName(_file));
            std::filesystem::resize_file(keptFiles().front(), std::filesystem::file_size(keptFiles().front()) - 20);
        } else {
            (void)_folder.write("root.osgb.bins", "of another program");
        }
        const CapturedNotes notes;
        open();
        ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
        _scene = nullptr;
        EXPECT_EQ(notes.count(isBroken ? "index of bins ends too early" : "is another kind of file"), 1u);
        expectOneWholeIndex();
        EXPECT_EQ(textOfFile(binIndexName(_file)), isBroken ? "" : "of another program");
        open();
        EXPECT_FALSE(isIndexAwaited(*_scene));
        EXPECT_NEAR(highOfRoot(), 900.0, 1.0);
    }
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

const std::string kStaleWarning = "is not as the index knows it";

// A database of 500 m, its index, without the files' times, as osgbinconv makes it; then, maybe, other heights.
class StaleIndex : public AutoIndex {
protected:
    void writeAndOpen(double leafHeight, double singleHeight) {
        write(500.0, 500.0);
        open();
        ASSERT_TRUE(waitForIndex(*_scene, kSeconds));
        const std::string kept = keptFiles().front();
        std::string error;
        const osg::ref_ptr<BinIndex> index = BinIndex::read(kept, error);
        ASSERT_TRUE(index) << error;
        index->setStamps({});
        ASSERT_TRUE(index->write(binIndexName(_file), error)) << error;
        std::filesystem::remove(kept);
        write(leafHeight, singleHeight);
        open();
        EXPECT_FALSE(isIndexAwaited(*_scene));
    }
    void pageSingle() {
        _single = readBelow(*_north);
        ASSERT_TRUE(_single);
        putBelow(*_north, _single);
    }

    osg::ref_ptr<osg::Node> _single;
};

TEST_F(StaleIndex, AnIndexThatFitsTellsTheHeights) {
    const CapturedNotes notes;
    writeAndOpen(500.0, 500.0);
    page();
    pageSingle();
    update(*_scene);
    for (osg::Node* node :
         {static_cast<osg::Node*>(_root), _children->getChild(0), static_cast<osg::Node*>(_north), _single.get()}) {
        EXPECT_NEAR(highOf(*node), 500.0, 1.0);
        EXPECT_GT(installedOn(*node)->getBin().bin().altitude().lower, -13000.0);
    }
    EXPECT_EQ(notes.count(kStaleWarning), 0u);
}

TEST_F(StaleIndex, ATileThatDoesNotFitWarnsOnceAndWidensItsAncestorsAtTheNextUpdate) {
    const CapturedNotes notes;
    writeAndOpen(7000.0, 6000.0);
    EXPECT_NEAR(highOf(*_root), 500.0, 1.0);
    page();
    EXPECT_NEAR(highOf(*_children->getChild(0)), 7000.0, 1.0);
    EXPECT_EQ(notes.count(kStaleWarning), 1u);
    // bins are not to change while another thread culls
    EXPECT_NEAR(highOf(*_root), 500.0, 1.0);
    update(*_scene);
    EXPECT_NEAR(highOf(*_root), 7000.0, 1.0);
    EXPECT_NEAR(highOf(*_north), 500.0, 1.0);
    // which is told once, and not fitted anew in every frame
    const osg::ref_ptr<osg::Callback> fitted = installedOn(*_root);
    update(*_scene);
    update(*_scene);
    EXPECT_EQ(installedOn(*_root), fitted.get());
    pageSingle();
    update(*_scene);
    EXPECT_NEAR(highOf(*_north), 6000.0, 1.0);
    EXPECT_EQ(notes.count(kStaleWarning), 1u);
    for (osg::Node* ancestor : {_root.get(), _north.get()}) {
        EXPECT_LE(installedOn(*ancestor)->getBin().bin().altitude().lower,
                  installedOn(*_single)->getBin().bin().altitude().lower);
    }
}

// By other bins than those of the tiles above.
TEST_F(StaleIndex, ATileThatWasOnItsWayWidensAncestorsThatGotNewBinsMeanwhile) {
    writeAndOpen(500.0, 6000.0);
    page();
    _single = readBelow(*_north);
    installBins(*_scene, {}, _file);
    update(*_scene);
    EXPECT_NEAR(highOf(*_north), 500.0, 1.0);
    putBelow(*_north, _single);
    (void)_scene->getBound();
    update(*_scene);
    EXPECT_GE(highOf(*_north), 5999.0);
    EXPECT_GE(highOf(*_root), 5999.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
