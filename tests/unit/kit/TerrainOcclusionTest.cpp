// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles behind a ridge, and osgTerrain tiles that hide others. tests/scenes/ridge-*.scene and terrain-*.scene test
// which tiles hide others, and what stops them from it. Pictures and random scenes: tests/long/scenes. What the core
// proves: HorizonBufferTest.cpp.

#include "../../../osgAnalyticBin/src/occlusion/LevelPicture.h"
#include "../../../osgAnalyticBin/src/occlusion/NearMeshes.h"
#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// Bins of the row reach up to 9000 m, for finer tiles; the mesh behind the ridge is at 0 m.
TEST(TerrainOcclusion, HidesAMeshByItsOwnHeightWhereNoFinerTileIsDue) {
    InstalledRidge globe(3500.0);
    osg::PagedLOD& far = *globe.row[4];
    const float never = 0.0f, always = 1e9f;
    // what comes into view is looked for behind terrain from the next view on
    const auto drawsFarTileNow = [&globe] {
        (void)globe.drawsFarTile();
        return globe.drawsFarTile();
    };
    for (int i = 0; i < 3; ++i) {
        setFinerWithin(far, never);
        EXPECT_FALSE(drawsFarTileNow()) << i;
        // as OSG leaves the levels of what it culls
        EXPECT_NE(far.getFrameNumber(0), globe.frame);
        setFinerWithin(far, always);
        EXPECT_TRUE(globe.drawsFarTile()) << i;
    }
    // both may be drawn
    setFinerWithin(far, never);
    far.setRange(1, 0.0f, 1e10f);
    EXPECT_TRUE(globe.drawsFarTile());
    far.setRange(1, 0.0f, never);
    EXPECT_FALSE(drawsFarTileNow());
    // where OSG chooses by pixels the kit does not know what it will choose
    far.setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
    EXPECT_TRUE(globe.drawsFarTile());
    far.setRangeMode(osg::LOD::DISTANCE_FROM_EYE_POINT);
    EXPECT_FALSE(drawsFarTileNow());
    globe.visitor->setTraversalMode(osg::NodeVisitor::TRAVERSE_ALL_CHILDREN);
    EXPECT_TRUE(globe.drawsFarTile());
}

// A peak in the middle of one of 4 x 4 parts of the mesh behind the ridge.
TEST(TerrainOcclusion, HidesAMeshByTheHeightOfEachPart) {
    for (unsigned int part = 0; part < 16; ++part) {
        for (const double height : {300.0, 9000.0}) {
            RidgeGlobe globe(3500.0);
            constexpr unsigned int kPostsASide = 33;
            const osg::ref_ptr<osg::MatrixTransform> mesh =
                makeMeshTile(extentsDeg(0.0, 0.2, 0.8, 1.0), 0.0, kPostsASide);
            auto& geometry = static_cast<osg::Geometry&>(*mesh->getChild(0)->asGroup()->getChild(0));
            auto& vertices = static_cast<osg::Vec3Array&>(*geometry.getVertexArray());
            osg::Vec3& peak = vertices[(8 * (part / 4) + 4) * kPostsASide + 8 * (part % 4) + 4];
            osg::Vec3d up = osg::Vec3d(peak) * mesh->getMatrix();
            up.normalize();
            peak += up * height;
            vertices.dirty();
            geometry.dirtyBound();
            osg::PagedLOD& far = *globe.row[4];
            far.setChild(0, mesh);
            far.setRange(0, 0.0f, 1e10f);
            far.setRange(1, 0.0f, 0.0f);
            installBins(*globe.root, optionsOf("occlusion=on"));
            EXPECT_EQ(globe.drawsFarTile(), height > 3500.0) << "part " << part;
        }
    }
}

