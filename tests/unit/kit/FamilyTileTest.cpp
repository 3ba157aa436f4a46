// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is delivered of kept tiles. Oracle: OSG's own traversal of the same scene, by a visitor of a derived class.
// Random scenes have it, too: tests/long/scenes.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// Kept tiles are entered by OSG.
struct OtherVisitor : osgUtil::CullVisitor {};

// Returns: the number of leaves.
std::size_t expectSameLeaves(osg::Node& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> plain = new osgUtil::CullVisitor;
    const osg::ref_ptr<osgUtil::CullVisitor> other = new OtherVisitor;
    const CullResult here = cull(scene, view, *plain), there = cull(scene, view, *other);
    const std::vector<Leaf> leaves = leavesIn(*here.stage);
    EXPECT_EQ(leaves.size(), leavesIn(*there.stage).size());
    EXPECT_TRUE(leaves == leavesIn(*there.stage));
    EXPECT_EQ(here.projection, there.projection);
    return leaves.size();
}

struct OneTile {
    osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    const core::GeodeticBin extents = extentsDeg(0.0, 10.0, 0.0, 10.0);
    const osg::ref_ptr<osg::MatrixTransform> mesh = makeMeshTile(extents, 100.0);
    const CullView view = CullView::lookAt(ecefDeg(5.0, 5.0, 2e6), ecefDeg(5.0, 5.0, 0.0), {0.0, 0.0, 1.0}, 60.0);

    OneTile() { globe->setEllipsoidModel(new osg::EllipsoidModel); }
};

TEST(FamilyTile, LeavesMeshesThatHangInTwoPlacesToOsg) {
    OneTile scene;
    osg::Node& geode = *scene.mesh->getChild(0);
    const osg::ref_ptr<osg::Node> geometry = geode.asGroup()->getChild(0);
    const osg::ref_ptr<osg::Group> dark = new osg::Group;
    dark->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth);
    dark->addChild(geometry);
    scene.mesh->replaceChild(&geode, dark);
    scene.mesh->addChild(geometry);
    scene.globe->addChild(makePaged(scene.mesh, "no.osgb"));
    EXPECT_GT(installBins(*scene.globe, {}), 0u);
    EXPECT_EQ(expectSameLeaves(*scene.globe, scene.view), 2u);
}

TEST(FamilyTile, LeavesOutPartsThatAreSmallFeatures) {
    OneTile scene;
    const osg::ref_ptr<osg::Node> ground = drawableOf(*scene.mesh), sign = drawableOf(*makeTower({}));
    const osg::ref_ptr<osg::Group> small = new osg::Group;
    small->addChild(sign);
    scene.mesh->setChild(0, ground);
    scene.mesh->addChild(small);
    scene.globe->addChild(makePaged(scene.mesh, "no.osgb"));
    EXPECT_GT(installBins(*scene.globe, {}), 0u);
    CullView view = scene.view;
    EXPECT_EQ(expectSameLeaves(*scene.globe, view), 2u);
    view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
    EXPECT_EQ(expectSameLeaves(*scene.globe, view), 1u);
}

TEST(FamilyTile, GoesOnWhereTheApplicationEmptiesAFile) {
    OneTile scene;
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(scene.mesh, "finer.osgb", 1e7f);
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    for (const double west : {0.0, 5.0}) {
        for (const double south : {0.0, 5.0})
            file->addChild(makeMeshTile(extentsDeg(south, south + 5.0, west, west + 5.0), 100.0));
    }
    putBelow(*paged, file);
    scene.globe->addChild(paged);
    EXPECT_GT(installBins(*scene.globe, {}), 0u);
    EXPECT_EQ(expectSameLeaves(*scene.globe, scene.view), 4u);
    const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
    file->removeChildren(0, file->getNumChildren());
    for (unsigned int frame = 2; frame < 5; ++frame) {
        EXPECT_EQ(expectSameLeaves(*scene.globe, scene.view), 0u);
        update->setTraversalNumber(frame);
        scene.globe->accept(*update);
    }
}

TEST(FamilyTile, MovesPlanesByWholeMatrices) {
    OneTile scene;
    scene.globe->addChild(makePaged(scene.mesh, "no.osgb"));
    EXPECT_GT(installBins(*scene.globe, {}), 0u);
    osg::Matrixd matrix = scene.mesh->getMatrix();
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) matrix(row, column) *= 0.5;  // the same place, written otherwise
    }
    scene.mesh->setMatrix(matrix);
    const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
    Random random(3);
    for (unsigned int frame = 2; frame < 40; ++frame) {
        update->setTraversalNumber(frame);
        scene.globe->accept(*update);
        const osg::Vec3d at = ecefDeg(random.uniform(-2.0, 12.0), random.uniform(-2.0, 12.0), 0.0);
        const CullView view = CullView::lookAt(ecefDeg(5.0, 5.0, 1e6), at, {0.0, 0.0, 1.0}, 10.0);
        (void)expectSameLeaves(*scene.globe, view);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
