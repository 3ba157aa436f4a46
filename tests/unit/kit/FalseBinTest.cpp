// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases whose stored bins say less than their tiles hold: found when a tile is loaded, told once, and widened, so
// that a tile is missing for no longer than the frame in which it appears.

#include "KitTest.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

namespace osgAnalyticBin::test {
namespace {

const std::string kWarning = "larger than the bin stored with it or above it";
// What is said of every tile, and holds flat terrain at 200 m with the chords of its triangles.
const core::Interval kClaimed{-40000.0, 300.0};

AnalyticBin claim(core::GeodeticBin extents) {
    return AnalyticBin(extents.withAltitude(kClaimed), 1.0);
}

class FalseBins : public ::testing::Test {
protected:
    // A root tile of 40 degrees; paged below it a leaf in its south, with a mesh, a height and a stored bin, if any.
    void write(const core::GeodeticBin& leafMesh, double leafHeight, const std::string& leafText,
               const std::string& rootText = claim(extentsDeg(10, 50, 0, 40)).toText()) {
        osg::ref_ptr<osg::Group> root = new osg::Group;
        if (_hasGlobe) root = makeGlobe();
        const osg::ref_ptr<osg::PagedLOD> whole = makePaged(makeMeshTile(_whole, 200.0), "leaf.osgb", 1e9f);
        whole->setUserValue("osgAnalyticBin", rootText);
        root->addChild(whole);
        const auto leaf = makeGroup({makeMeshTile(leafMesh, leafHeight)});
        if (!leafText.empty()) leaf->setUserValue("osgAnalyticBin", leafText);
        ASSERT_TRUE(osgDB::writeNodeFile(*root, _folder / "root.osgb"));
        ASSERT_TRUE(osgDB::writeNodeFile(*leaf, _folder / "leaf.osgb"));
        _scene = osgDB::readRefNodeFile(_folder / "root.osgb");
        ASSERT_TRUE(_scene);
        _root = dynamic_cast<osg::PagedLOD*>(_scene->asGroup()->getChild(0));
        ASSERT_EQ(installBins(*_scene), 1u);
        page();
    }
    void page() {
        _leaf = readBelow(*_root);
        ASSERT_TRUE(_leaf);
        putBelow(*_root, _leaf);
    }

    // Pages in something else below the root.
    void pageInstead(const osg::Node& content) {
        ASSERT_TRUE(osgDB::writeNodeFile(content, _folder / "leaf.osgb"));
        pageOut(*_root);
        page();
    }

    void update() { test::update(*_scene); }

    [[nodiscard]] static core::Interval altitudeOf(osg::Node& node) {
        return installedOn(node)->getBin().bin().altitude();
    }

