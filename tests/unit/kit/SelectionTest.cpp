// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is drawn is selected before: callbacks of an application that change something in between.

#include "KitTest.h"

#include <osg/observer_ptr>

namespace osgAnalyticBin::test {
namespace {

// Models of the application's are before and behind the tiles. Tiles 18 and 19 are in view.
struct ModelGlobe : MeshGlobe {
    ModelGlobe() {
        first->addChild(makeTower(ecefDeg(22.5, -22.5, 0.0)));
        last->addChild(makeTower(ecefDeg(22.0, -22.0, 0.0)));
        root->insertChild(0, first);
        root->addChild(last);
    }
    [[nodiscard]] bool shows(osg::Node& node) { return draws(node, fromAbove(3e6)); }

    osg::ref_ptr<osg::Group> first = new osg::Group, last = new osg::Group;
};

TEST(Selection, IsMadeAfterCallbacksAtTheRoot) {
    MeshGlobe globe;
    osg::Node& tile = *globe.tiles[19];
    unsigned int mask = 0;
    globe.root->setCullCallback(new Before([&](auto&) { tile.setNodeMask(mask); }));
    installBins(*globe.root);
    for (mask = 0; mask < 2; ++mask) EXPECT_EQ(globe.draws(tile, MeshGlobe::fromAbove()), mask == 1);
}

TEST(Selection, AsksForMasksThatWereSetMeanwhile) {
    ModelGlobe globe;
    installBins(*globe.root);
    osg::PagedLOD& tile = *globe.tiles[19];
    for (osg::Node* const masked : {static_cast<osg::Node*>(&tile), tile.getChild(0)}) {
        globe.first->setCullCallback(new Before([&](auto&) { masked->setNodeMask(0); }));
        EXPECT_FALSE(globe.shows(tile));
        globe.first->setCullCallback(new Before([&](auto&) { masked->setNodeMask(~0u); }));
        EXPECT_TRUE(globe.shows(*globe.tiles[18]));
    }
}

// One with tiles, one without, and one that is the content of a file.
TEST(Selection, AsksForTheMasksOfGroups) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::Group> above = new osg::Group, model = new osg::Group, file = new osg::Group;
    globe.root->replaceChild(globe.tiles[19], above);
    above->addChild(globe.tiles[19]);
    model->addChild(makeTower(ecefDeg(22.0, -22.0, 0.0)));
    globe.root->addChild(model);
    file->addChild(makePaged(makeMeshTile(extentsDeg(0.0, 45.0, -90.0, -45.0), 0.0), "no.osgb"));
    setFinerWithin(*globe.tiles[18], 1e9f);
    putBelow(*globe.tiles[18], file);
    installBins(*globe.root);
    const auto shows = [&](osg::Node& node) { return globe.draws(node, MeshGlobe::fromAbove(3e6)); };
    for (const osg::ref_ptr<osg::Group>& group : {above, model, file}) {
        EXPECT_TRUE(shows(*group));
        group->setNodeMask(0);
        EXPECT_FALSE(shows(*group));
        group->setNodeMask(~0u);
    }
}

TEST(Selection, GoesOnWithoutAStateThatWasTakenAwayMeanwhile) {
    ModelGlobe globe;
    osg::Node& tile = *globe.tiles[19];
    tile.getOrCreateStateSet()->setAttributeAndModes(new osg::Depth);
    installBins(*globe.root);
    globe.first->setCullCallback(new Before([&](auto&) { tile.setStateSet(nullptr); }));
    EXPECT_TRUE(globe.shows(tile));
}

TEST(Selection, HoldsWhatIsTakenAwayMeanwhile) {
    ModelGlobe globe;
    installBins(*globe.root);
    const osg::observer_ptr<osg::Group> last = globe.last.get();
    globe.last = nullptr;
    bool isHeld = false;
    globe.first->setCullCallback(new Before([&](auto&) {
        if (last.valid()) globe.root->removeChild(last.get());
        isHeld = last.valid();
    }));
    EXPECT_TRUE(globe.shows(*globe.tiles[19]));
    EXPECT_TRUE(isHeld);
    EXPECT_FALSE(last.valid());
}

// Callbacks that promise to traverse are run after it, too.
TEST(Selection, HoldsForTheVisitorThatItWasMadeFor) {
    const auto globeWith = [](const Before::Action& action) {
        MeshGlobe globe;
        const auto file = makeGroup({makeMeshTile(extentsDeg(0.0, 45.0, -45.0, 0.0), 0.0)});
        setFinerWithin(*globe.tiles[19], 1e5f);
        putBelow(*globe.tiles[19], file);
        globe.tiles[18]->setNodeMask(1);
        const osg::ref_ptr<Before> callback = new Before(action);
        setTraversesAlways(*callback);
        globe.root->setCullCallback(callback);
        installBins(*globe.root);
        EXPECT_FALSE(globe.drawsAntipode());
        return globe;
    };
    MeshGlobe plain = globeWith([](auto&) {});
    EXPECT_TRUE(plain.draws(*plain.tiles[18], MeshGlobe::fromAbove(3e6)));
    EXPECT_FALSE(plain.draws(*plain.tiles[19]->getChild(1), MeshGlobe::fromAbove(3e6)));
    MeshGlobe scaled = globeWith([](osgUtil::CullVisitor& visitor) { visitor.setLODScale(0.01f); });
    scaled.visitor->setLODScale(1.0f);
    EXPECT_TRUE(scaled.draws(*scaled.tiles[19]->getChild(1), MeshGlobe::fromAbove(3e6)));
    EXPECT_FALSE(scaled.draws(*scaled.tiles[19], MeshGlobe::fromAbove(3e6)));
    MeshGlobe masked = globeWith([](osgUtil::CullVisitor& visitor) { visitor.setTraversalMask(2); });
    masked.visitor->setTraversalMask(1);
    EXPECT_FALSE(masked.draws(*masked.tiles[18], MeshGlobe::fromAbove(3e6)));
}

// The state above is a group's, and obeys no depth.
TEST(Selection, KnowsTheStatesAboveWhereItIsMadeAnew) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::Group> above = new osg::Group;
    ignoreDepth(*above);
    globe.root->replaceChild(globe.tiles[15], above);
    above->addChild(globe.tiles[15]);
    const osg::ref_ptr<Before> callback =
        new Before([](osgUtil::CullVisitor& visitor) { visitor.setLODScale(2.0f * visitor.getLODScale()); });
    setTraversesAlways(*callback);
    above->setCullCallback(callback);
    installBins(*globe.root);
    EXPECT_FALSE(globe.draws(*globe.tiles[14], MeshGlobe::fromAbove()));
    EXPECT_TRUE(globe.drawsAntipode());
}