// A tower on a leaf whose mesh alone would be hidden.
TEST(TerrainOcclusion, HidesNoMeshByItsOwnHeightWhereMoreIsAdded) {
    RidgeGlobe globe(3500.0);
    const auto extents = extentsDeg(0, 0.2, 0.8, 1.0);
    const osg::ref_ptr<osg::MatrixTransform> leaf = makeMeshTile(extents, 0.0);
    setStoredBin(*leaf, AnalyticBin(extents.withAltitude({-12000.0, 9000.0}), 10.0));
    globe.root->replaceChild(globe.row[4], leaf);
    installBins(*globe.root, optionsOf("occlusion=on"));
    EXPECT_FALSE(globe.draws(*leaf, RidgeGlobe::alongRow()));
    const osg::ref_ptr<osg::MatrixTransform> tower = makeTower(ecefDeg(0.1, 0.9, 0.0), 8500.0f);
    tower->setMatrix(tower->getMatrix() * osg::Matrixd::inverse(leaf->getMatrix()));
    leaf->addChild(tower);
    globe.expectDrawn(*tower, RidgeGlobe::alongRow(), true, 2);
    EXPECT_GE(globe.counts().occluded, 1u) << "other tiles";
}

TEST(TerrainOcclusion, TellsWhatOfThePictureIsCovered) {
    InstalledRidge globe;
    BinStatistics& statistics = BinStatistics::of(*globe.visitor);
    EXPECT_FALSE(statistics.covered());
    EXPECT_FALSE(globe.drawsFarTile());
    ASSERT_TRUE(statistics.covered());
    const CoveredPicture picture = *statistics.covered();
    const auto isCovered = [&](const osg::Vec3d& place) {
        const glm::dvec3 from = glm::dvec3(place.x(), place.y(), place.z()) - picture.eye.origin;
        const double forward = glm::dot(from, picture.eye.y), x = glm::dot(from, picture.eye.x) / forward;
        const double share = (x - picture.across.lower) / picture.across.width();
        const auto strip = static_cast<std::size_t>(share * static_cast<double>(picture.heights.size()));
        return picture.heights.at(strip).contains(glm::dot(from, picture.eye.z) / forward);
    };
    EXPECT_TRUE(isCovered(ecefDeg(0.1, 0.9, 0.0)));       // in the tile behind the ridge
    EXPECT_FALSE(isCovered(ecefDeg(0.1, 0.9, 20000.0)));  // above it
    // a camera that looks down has no horizon in front of it
    (void)globe.draws(*globe.row[0], CullView::lookAt(ecefDeg(0.1, 0.1, 1000.0), osg::Vec3d(), {0, 0, 1}, 1.0));
    EXPECT_FALSE(statistics.covered());
}

// More ways: tests/scenes/ridge-*.scene.
TEST(TerrainOcclusion, NeedsARidgeThatIsDrawnAsItWas) {
    InstalledRidge globe;
    EXPECT_FALSE(globe.drawsFarTile());
    osg::PagedLOD& ridge = *globe.row[2];
    ridge.setFileName(1, "");
    ridge.setRange(0, 1e9f, 1e10f);
    ridge.addChild(makeMeshTile(extentsDeg(0, 0.2, 0.4, 0.6), 0.0), 0.0f, 1e9f);
    EXPECT_TRUE(globe.drawsFarTile());
    update(*globe.root);
    EXPECT_TRUE(globe.drawsFarTile());
}

TEST(TerrainOcclusion, RestsWhereItDoesNotPayIfLeftToItself) {
    RidgeGlobe globe;
    installBins(*globe.root, optionsOf("occlusion=auto"));
    // plates are made in the updates after a view that could use them
    int awaited = 0;
    for (; awaited < 20 && globe.drawsFarTile(); ++awaited) update(*globe.root);
    EXPECT_GE(awaited, 1);
    EXPECT_LT(awaited, 20);
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(globe.drawsFarTile()) << i;
    const CullView high = CullView::lookAt(ecefDeg(0.1, 0.1, 40000.0), ecefDeg(0.1, 0.9, 0.0), {1, 0, 0}, 30.0);
    for (int i = 0; i < 600; ++i) EXPECT_TRUE(globe.drawsFarTile(high)) << i;
    // tried again after 256 views
    int rested = 0;
    while (rested < 300 && globe.drawsFarTile()) ++rested;
    EXPECT_GE(rested, 9);
    EXPECT_LE(rested, 256);
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(globe.drawsFarTile()) << i;
}