    const core::GeodeticBin _whole = extentsDeg(10, 50, 0, 40), _south = extentsDeg(10, 30, 0, 40);
    bool _hasGlobe = true;
    const TemporaryFolder _folder;
    const CapturedNotes _notes;
    osg::ref_ptr<osg::Node> _scene, _leaf;
    osg::ref_ptr<osg::PagedLOD> _root;
};

TEST_F(FalseBins, ThatAreTrueAreLeftAsTheyAreAlsoAboveTilesThatHaveNone) {
    for (const std::string& text : {claim(_south).toText(), std::string()}) {
        write(_south, 200.0, text);
        update();
        EXPECT_EQ(installedOn(*_root)->getBin(), claim(_whole)) << text;
        EXPECT_TRUE(text.empty() || installedOn(*_leaf)->getBin() == claim(_south));
    }
    EXPECT_EQ(_notes.count(""), 0u);
}

// The mesh sags by kilometres: how far it does says nothing of how high it is.
TEST_F(FalseBins, AreWidenedByLeavesWhateverTheseClaim) {
    const std::pair<double, std::string> leaves[] = {{800.0, claim(_south).toText()},
                                                     {7000.0, "nan nan nan nan nan nan nan"},
                                                     {7000.0, ""},
                                                     {7000.0, "10 0 -40000 30 40 7100 1e30 0"},
                                                     {7000.0, "10 0 -40000 30 40 7100 0 1e30"}};
    for (const auto& [height, text] : leaves) {
        write(_south, height, text);
        update();
        EXPECT_GE(altitudeOf(*_root).upper, height - 1.0) << text;
    }
}

TEST_F(FalseBins, ThatAreTooLowAreWidenedOnceWithTheTilesAbove) {
    write(_south, 7000.0, claim(_south).toText());
    EXPECT_GE(altitudeOf(*_leaf).upper, 7000.0 - 1.0);
    update();
    EXPECT_GE(altitudeOf(*_root).upper, 7000.0 - 1.0);
    const osg::ref_ptr<osg::Callback> fitted = installedOn(*_root);
    update();
    update();
    EXPECT_EQ(installedOn(*_root), fitted.get());
    // paged out and in again, and installed anew
    pageOut(*_root);
    page();
    update();
    EXPECT_GE(altitudeOf(*_leaf).upper, 7000.0 - 1.0);
    EXPECT_EQ(_notes.count(kWarning), 1u);
}

TEST_F(FalseBins, WithoutAGlobeAboveThemAreWidenedToo) {
    _hasGlobe = false;
    write(_south, 7000.0, claim(_south).toText());
    EXPECT_LT(altitudeOf(*_root).upper, 301.0);
    update();
    EXPECT_GE(altitudeOf(*_root).upper, 7000.0 - 1.0);
    ASSERT_EQ(installBins(*_scene), 2u);
    EXPECT_NE(_scene->getUpdateCallback(), nullptr);
    EXPECT_EQ(_scene->getUpdateCallback()->getNestedCallback(), nullptr) << "one for each installation";
}

TEST(StoredSurface, IsBelievedWhereTheMeshAllowsIt) {
    const core::GeodeticBin extents = extentsDeg(10, 11, 20, 21);
    const auto surfaceLowWith = [&](double stored) {
        const auto tile = makeGroup({makeMeshTile(extents, 200.0)});
        const auto root = makeGlobe({tile});
        setStoredBin(*tile, claim(extents));
        setStoredSurfaceLow(*tile, stored);
        EXPECT_EQ(installBins(*root), 1u);
        return installedOn(*tile)->getSurfaceLow();
    };
    EXPECT_NEAR(surfaceLowWith(-5000.0), -5000.0, 2.0);
    // an eye that saw no deeper than this would be hidden what is seen past the tile
    EXPECT_LT(surfaceLowWith(900.0), 200.0);
}

TEST_F(FalseBins, ThatAreTooNarrowAreWidened) {
    write(extentsDeg(0, 30, -30, 70), 200.0, claim(_south).toText());
    update();
    for (osg::Node* node : {_leaf.get(), static_cast<osg::Node*>(_root)}) {
        const core::GeodeticBin& bin = installedOn(*node)->getBin().bin();
        for (const double longitude : {-0.52, 1.22}) EXPECT_TRUE(bin.contains(core::Geodetic{0.001, longitude, 200.0}));
    }
    EXPECT_EQ(_notes.count(kWarning), 1u);
}

TEST_F(FalseBins, OfATileThatOwnsUpToMoreThanItsParentWidenTheParent) {
    AnalyticBin honest = claim(_south);
    honest.setBin(honest.bin().withAltitude({kClaimed.lower, 8000.0}));
    write(_south, 7000.0, honest.toText());
    EXPECT_EQ(installedOn(*_leaf)->getBin(), honest);
    update();
    EXPECT_EQ(altitudeOf(*_root).upper, 8000.0);
    EXPECT_EQ(_notes.count(kWarning), 1u);
}

TEST_F(FalseBins, LeaveATileAboveVisibleWhoseOwnBinIsNotKnown) {
    write(_south, 7000.0, claim(_south).toText(), "1e999 0 0 50 40 300 1");
    ASSERT_FALSE(installedOn(*_root)->getBin().valid());
    update();
    update();
    EXPECT_FALSE(installedOn(*_root)->getBin().valid());
    EXPECT_GE(altitudeOf(*_leaf).upper, 7000.0 - 1.0);
}

TEST_F(FalseBins, AreWidenedByWhatIsPagedBelowANodeWithoutABin) {
    for (const bool hasGlobe : {true, false}) {
        _hasGlobe = hasGlobe;
        write(_south, 200.0, "");
        ASSERT_TRUE(osgDB::writeNodeFile(*makeMeshTile(_south, 7000.0), _folder / "deep.osgb"));
        pageInstead(*makePaged(new osg::Group, "deep.osgb", 1e9f));
        auto* const between = dynamic_cast<osg::PagedLOD*>(_leaf.get());
        ASSERT_TRUE(between);
        EXPECT_FALSE(installedOn(*between));
        putBelow(*between, readBelow(*between));
        update();
        EXPECT_GE(altitudeOf(*_root).upper, 7000.0 - 1.0);
    }
}

// Nobody can tell whether such tiles fit into what is stored above.
TEST_F(FalseBins, AboveAGlobeThatStandsElsewhereAreKeptVisible) {
    const osg::ref_ptr<osg::Node> mesh = makeMeshTile(extentsDeg(12, 28, 5, 35), 200.0);
    const auto earth = makeGlobe({mesh}), map = makeGlobe({mesh});
    map->setCoordinateSystem("PROJCS[\"map\"]");
    const auto turned = makeTransform(osg::Matrixd::rotate(1.0, 0, 0, 1), {earth});
    const auto readBelowRoot = [&](osg::Node& content) {
        write(_south, 200.0, "");
        pageInstead(content);
        update();
    };
    readBelowRoot(*earth);
    EXPECT_EQ(installedOn(*_root)->getBin(), claim(_whole)) << "the same globe";
    EXPECT_EQ(_notes.count(""), 0u);
    const std::vector<osg::ref_ptr<osg::Node>> others{turned, makeGlobe({mesh}, 2e7, 2e7),
                                                      makeGlobe({mesh}, std::nan(""), 1.0), map};
    for (std::size_t i = 0; i < others.size(); ++i) {
        readBelowRoot(*others[i]);
        EXPECT_FALSE(installedOn(*_root)->getBin().valid()) << i;
        EXPECT_EQ(_notes.count("cannot be compared"), i + 1) << "once for each installation";
    }
}

// Above terrain that reaches that high no surface is known.
TEST_F(FalseBins, OfTilesWhoseMeshCannotBeToldAreNotUsed) {
    for (const std::string& text : {claim(_south).toText(), std::string(), std::string("nan nan nan nan nan nan")}) {
        write(_south, 60000.0, text);
        const AnalyticBinCullCallback* const own = installedOn(*_leaf);
        EXPECT_TRUE(!own || !own->getBin().valid()) << text;
        update();
        EXPECT_FALSE(installedOn(*_root)->getBin().valid()) << text;
        // paged in again, and installed anew
        pageOut(*_root);
        page();
        update();
        EXPECT_FALSE(installedOn(*_root)->getBin().valid()) << text;
        EXPECT_EQ(setCullOptions(*_scene, {}), 1u) << text;
        EXPECT_FALSE(installedOn(*_root)->getBin().valid()) << text;
    }
    EXPECT_EQ(_notes.count("cannot be compared"), 3u);
}

TEST_F(FalseBins, HideNoPeakFromTheFrameOnInWhichItAppears) {
    write(_south, 40000.0, claim(_south).toText());
    std::set<std::string> reached;
    installedOn(*_leaf)->setNestedCallback(new VisitRecorder("leaf", reached));
    // level, from the height of the peak, through an angle that ends above what is claimed
    const osg::Vec3d summit = ecefDeg(20, 20, 39990), eye = ecefDeg(20, 18, 42000);
    const CullView view = CullView::lookAt(eye, summit, eye, 0.1);
    for (int i = 0; i < 2; ++i) {
        (void)cull(*_scene, view);
        EXPECT_EQ(reached.count("leaf"), 1u) << i;
        update();
        reached.clear();
    }
}

// On a globe in another unit a tile is as much too large as on earth.
TEST(FalseBinsOfOtherGlobes, AreFoundWhateverTheirUnit) {
    for (const double metre : {1.0, 1e-3, 1.0 / 6.4e6}) {
        const CapturedNotes notes;
        const core::GeodeticBin extents = extentsDeg(10, 12, 20, 22);
        const osg::ref_ptr<osg::MatrixTransform> tile = makeMeshTile(extents, 7000.0);
        tile->postMult(osg::Matrixd::scale(metre, metre, metre));
        const auto stored = makeGroup({tile});
        setStoredBin(*stored, AnalyticBin(extents.withAltitude({-4000.0 * metre, 300.0 * metre})));
        const auto root = makeGlobe({stored}, osg::WGS_84_RADIUS_EQUATOR * metre, osg::WGS_84_RADIUS_POLAR * metre);
        EXPECT_EQ(installBins(*root), 1u);
        EXPECT_GE(installedOn(*stored)->getBin().bin().altitude().upper, 6999.0 * metre) << metre;
        EXPECT_EQ(notes.count(kWarning), 1u) << metre;
    }
}

// Coarse meshes beside a pole, whose stored bins are right: the bound of such a mesh that the check has is rough in
// latitude, which is no reason to call the bin too small. Oracle: core::GeodeticMeshBounds.

constexpr unsigned int kCoarsePosts = 3;
constexpr double kMarginAngle = 0.01 / 6.4e6;  // metres, as an angle

struct CoarseTile {
    osg::ref_ptr<osg::Group> node;
    core::GeodeticBin bin;
};

CoarseTile makeCoarseTile(const core::GeodeticBin& extents) {
    const osg::ref_ptr<osg::Node> mesh = makeMeshTile(extents, 0.0, kCoarsePosts);
    core::GeodeticMeshBounds bounds(core::Ellipsoid(6378137.0, 6356752.314245), extents.center().longitude);
    for (const EcefTriangle& triangle : drawnTriangles(*mesh).surface) {
        for (const glm::dvec3& corner : triangle) bounds.expandByVertex(corner);
        bounds.expandByTriangle(triangle[0], triangle[1], triangle[2]);
    }
    return {makeGroup({mesh}), bounds.bin()};
}

// A square of so many degrees; its nearer edge so many rows of such tiles from the pole.
core::GeodeticBin besidePole(bool isNorth, double width, int rows) {
    const double near = 90.0 - width * rows;
    return isNorth ? extentsDeg(near - width, near, 10.0, 10.0 + width)
                   : extentsDeg(-near, -near + width, 10.0, 10.0 + width);
}

// What is culled by after the bin has been stored and compared with the mesh.
AnalyticBin installedWith(const CoarseTile& tile, const AnalyticBin& stored) {
    const auto root = makeGlobe({tile.node});
    setStoredBin(*tile.node, stored);
    EXPECT_EQ(installBins(*root), 1U);
    return installedOn(*tile.node)->getBin();
}

TEST(StoredBinNearPole, IsNoFalseAlarmWhereItIsRightAndWidenedWhereItEndsTooEarly) {
    for (const bool isNorth : {false, true}) {
        for (const double width : {11.25, 5.625, 2.8125, 1.40625, 0.3515625}) {
            for (const int rows : {1, 2, 3}) {
                const CoarseTile tile = makeCoarseTile(besidePole(isNorth, width, rows));
                const AnalyticBin right = AnalyticBin::fromText(AnalyticBin(tile.bin, 0.01).toText());
                const CapturedNotes none;
                EXPECT_EQ(installedWith(tile, right), right) << isNorth << ' ' << width << ' ' << rows;
                EXPECT_EQ(none.count(kWarning), 0U);
                const core::Interval& latitude = tile.bin.latitude();
                const double quarter = 0.25 * latitude.width();
                for (const core::Interval& range : {core::Interval{latitude.lower + quarter, latitude.upper},
                                                    core::Interval{latitude.lower, latitude.upper - quarter}}) {
                    const CapturedNotes notes;
                    const AnalyticBin stored(core::GeodeticBin(range, tile.bin.longitude(), tile.bin.altitude()), 0.01);
                    const core::Interval widened = installedWith(tile, stored).bin().latitude();
                    EXPECT_LE(widened.lower - latitude.lower, kMarginAngle) << isNorth << ' ' << width;
                    EXPECT_LE(latitude.upper - widened.upper, kMarginAngle) << isNorth << ' ' << width;
                    EXPECT_EQ(notes.count(kWarning), 1U) << isNorth << ' ' << width << ' ' << rows;
                }
            }
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
