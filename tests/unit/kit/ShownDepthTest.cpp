// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The eye above the lowest surface that is shown, asked for in a real cull traversal. Random databases, eyes and rays:
// tests/long/scenes.

#include "../../../osgAnalyticBin/src/kit/cull/CullTraversal.h"
#include "../../../osgAnalyticBin/src/kit/cull/ShownDepth.h"
#include "../../../osgAnalyticBin/src/kit/cull/TileSelection.h"
#include "../../../osgAnalyticBin/src/kit/tile/InstalledDatabase.h"
#include "KitTest.h"

#include <osgAnalyticBin/core/horizon/Horizon.h>

namespace osgAnalyticBin::test {
namespace {

// Asks for the eye over a database of which nothing is deeper than `deepest`.
struct Asker : osg::NodeCallback {
    explicit Asker(double deepestAltitude) : deepest(deepestAltitude) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        osg::CullStack& cullStack = *nv->asCullStack();
        core::PlaneSet planes;
        for (const osg::Plane& plane : cullStack.getCurrentCullingSet().getFrustum().getPlaneList())
            planes.push_back({{plane[0], plane[1], plane[2]}, plane[3]});
        TileSelection selection;
        const DatabaseView view{*node->asGroup(),
                                *nv,
                                CullTraversal::of(*nv),
                                cullStack,
                                cullStack.getModelViewMatrix(),
                                cullStack.getProjectionMatrix(),
                                planes,
                                nullptr,
                                earth(),
                                {},
                                &selection,
                                &selection};
        const auto found = eyeAboveWhatIsShown(view, *Viewpoint::of(cullStack, *nv, false), deepest, depth);
        if (found && found->isAboveGround) eye = found->horizon;
    }

    const double deepest;
    double depth = 3000.0;
    std::optional<core::HorizonEye> eye;
};

void addTile(osg::Group& root, const core::GeodeticBin& extents, double altitude) {
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    tile->addChild(makeMeshTile(extents, altitude));
    setStoredBin(*tile, AnalyticBin(extents.withAltitude({altitude - 30.0, altitude + 1.0}), 1.0));
    root.addChild(tile);
}

// Looking east along the equator past the limb, 4500 m below the ellipsoid at its nearest, over tiles of a basin at
// -9000 m that are all below the picture. Beyond the limb there is something at -4000 m.
TEST(ShownDepth, IsThatOfABasinThatLinesOfSightPassHighAboveAndNeverLowerThanDeclared) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    addTile(*root, extentsDeg(-1.0, 1.0, -1.0, 0.5), -3000.0);
    for (int i = 10; i < 100; ++i) addTile(*root, extentsDeg(-0.025, 0.025, 0.05 * i, 0.05 * (i + 1)), -9000.0);
    EXPECT_EQ(installBins(*root), 91u);
    const double toLimb = std::acos((kEarthRadius - 4500.0) / (kEarthRadius + 2000.0)), beyond = 1.3 * toLimb;
    const core::HorizonBin something(earth(), core::GeodeticBin({0.0, 0.0}, {beyond, beyond}, {-4000.0, -4000.0}));
    const CullView view = CullView::lookAt(ecefDeg(0.0, 0.0, 2000.0),
                                           ecefDeg(0.0, osg::RadiansToDegrees(toLimb), -4500.0), {1, 0, 0}, 0.1);
    for (const double deepest : {std::numeric_limits<double>::infinity(), 3000.0}) {
        const osg::ref_ptr<Asker> asker = new Asker(deepest);
        asker->setNestedCallback(root->getCullCallback());
        root->setCullCallback(asker);
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        (void)cull(*root, view, *visitor);
        root->setCullCallback(asker->getNestedCallback());
        ASSERT_TRUE(asker->eye) << deepest;
        EXPECT_NEAR(asker->depth, 9000.0, deepest > 3000.0 ? 1.0 : 6001.0);
        EXPECT_EQ(asker->eye->hides(something), deepest == 3000.0);
    }
}

// The system may give it the address of one that is gone.
TEST(LastViews, OfADatabaseAreForgottenWithIt) {
    struct Known : InstalledDatabase {
        Known() : InstalledDatabase(new osg::EllipsoidModel) {}
    };
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    CullTraversal& traversal = CullTraversal::of(*visitor);
    osg::ref_ptr<Known> database = new Known;
    traversal.lastView(*database).depth = 1000.0;
    EXPECT_EQ(traversal.lastView(*database).depth, 1000.0);
    const Known* const before = database;
    database = nullptr;
    std::vector<osg::ref_ptr<Known>> others;
    for (int i = 0; i < 1000 && database != before; ++i) others.push_back(database = new Known);
    EXPECT_EQ(traversal.lastView(*database).depth, 0.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