// For a callback that goes on behind its node.
TEST(Selection, LeavesTheVisitorAsItWas) {
    struct After : osg::NodeCallback {
        void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
            osgUtil::CullVisitor& visitor = *nv->asCullVisitor();
            const auto planes = [&] { return visitor.getCurrentCullingSet().getFrustum().getCurrentMask(); };
            const auto before = planes();
            const osg::NodePath path = visitor.getNodePath();
            const osgUtil::StateGraph* const states = visitor.getCurrentStateGraph();
            traverse(node, nv);
            isAsItWas = planes() == before && visitor.getNodePath() == path && visitor.getCurrentStateGraph() == states;
        }
        bool isAsItWas = false;
    };
    MeshGlobe globe;
    globe.tiles[19]->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth);
    // OSG itself enters the meshes
    for (const auto& tile : globe.tiles) tile->getChild(0)->setCullCallback(new osg::NodeCallback);
    const osg::ref_ptr<After> after = new After;
    globe.root->setCullCallback(after);
    installBins(*globe.root);
    EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove(3e6)));
    EXPECT_TRUE(after->isAsItWas);
}

// As osg::PagedLOD does it itself: levels that are not come to grow old, and files with them.
TEST(Selection, StampsTheLevelsThatItGoesThrough) {
    InstalledGlobe globe;
    osg::PagedLOD& tile = *globe.tiles[19];
    globe.frame = 40;
    const double time = 7.0;
    (void)cull(*globe.root, MeshGlobe::fromAbove(), *globe.visitor, ++globe.frame, time);
    EXPECT_EQ(tile.getFrameNumberOfLastTraversal(), globe.frame);
    EXPECT_EQ(tile.getFrameNumber(0), globe.frame);
    EXPECT_EQ(tile.getTimeStamp(0), time);
    EXPECT_NE(globe.tiles[15]->getFrameNumber(0), globe.frame);
}

}  // namespace
}  // namespace osgAnalyticBin::test
