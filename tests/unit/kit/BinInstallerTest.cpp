// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the installer does to a scene graph, and what tiles of which heights are declared alone are culled by. Whether
// its tiles are culled rightly: AnalyticBinCullCallbackTest.cpp; what it does to paged files: PagingTest.cpp.

#include "KitTest.h"
#include "PagedFlight.h"

namespace osgAnalyticBin::test {
namespace {

using core::GeodeticBin;

// Deep enough for the chords of a triangle twelve degrees wide.
const AnalyticBin kBin(GeodeticBin::fromDegrees({-22.5, 22.5}, {-22.5, 22.5}, {-60000, 5000}));

// A triangle somewhere near (lat 0, lon 0), in ECEF.
osg::ref_ptr<osg::Geometry> makeTriangle() {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const auto& [latitude, longitude] : {std::pair{0.1, 0.0}, {-0.1, -0.1}, {-0.1, 0.1}})
        vertices->push_back(ecefDeg(osg::RadiansToDegrees(latitude), osg::RadiansToDegrees(longitude), 100.0));
    return makeGeometry(vertices, new osg::DrawArrays(GL_TRIANGLES, 0, 3));
}

struct Database {
    Database() {
        root->addChild(tile);
        tile->addChild(mesh);
        mesh->addChild(drawable);
        root->addChild(sibling);
        setStoredBin(*tile, kBin);
        above->addChild(root);
    }
    osg::ref_ptr<osg::Group> above = new osg::Group;
    osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    osg::ref_ptr<osg::Group> tile = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> mesh = new osg::MatrixTransform;
    osg::ref_ptr<osg::Geometry> drawable = makeTriangle();
    osg::ref_ptr<osg::Group> sibling = new osg::Group;
};

TEST(BinInstaller, TreatsTilesAndLeavesTheirSiblingsAlone) {
    Database db;
    EXPECT_EQ(installBins(*db.above), 1u);
    ASSERT_NE(installedOn(*db.tile), nullptr);
    EXPECT_EQ(installedOn(*db.tile)->getBin(), kBin);
    EXPECT_TRUE(db.tile->isCullingActive());
    EXPECT_TRUE(db.mesh->isCullingActive());
    EXPECT_TRUE(db.drawable->getCullingActive());
    EXPECT_TRUE(db.sibling->getCullingActive());
    EXPECT_EQ(db.sibling->getCullCallback(), nullptr);
    EXPECT_TRUE(db.above->isCullingActive());
}

TEST(BinInstaller, LeavesAGlobeWithoutRightRadiiToOsgAndSaysSoOnce) {
    Database db;
    ASSERT_EQ(installBins(*db.root), 1u);
    db.root->setEllipsoidModel(new osg::EllipsoidModel(std::nan(""), 3376200.0));
    const CapturedNotes notes;
    EXPECT_EQ(installBins(*db.root), 0u);
    EXPECT_EQ(installedOn(*db.tile), nullptr);
    EXPECT_TRUE(db.tile->getCullingActive());
    EXPECT_EQ(db.root->getUpdateCallback(), nullptr);
    EXPECT_EQ(notes.count("radii"), 1u);
    db.root->setEllipsoidModel(new osg::EllipsoidModel);
    EXPECT_EQ(installBins(*db.root), 1u);
}

TEST(BinInstaller, FollowsFixedTransformsBelowTheCoordinateSystem) {
    Database db;
    const osg::Matrixd shift = osg::Matrixd::translate(1, 2, 3), turn = osg::Matrixd::rotate(1.0, 0, 0, 1);
    const auto tile = makeTransform(turn, {});
    setStoredBin(*tile, kBin);
    db.root->addChild(makeTransform(shift, {tile}));
    EXPECT_EQ(installBins(*makeTransform(osg::Matrixd::translate(9, 9, 9), {db.root})), 2u);
    EXPECT_EQ(installedOn(*tile)->getLocalToEcef(), turn * shift);
    EXPECT_TRUE(installedOn(*db.tile)->getLocalToEcef().isIdentity());
}

// A tile's own frame, or that in which a transform that is a tile stands.
TEST(BinInstaller, WithoutACoordinateSystemTilesStandInEcef) {
    const osg::Vec3d origin = ecefDeg(0, 0, 0);
    const auto group = makeGroup({});
    const auto leaf = makeTransform(osg::Matrixd::translate(0, 0, 7), {});
    const auto tile = makeTransform(osg::Matrixd::translate(origin), {leaf});
    for (osg::Node* const node : {group->asNode(), tile->asNode(), leaf->asNode()}) setStoredBin(*node, kBin);
    const auto mover = makeTransform(osg::Matrixd::translate(5, 5, 5), {group, tile});
    mover->setDataVariance(osg::Object::DYNAMIC);
    EXPECT_EQ(installBins(*mover), 3u);
    EXPECT_TRUE(installedOn(*group)->getLocalToEcef().isIdentity());
    EXPECT_EQ(installedOn(*tile)->getLocalToEcef(), osg::Matrixd::translate(origin));
    EXPECT_EQ(installedOn(*leaf)->getLocalToEcef(), osg::Matrixd::translate(origin + osg::Vec3d(0, 0, 7)));
}

TEST(BinInstaller, ABrokenStoredBinLeavesTheTileToItsSphere) {
    Database db;
    db.tile->setUserValue("osgAnalyticBin", std::string("0 0 0 1 1"));
    EXPECT_EQ(installBins(*db.root), 1u);
    EXPECT_FALSE(installedOn(*db.tile)->getBin().valid());
    std::set<std::string> visited;
    installedOn(*db.tile)->setNestedCallback(new VisitRecorder("tile", visited));
    (void)cull(*db.root, CullView::lookAt({-1e7, 0, 0}, {-2e7, 0, 0}, {0, 0, 1}, 10.0));
    EXPECT_EQ(visited.size(), 0u);
    (void)cull(*db.root, CullView::lookAt({1e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 10.0));
    EXPECT_EQ(visited.size(), 1u);
}

TEST(BinInstaller, FindsTheBinOfAPagedLodFromItsGeometryAndDeclaresTheHeightsBelow) {
    Database db;
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeTriangle(), "children.osgb");
    db.root->addChild(paged);
    EXPECT_EQ(installBins(*db.root), 2u);
    const AnalyticBin& bin = installedOn(*paged)->getBin();
    EXPECT_TRUE(bin.contains(AnalyticBin(GeodeticBin({-0.0999, 0.0999}, {-0.0999, 0.0999}, {-11034, 8849}))));
    EXPECT_LT(bin.bin().latitude().upper, 0.101);
    EXPECT_LT(bin.bin().longitude().upper, 0.1005);
}

TEST(BinInstaller, UndeclaredHeightsHoldAllTerrainOnEarthInSmallerUnitsToo) {
    constexpr double kFeet = 1.0 / 0.3048;
    const osg::ref_ptr<osg::MatrixTransform> mesh = makeMeshTile(extentsDeg(10, 12, 20, 22), 100.0);
    mesh->postMult(osg::Matrixd::scale(kFeet, kFeet, kFeet));
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(mesh, "finer.osgb", 1e9f);
    const auto root = makeGlobe({tile}, osg::WGS_84_RADIUS_EQUATOR * kFeet, osg::WGS_84_RADIUS_POLAR * kFeet);
    ASSERT_EQ(installBins(*root), 1u);
    const core::Interval altitude = installedOn(*tile)->getBin().bin().altitude();
    EXPECT_GE(altitude.upper, 8849.0 * kFeet);
    EXPECT_LE(altitude.lower, -10935.0 * kFeet);
}

// In one line each.
TEST(BinInstaller, SaysWhatIsMissingWhereItFindsNoTile) {
    const auto notesOf = [](osg::Node& scene, const char* what) {
        const CapturedNotes notes(osg::NOTICE);
        EXPECT_EQ(installBins(scene), 0u);
        EXPECT_EQ(notes.count("0 tiles got bins"), 1u);
        EXPECT_EQ(notes.count(what), 1u);
        EXPECT_EQ(notes.count(""), 1u);
    };
    const osg::ref_ptr<osg::CoordinateSystemNode> empty = new osg::CoordinateSystemNode;
    notesOf(*empty, "Install bins again when there are some");
    const auto withoutGlobe = makeGroup({makePaged(makeMeshTile(extentsDeg(0, 5, 0, 5), 0.0), "no.osgb")});
    notesOf(*withoutGlobe, "CoordinateSystemNode");
    empty->addChild(withoutGlobe);
    const CapturedNotes notes(osg::NOTICE);
    EXPECT_EQ(installBins(*empty), 1u);
    EXPECT_EQ(notes.count("0 tiles"), 0u);
    EXPECT_EQ(notes.count("\"\""), 0u);
}

TEST(InstallBinsCallback, InstallsAtTheFirstUpdateAndOnlyThenUnlessThereWasAnExplicitInstallation) {
    for (const bool isExplicit : {false, true}) {
        Database db;
        db.root->setUpdateCallback(new InstallBinsCallback);
        if (isExplicit) installBins(*db.above, by(Method::Sphere));
        update(*db.above);
        ASSERT_EQ(installedOn(*db.tile) == nullptr, isExplicit);
        db.tile->setCullCallback(nullptr);
        update(*db.above);
        EXPECT_EQ(db.tile->getCullCallback(), nullptr);
    }
}

// File names that point outside of the database: the kit reads no file before the pager asks for it.
TEST(HostileNames, AreNotReadUntilThePagerAsks) {
    const TemporaryFolder folder;
    const CapturedNotes notes;
    const osg::ref_ptr<CountedReads> reads = new CountedReads;
    osgDB::Registry::instance()->setReadFileCallback(reads);
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    for (const char* name : {"../../outside.osgb", "/etc/passwd", "//etc/passwd", "http://host.invalid/tile.osgb",
                             "ftp://host.invalid/tile.osgb", "tile.osgb.analyticbin", "tile.osgb.90,0,0.rot", "..", ".",
                             "a\\..\\..\\outside.osgb", "%s%n.osgb"})
        root->addChild(makePaged(makeMeshTile(extentsDeg(10, 12, 20, 22), 200.0), name, 1e9f));
    for (const Method method : {Method::Quadratic, Method::None, Method::Exact}) {
        (void)installBins(*root, by(method), folder / "root.osgb");
        update(*root);
        (void)cull(*root, downTo(11.0, 21.0, 1e5, 60.0));
    }
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
    // the index beside the database is looked for, where its reader is there
    for (const auto& [name, count] : reads->counts()) EXPECT_EQ(name, folder / "root.osgb.bins");
    EXPECT_EQ(notes.count(""), 0u);
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