// Nor are tiles prepared for it, which takes as long as reading them.
TEST(TerrainOcclusion, IsNotLookedForFromHighAboveIfLeftToItself) {
    RidgeGlobe globe;
    installBins(*globe.root, optionsOf("occlusion=auto"));
    const CullView high = CullView::lookAt(ecefDeg(0.1, 0.1, 5e6), ecefDeg(0.1, 50.0, 0.0), {1, 0, 0}, 30.0);
    (void)globe.drawsFarTile(high);
    EXPECT_STREQ(BinStatistics::of(*globe.visitor).notCovered(), "an eye that is not high above the terrain");
    for (int i = 0; i < 300; ++i) {
        (void)globe.drawsFarTile(high);
        update(*globe.root);
    }
    for (int i = 0; i < 300; ++i) EXPECT_TRUE(globe.drawsFarTile()) << i;
    int awaited = 0;
    for (; awaited < 300 && globe.drawsFarTile(); ++awaited) update(*globe.root);
    EXPECT_LT(awaited, 300);
}

// Other distances, and depth buffers: tests/scenes/ridge-near-planes.scene, ridge-coarse-depths.scene.
TEST(TerrainOcclusion, NeedsAnEyeThatSeesTheGroundInFront) {
    InstalledRidge globe;
    EXPECT_FALSE(globe.drawsFarTile());
    // through a plain that is cut away, the eye sees past the foot of the ridge into a pit
    RidgeGlobe pit;
    pit.row[4]->replaceChild(pit.row[4]->getChild(0), makeMeshTile(extentsDeg(0, 0.2, 0.8, 1.0), -15000.0));
    installBins(*pit.root, optionsOf("occlusion=on"));
    CullView cutting = RidgeGlobe::alongRow();
    cutting.projection = osg::Matrixd::perspective(30.0, 1.0, 500.0, 1e8);
    EXPECT_FALSE(pit.drawsFarTile(cutting));
    cutting.projection = osg::Matrixd::perspective(30.0, 1.0, 6000.0, 1e8);
    EXPECT_TRUE(pit.drawsFarTile(cutting));
    // an oblique near plane that is this far away on the left side only; the view reaches farther right; depths from 0
    const auto cutOnTheLeft = [&cutting](double distance) {
        cutting.projection = osg::Matrixd::frustum(-0.15, 1.0, -0.2, 0.2, 1.0, 1e8);
        const osg::Vec4d plane(3.0, 0.0, -1.0, -0.55 * distance);
        for (int row = 0; row < 4; ++row) cutting.projection(row, 2) = 0.25 * plane[static_cast<unsigned int>(row)];
    };
    cutOnTheLeft(500.0);
    EXPECT_FALSE(pit.drawsFarTile(cutting));
    cutOnTheLeft(6000.0);
    EXPECT_TRUE(pit.drawsFarTile(cutting));
    // a scene in kilometres, and depths from 0 to 1
    osg::ref_ptr<osg::MatrixTransform> scaled = new osg::MatrixTransform(osg::Matrixd::scale(1e-3, 1e-3, 1e-3));
    scaled->addChild(globe.root);
    globe.scene = scaled;
    CullView inKilometres = RidgeGlobe::alongRow();
    inKilometres.modelView =
        osg::Matrixd::scale(1e3, 1e3, 1e3) * inKilometres.modelView * osg::Matrixd::scale(1e-3, 1e-3, 1e-3);
    inKilometres.projection = osg::Matrixd::perspective(30.0, 1.0, 1e-3, 1e5);
    EXPECT_FALSE(globe.drawsFarTile(inKilometres));
    inKilometres.projection = osg::Matrixd::perspective(30.0, 1.0, 60.0, 1e5);
    EXPECT_TRUE(globe.drawsFarTile(inKilometres));
    globe.scene = globe.root;
    CullView zeroToOne = RidgeGlobe::alongRow();
    zeroToOne.projection = osg::Matrixd::perspective(30.0, 1.0, 60000.0, 1e8) * osg::Matrixd::scale(1, 1, 0.5) *
                           osg::Matrixd::translate(0, 0, 0.5);
    EXPECT_TRUE(globe.drawsFarTile(zeroToOne));
    EXPECT_FALSE(globe.drawsFarTile());
}

