// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the installer does to a scene graph. That the tiles it treats are culled rightly is tested in
// AnalyticBinCullCallbackTest.cpp; what it does to paged files in PagingTest.cpp.

#include "CountedReads.h"

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

TEST(BinInstaller, TakesTheRadiiOfTheCoordinateSystemNode) {
    Database db;
    db.root->setEllipsoidModel(new osg::EllipsoidModel(3396190.0, 3376200.0));
    const double size = 3396190.0 / osg::WGS_84_RADIUS_EQUATOR;
    db.mesh->setMatrix(osg::Matrixd::scale(size, size, size));
    installBins(*db.root);
    EXPECT_EQ(installedOn(*db.tile)->getRadiiText(), "3396190 3376200");
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
    const osg::ref_ptr<osg::MatrixTransform> shift = new osg::MatrixTransform(osg::Matrixd::translate(1, 2, 3));
    const osg::ref_ptr<osg::MatrixTransform> tile = new osg::MatrixTransform(osg::Matrixd::rotate(1.0, 0, 0, 1));
    setStoredBin(*tile, kBin);
    shift->addChild(tile);
    db.root->addChild(shift);
    const osg::ref_ptr<osg::MatrixTransform> globeMover = new osg::MatrixTransform(osg::Matrixd::translate(9, 9, 9));
    globeMover->addChild(db.root);
    EXPECT_EQ(installBins(*globeMover), 2u);
    EXPECT_EQ(installedOn(*tile)->getLocalToEcef(),
              osg::Matrixd::rotate(1.0, 0, 0, 1) * osg::Matrixd::translate(1, 2, 3));
    EXPECT_TRUE(installedOn(*db.tile)->getLocalToEcef().isIdentity());
}

// A tile's own frame, or that in which a transform that is a tile stands.
TEST(BinInstaller, WithoutACoordinateSystemTilesStandInEcef) {
    const osg::Vec3d origin = ecefDeg(0, 0, 0);
    const osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform(osg::Matrixd::translate(5, 5, 5));
    mover->setDataVariance(osg::Object::DYNAMIC);
    const osg::ref_ptr<osg::MatrixTransform> tile = new osg::MatrixTransform(osg::Matrixd::translate(origin));
    const osg::ref_ptr<osg::MatrixTransform> leaf = new osg::MatrixTransform(osg::Matrixd::translate(0, 0, 7));
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    for (osg::Node* const node : {group->asNode(), tile->asNode(), leaf->asNode()}) setStoredBin(*node, kBin);
    mover->addChild(group);
    mover->addChild(tile);
    tile->addChild(leaf);
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
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(
        new osg::EllipsoidModel(osg::WGS_84_RADIUS_EQUATOR * kFeet, osg::WGS_84_RADIUS_POLAR * kFeet));
    const osg::ref_ptr<osg::MatrixTransform> mesh = makeMeshTile(extentsDeg(10, 12, 20, 22), 100.0);
    mesh->postMult(osg::Matrixd::scale(kFeet, kFeet, kFeet));
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(mesh, "finer.osgb", 1e9f);
    root->addChild(tile);
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

TEST(InstallBinsCallback, InstallsAtTheFirstUpdateAndOnlyThen) {
    Database db;
    db.root->setUpdateCallback(new InstallBinsCallback);
    update(*db.above);
    ASSERT_NE(installedOn(*db.tile), nullptr);
    db.tile->setCullCallback(nullptr);
    update(*db.above);
    EXPECT_EQ(db.tile->getCullCallback(), nullptr);
}

TEST(InstallBinsCallback, AnExplicitInstallationWins) {
    Database db;
    db.root->setUpdateCallback(new InstallBinsCallback);
    installBins(*db.above, by(Method::Sphere));
    update(*db.above);
    EXPECT_EQ(db.tile->getCullCallback(), nullptr);
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

}  // namespace
}  // namespace osgAnalyticBin::test
