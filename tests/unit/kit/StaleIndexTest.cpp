// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// An index beside a database: how it is used, and what becomes of tiles that are no longer as it knows them. Its file
// format is tested in BinIndexTest.cpp.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

const std::string kWarning = "is not as the index knows it";

class StaleIndex : public ::testing::Test {
protected:
    // Writes the database and its index; then, maybe, the database anew with other heights.
    void write(double leafHeight, double singleHeight) {
        _file = writeMeshDatabase(_folder.path(), 500.0, 500.0);
        ASSERT_FALSE(_file.empty());
        const osg::ref_ptr<BinIndex> index = new BinIndex;
        AnalyticBin all;
        for (const char* name : {"single.osgb", "children.osgb", ""}) {
            std::vector<BinIndex::Entry> entries = entriesOf(name);
            for (BinIndex::Entry& entry : entries) all.expandBy(entry.bin);
            // a bin of everything holds all descendants
            for (BinIndex::Entry& entry : entries) entry.bin = all;
            index->setTiles(name, std::move(entries));
        }
        index->setSource({"root.osgb", std::filesystem::file_size(_file), 0});
        std::string error;
        ASSERT_TRUE(index->write(binIndexName(_file), error)) << error;
        ASSERT_FALSE(writeMeshDatabase(_folder.path(), leafHeight, singleHeight).empty());
    }

    void load(const CullOptions& options = {}) {
        _scene = osgDB::readRefNodeFile(_file);
        ASSERT_TRUE(_scene);
        _root = dynamic_cast<osg::PagedLOD*>(_scene->asGroup()->getChild(0));
        ASSERT_TRUE(_root);
        EXPECT_EQ(installBins(*_scene, options, _file), 1u);
    }

    // Reads and merges what is below the root, as the pager does.
    void page() {
        const osg::ref_ptr<osg::Node> children = readBelow(*_root);
        ASSERT_TRUE(children);
        putBelow(*_root, children);
        _leaf = children->asGroup()->getChild(0);
        _north = dynamic_cast<osg::PagedLOD*>(children->asGroup()->getChild(1));
        ASSERT_TRUE(_north);
    }

    void pageSingle() {
        _single = readBelow(*_north);
        ASSERT_TRUE(_single);
        putBelow(*_north, _single);
    }

    void update() {
        const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
        _scene->accept(*visitor);
    }

    static double highOf(osg::Node& node) { return installedOn(node)->getBin().bin().altitude().upper; }

    TemporaryFolder _folder;
    std::string _file;
    osg::ref_ptr<osg::Node> _scene, _leaf, _single;
    osg::ref_ptr<osg::PagedLOD> _root, _north;

private:
    std::vector<BinIndex::Entry> entriesOf(const std::string& name) const {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(_folder / (name.empty() ? "root.osgb" : name));
        TileFrame frame;
        frame.ellipsoid = new osg::EllipsoidModel;
        frame.file = name;
        frame.isBelowTile = !name.empty();
        std::vector<BinIndex::Entry> entries;
        for (const FoundTile& tile : findTiles(*node, frame)) {
            osg::Node& mesh = *tile.meshes.front();
            const TileSurface surface = tileSurface(mesh, *tile.frame.ellipsoid, osg::Matrixd());
            entries.push_back(
                {surface.bin, surface.bin.bin().altitude().lower, surfaceFingerprint(mesh, osg::Matrixd())});
        }
        return entries;
    }
};

TEST_F(StaleIndex, AnIndexThatFitsTellsTheHeights) {
    write(500.0, 500.0);
    const CapturedNotes notes;
    load();
    page();
    pageSingle();
    update();
    for (osg::Node* node :
         {static_cast<osg::Node*>(_root), _leaf.get(), static_cast<osg::Node*>(_north), _single.get()}) {
        EXPECT_NEAR(highOf(*node), 500.0, 1.0);
        EXPECT_GT(installedOn(*node)->getBin().bin().altitude().lower, -13000.0);
    }
    EXPECT_EQ(notes.count(kWarning), 0u);
}

TEST_F(StaleIndex, ATileThatDoesNotFitWarnsOnceAndWidensItsAncestorsAtTheNextUpdate) {
    write(7000.0, 6000.0);
    const CapturedNotes notes;
    load();
    EXPECT_NEAR(highOf(*_root), 500.0, 1.0);
    page();
    EXPECT_NEAR(highOf(*_leaf), 7000.0, 1.0);
    EXPECT_EQ(notes.count(kWarning), 1u);
    // bins are not to change while another thread culls
    EXPECT_NEAR(highOf(*_root), 500.0, 1.0);
    update();
    EXPECT_NEAR(highOf(*_root), 7000.0, 1.0);
    EXPECT_NEAR(highOf(*_north), 500.0, 1.0);
    // which is told once, and not fitted anew in every frame
    const osg::ref_ptr<osg::Callback> fitted = installedOn(*_root);
    update();
    update();
    EXPECT_EQ(installedOn(*_root), fitted.get());
    pageSingle();
    update();
    EXPECT_NEAR(highOf(*_north), 6000.0, 1.0);
    EXPECT_EQ(notes.count(kWarning), 1u);
    for (osg::Node* ancestor : {_root.get(), _north.get()}) {
        EXPECT_LE(installedOn(*ancestor)->getBin().bin().altitude().lower,
                  installedOn(*_single)->getBin().bin().altitude().lower);
    }
}

TEST_F(StaleIndex, ATileThatWasOnItsWayWidensAncestorsThatWereFittedAnewMeanwhile) {
    write(500.0, 6000.0);
    const CapturedNotes notes;
    load();
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    terrain->addChild(_root);
    _scene = terrain;
    installBins(*terrain, {}, _file);
    page();
    const osg::ref_ptr<osgDB::Options> options = dynamic_cast<osgDB::Options*>(_north->getDatabaseOptions());
    terrain->setVerticalScale(2.0f);
    update();
    EXPECT_NEAR(highOf(*_north), 500.0, 1.0);
    const std::string file = _north->getDatabasePath() + _north->getFileName(1);
    ASSERT_TRUE(osgDB::readRefNodeFile(file, options));
    update();
    EXPECT_NEAR(highOf(*_north), 6000.0, 1.0);
    EXPECT_NEAR(highOf(*_root), 6000.0, 1.0);
}

// By other bins than those of the tiles above.
TEST_F(StaleIndex, ATileThatWasOnItsWayWidensAncestorsThatGotNewBinsMeanwhile) {
    write(500.0, 6000.0);
    const CapturedNotes notes;
    load();
    page();
    _single = readBelow(*_north);
    installBins(*_scene, {}, _file);
    update();
    EXPECT_NEAR(highOf(*_north), 500.0, 1.0);
    putBelow(*_north, _single);
    (void)_scene->getBound();
    update();
    EXPECT_GE(highOf(*_north), 5999.0);
    EXPECT_GE(highOf(*_root), 5999.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