// Pixels may be higher than they are wide: the corners of triangles are snapped to shares of both.
TEST(TerrainOcclusion, LeavesRoomForPixelsThatAreNotSquare) {
    const CullView view = RidgeGlobe::alongRow();
    const osg::Vec3d at = ecefDeg(0.1, 0.1, 1000.0);
    const glm::dvec3 eye(at.x(), at.y(), at.z());
    for (const auto& [columns, rows] : {std::pair(1000.0, 100.0), std::pair(100.0, 1000.0), std::pair(500.0, 500.0)}) {
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        visitor->pushViewport(new osg::Viewport(0, 0, columns, rows));
        visitor->pushProjectionMatrix(new osg::RefMatrix(osg::Matrixd::frustum(-0.1, 0.1, -1.0, 1.0, 1.0, 1e6)));
        visitor->pushModelViewMatrix(new osg::RefMatrix(view.modelView), osg::Transform::ABSOLUTE_RF);
        const auto lines = LevelView::of(*visitor, core::Ellipsoid(6378137.0, 6356752.3142), eye, {});
        ASSERT_TRUE(lines);
        const auto span = PictureSpan::of(*lines, lines->frameAt(eye));
        ASSERT_TRUE(span);
        EXPECT_GE(span->drawing, std::max(0.2 / columns, 2.0 / rows) / 128.0);
    }
}

// An application may change a mesh without announcing it.
TEST(NearMeshes, AreReadAnewOnceTheyHaveChanged) {
    RidgeGlobe globe;
    installBins(*globe.root);
    NearMeshes meshes;
    const auto meshOf = [&](std::size_t i) {
        return meshes.meshOf(*installedOn(*globe.row[i]), *globe.row[i]->getChild(0));
    };
    const auto last = meshOf(0);
    ASSERT_TRUE(last);
    EXPECT_EQ(meshOf(0), last);
    for (osg::Vec3& vertex : verticesOf(*globe.row[0])) vertex *= 1.5f;
    for (int i = 0; i < 16; ++i) (void)meshOf(0);
    EXPECT_NE(meshOf(0)->x, last->x);
    meshes.setMostReads(1);
    EXPECT_TRUE(meshOf(1) && !meshOf(2) && meshOf(1));
}

// OSG draws such arrays, and crashes where it looks for intersections with them.
TEST(TerrainOcclusion, FindsTheGroundBelowTheEyeInMeshesOfDoubles) {
    for (const double height : {0.0, 3000.0}) {
        RidgeGlobe globe;
        osg::Geometry& geometry = geometryOf(*globe.row[0]);
        const osg::Vec3d up = ecefDeg(0.1, 0.1, height) - ecefDeg(0.1, 0.1, 0.0);
        const osg::ref_ptr<osg::Vec3dArray> doubles = new osg::Vec3dArray;
        for (const osg::Vec3& vertex : static_cast<const osg::Vec3Array&>(*geometry.getVertexArray()))
            doubles->push_back(osg::Vec3d(vertex) + up);
        geometry.setVertexArray(doubles);
        installBins(*globe.root, optionsOf("occlusion=on"));
        EXPECT_EQ(globe.drawsFarTile(), height > 0.0);
    }
}

// A globe of osgTerrain tiles. Along the equator stand tiles of 0.2 degrees: a plain, and in the third tile a ridge,
// which tile 4 lies behind. The eye is above the middle of tile 0.
struct TerrainGlobe {
    TerrainGlobe() {
        terrain->setEllipsoidModel(new osg::EllipsoidModel);
        for (int i = 0; i < 32; ++i)
            if (i != 20) terrain->addChild(makeFlatTile(extentsOfTile(i), 0.0f, 0.0f, 65));
        terrain->addChild(makeFlatTile(extentsDeg(0.2, 45.0, 0.0, 45.0), 0.0f, 0.0f, 65));
        for (int i = 0; i < 225; ++i) {
            row.push_back(makeFlatTile(extentsDeg(0.0, 0.2, 0.2 * i, 0.2 * i + 0.2), i == 2 ? 8000.0f : 0.0f));
            terrain->addChild(row.back());
        }
    }

    // `change`: is made between the update and the cull traversal.
    [[nodiscard]] bool drawsFarTile(const std::function<void()>& change = [] {}) {
        const CullView view = RidgeGlobe::alongRow();
        update(*terrain);
        change();
        return cull(*terrain, view, *visitor, ++frame).drawn.count(drawableOf(*row[4])) > 0;
    }
    [[nodiscard]] BinCounts counts() const { return BinStatistics::of(*visitor).getCounts(); }

    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    std::vector<osg::ref_ptr<osgTerrain::TerrainTile>> row;
    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    unsigned int frame = 0;
};

TEST(OccludingTerrainTiles, GetTheirPlatesInUpdatesWhereTheyAreLeftToThemselves) {
    TerrainGlobe globe;
    installBins(*globe.terrain, optionsOf("occlusion=auto"));
    int awaited = 0;
    for (; awaited < 100 && globe.drawsFarTile(); ++awaited) continue;
    EXPECT_GE(awaited, 1);
    EXPECT_LT(awaited, 100);
}

// With a technique that the application vouches for, the horizon is used if the eye is surely above what is drawn. A
// ridge hides nothing, because nobody knows its exact height.
TEST(OccludingTerrainTiles, OfATechniqueThatIsVouchedForAreTheHorizonAlone) {
    struct OtherTechnique : osgTerrain::GeometryTechnique {};
    TerrainGlobe globe;
    globe.terrain->setTerrainTechniquePrototype(new OtherTechnique);
    CullOptions options = optionsOf("occlusion=on");
    installBins(*globe.terrain, options);
    const auto hiddenFrom = [&](double longitude, double altitude) {
        const auto view = CullView::lookAt(ecefDeg(0.107, longitude, altitude), ecefDeg(0.107, longitude + 0.1, 0.0),
                                           {1, 0, 0}, 60.0);
        for (int i = 0; i < 2; ++i) {
            update(*globe.terrain);
            (void)cull(*globe.terrain, view, *globe.visitor, ++globe.frame);
        }
        return globe.counts().hidden;
    };
    EXPECT_EQ(hiddenFrom(0.507, 9000.0), 0u);
    options.techniqueMargin = 300.0;
    setCullOptions(*globe.terrain, options);
    EXPECT_GT(hiddenFrom(0.507, 8310.0), 0u);
    EXPECT_EQ(hiddenFrom(0.507, 8290.0), 0u);
    // the ridge ends at 0.6 degrees, and may overhang the plain by 300 m
    EXPECT_GT(hiddenFrom(0.6 + 350.0 / 111320.0, 500.0), 0u);
    EXPECT_EQ(hiddenFrom(0.6 + 290.0 / 111320.0, 500.0), 0u);
    for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(globe.drawsFarTile());
}

}  // namespace
}  // namespace osgAnalyticBin::test
