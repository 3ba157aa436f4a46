// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Models behind hills and behind the horizon. More of them: tests/scenes/models-*.scene. What the core proves:
// SortedEarthTest.cpp, HorizonTest.cpp.

#include "KitTest.h"

#include <osgAnalyticBin/HiddenByTerrainCallback.h>

#include <osg/RenderInfo>
#include <osg/View>

namespace osgAnalyticBin::test {
namespace {

osg::ref_ptr<osg::MatrixTransform> askingModel(const osg::Vec3d& at) {
    osg::ref_ptr<osg::MatrixTransform> model = makeTower(at);
    model->addCullCallback(new HiddenByTerrainCallback);
    return model;
}

// The ridge's globe, and a model beside the database that comes after it.
struct ModelsOnGlobe : RidgeGlobe {
    explicit ModelsOnGlobe(const CullOptions& options = optionsOf("occlusion=on")) {
        scene = makeGroup({root});
        installBins(*root, options);
    }

    osg::ref_ptr<osg::MatrixTransform> add(const osg::Vec3d& at, osg::Group& group) {
        const auto model = askingModel(at);
        group.addChild(model);
        return model;
    }
    osg::ref_ptr<osg::MatrixTransform> add(const osg::Vec3d& at) { return add(at, *scene); }
    [[nodiscard]] bool drawsAlongRow(osg::Node& node) { return draws(node, alongRow()); }
};

const osg::Vec3d kBehindRidge = ecefDeg(0.1, 0.9, 300.0), kBeforeRidge = ecefDeg(0.1, 0.3, 300.0);

// Cameras of osg::Views have one in their default state, unless the application has taken that away.
TEST(HiddenByTerrain, NeedsADepthTestInViews) {
    ModelsOnGlobe globe;
    const auto behind = globe.add(kBehindRidge);
    const auto testDepth = [](osg::Node& node) {
        node.getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::ON);
    };
    const osg::ref_ptr<osg::View> view = new osg::View;
    osg::RenderInfo info(nullptr, view);
    globe.visitor->setRenderInfo(info);
    EXPECT_TRUE(globe.drawsFarTile());
    testDepth(*globe.root);
    EXPECT_FALSE(globe.drawsFarTile());
    EXPECT_TRUE(globe.drawsAlongRow(*behind));
    testDepth(*globe.scene);
    EXPECT_FALSE(globe.drawsAlongRow(*behind));
}

// An application may have the same objects for each frame. What hid in the last one may be gone.
TEST(HiddenByTerrain, IsNotAskedByThePictureOfAnotherFrame) {
    ModelsOnGlobe globe;
    const auto behind = askingModel(kBehindRidge);
    globe.scene->insertChild(0, behind);
    CullView view = RidgeGlobe::alongRow();
    view.sameStage = new osgUtil::RenderStage;
    view.sameProjection = new osg::RefMatrix(view.projection);
    globe.expectDrawn(*behind, view);
}

// The visitor of one frame sees from somewhere else in the next, and in another pass of the same one.
TEST(HiddenByTerrain, DrawsWhatComesBeforeTheDatabaseAndForgetsOtherViews) {
    ModelsOnGlobe globe;
    const osg::ref_ptr<osg::Group> first = new osg::Group;
    globe.scene->insertChild(0, first);
    const auto before = globe.add(kBehindRidge, *first), after = globe.add(kBehindRidge);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(globe.drawsAlongRow(*before));
    EXPECT_FALSE(globe.drawsAlongRow(*after));
    --globe.frame;
    const CullView high = CullView::lookAt(ecefDeg(0.1, 0.1, 40000.0), ecefDeg(0.1, 0.9, 0.0), {1, 0, 0}, 30.0);
    for (const auto& model : {before, after}) EXPECT_TRUE(globe.draws(*model, high));
    // above the database
    ModelsOnGlobe whole;
    whole.scene->addCullCallback(new HiddenByTerrainCallback);
    const auto behind = whole.add(kBehindRidge);
    EXPECT_TRUE(whole.drawsAlongRow(*behind));
}

// A camera within the scene, and a projection, see something else.
TEST(HiddenByTerrain, DrawsEverythingForOtherCamerasInTheSameTraversal) {
    ModelsOnGlobe globe;
    const CullView view = RidgeGlobe::alongRow();
    const auto model = globe.add(kBehindRidge);
    ASSERT_FALSE(globe.draws(*model, view));
    globe.scene->removeChild(model);
    const osg::ref_ptr<osg::Projection> projection = new osg::Projection(view.projection);
    projection->addChild(model);
    globe.scene->addChild(projection);
    EXPECT_TRUE(globe.draws(*model, view));
    globe.scene->removeChild(projection);
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::NESTED_RENDER);
    camera->addChild(model);
    globe.scene->addChild(camera);
    EXPECT_TRUE(globe.draws(*model, view));
}

using ModelChange = std::function<void(osg::MatrixTransform& model)>;

osg::StateSet& stateOf(osg::MatrixTransform& model) {
    return *geometryOf(model).getOrCreateStateSet();
}

class OwnGeometry : public osg::Geometry {
public:
    explicit OwnGeometry(const osg::Geometry& other) : osg::Geometry(other) {}
};

void wrap(osg::MatrixTransform& model, osg::Group& group) {
    const osg::ref_ptr<osg::Node> child = model.getChild(0);
    model.removeChild(child);
    group.addChild(child);
    model.addChild(&group);
}

void wrapInLevel(osg::MatrixTransform& model, float radius = 0.0f) {
    const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    if (radius > 0.0f) {
        lod->setCenter(osg::Vec3());
        lod->setRadius(radius);
    }
    wrap(model, *lod);
    lod->setRange(0, 0.0f, 1e9f);
}

osg::ref_ptr<osg::Node> signOf(osg::MatrixTransform& model) {
    const osg::ref_ptr<osg::Geometry> sign = new osg::Geometry(geometryOf(model));
    ignoreDepth(*sign);
    return sign;
}

void addSwitchedSign(osg::MatrixTransform& model, bool isOn, osg::Node::NodeMask mask) {
    const osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    choice->addChild(signOf(model), isOn);
    choice->getChild(0)->setNodeMask(mask);
    wrap(model, *choice);
}

// A second level of the model, in another place and in front of all, that is shown nearer than a distance.
void addSign(osg::MatrixTransform& model, float distance) {
    wrapInLevel(model);
    model.getChild(0)->asGroup()->addChild(signOf(model));
    dynamic_cast<osg::LOD&>(*model.getChild(0)).setRange(1, 0.0f, distance);
    wrap(model, *new osg::MatrixTransform(osg::Matrixd::translate(1.0, 2.0, 3.0)));
}

// What may be drawn in front of terrain, or outside of its sphere, is drawn. More of it: tests/scenes/models-*.scene.
TEST(HiddenByTerrain, LeavesOutModelsOfManyKindsButNotWhatMayBeSeenAllTheSame) {
    const std::vector<std::pair<std::string, ModelChange>> hidden{
        {"levels of detail", [](auto& model) { wrapInLevel(model); }},
        {"a sign that is too far", [](auto& model) { addSign(model, 50000.0f); }},
        {"a sign that is switched off", [](auto& model) { addSwitchedSign(model, false, ~0u); }},
        {"a sign that is masked", [](auto& model) { addSwitchedSign(model, true, 0); }},
        {"a level in a sphere of the user's", [](auto& model) { wrapInLevel(model, 200.0f); }},
        {"another node that asks",
         [](auto& model) { model.getChild(0)->addCullCallback(new HiddenByTerrainCallback); }},
        {"scaled", [](auto& model) { wrap(model, *new osg::MatrixTransform(osg::Matrixd::scale(2.0, 1.0, 3.0))); }}};
    const std::vector<std::pair<std::string, ModelChange>> seen{
        {"a sign", [](auto& model) { addSign(model, 150000.0f); }},
        {"a sign that is switched on", [](auto& model) { addSwitchedSign(model, true, ~0u); }},
        {"a bin of its own", [](auto& model) { stateOf(model).setRenderBinDetails(3, "SomeBin"); }},
        {"smooth edges", [](auto& model) { stateOf(model).setMode(GL_POLYGON_SMOOTH, osg::StateAttribute::ON); }},
        {"points", [](auto& model) { geometryOf(model).getPrimitiveSet(0)->setMode(GL_POINTS); }},
        {"lines", [](auto& model) { geometryOf(model).getPrimitiveSet(0)->setMode(GL_LINE_STRIP); }},
        {"a cull callback below", [](auto& model) { model.getChild(0)->addCullCallback(new Before); }},
        {"no culling below", [](auto& model) { model.getChild(0)->setCullingActive(false); }},
        {"another frame",
         [](auto& model) {
             const osg::ref_ptr<osg::MatrixTransform> absolute = new osg::MatrixTransform;
             absolute->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
             wrap(model, *absolute);
         }},
        {"a part in another frame, culled",
         [](auto& model) {
             const osg::ref_ptr<osg::MatrixTransform> absolute = new osg::MatrixTransform;
             absolute->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
             absolute->setCullingActive(true);
             absolute->addChild(model.getChild(0));
             model.addChild(absolute);
         }},
        {"a frame that turns to the eye", [](auto& model) { wrap(model, *new osg::AutoTransform); }},
        {"a shear",
         [](auto& model) {
             wrap(model, *new osg::MatrixTransform(osg::Matrixd(1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)));
         }},
        {"a projection onto something, as of planar shadows",
         [](auto& model) {
             wrap(model, *new osg::MatrixTransform(osg::Matrixd(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -0.001, 0, 0, 0, 1)));
         }},
        {"a sphere that is too small", [](auto& model) { wrapInLevel(model, 1.0f); }},
        {"a class of the application's",
         [](auto& model) { model.getChild(0)->asGroup()->addChild(new OwnGeometry(geometryOf(model))); }},
        {"a camera", [](auto& model) { wrap(model, *new osg::Camera); }}};
    for (const auto* const changes : {&hidden, &seen}) {
        for (const auto& [name, change] : *changes) {
            ModelsOnGlobe globe;
            const auto model = globe.add(kBehindRidge);
            ASSERT_FALSE(globe.drawsAlongRow(*model));
            bool isEntered = false;
            change(*model);
            const osg::ref_ptr<Before> entered = new Before([&](auto&) { isEntered = true; });
            setTraversesAlways(*entered);
            model->addCullCallback(entered);
            (void)globe.draws(*globe.row[0], RidgeGlobe::alongRow());
            EXPECT_EQ(isEntered, changes == &seen) << name;
        }
    }
}

TEST(HiddenByTerrain, FollowsStatesAbove) {
    for (const bool ignoresDepth : {false, true}) {
        ModelsOnGlobe globe;
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        if (ignoresDepth) ignoreDepth(*group);
        globe.scene->addChild(group);
        const osg::ref_ptr<osg::Group> inner = new osg::Group;
        inner->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        group->addChild(inner);
        const auto first = globe.add(kBehindRidge, *inner), second = globe.add(kBehindRidge, *inner);
        const auto other = globe.add(kBehindRidge);
        stateOf(*second).setMode(GL_BLEND, osg::StateAttribute::ON);
        EXPECT_EQ(globe.drawsAlongRow(*first), ignoresDepth);
        EXPECT_EQ(globe.drawsAlongRow(*second), ignoresDepth);
        EXPECT_FALSE(globe.drawsAlongRow(*other));
    }
}

// Models in thousands do not keep the kit from knowing the near plane.
TEST(HiddenByTerrain, LeavesOutModelsWhereOsgComputesTheNearPlane) {
    ModelsOnGlobe globe;
    CullView view = RidgeGlobe::alongRow();
    computeNear(view, *globe.scene);
    globe.visitor->setNearFarRatio(1e-5);
    std::vector<osg::ref_ptr<osg::MatrixTransform>> models;
    for (int i = 0; i < 1000; ++i) models.push_back(globe.add(kBehindRidge));
    EXPECT_FALSE(globe.draws(*models.back(), view));
    EXPECT_FALSE(globe.drawsFarTile(view));
    // a plane at 100 km
    const auto far = globe.add(ecefDeg(0.1, 0.3, 300.0) + osg::Vec3d(0.0, 1e10, 0.0));
    EXPECT_TRUE(globe.draws(*models.back(), view));
    EXPECT_TRUE(globe.drawsFarTile(view));
}

// A tile that may be left out hides nothing.
TEST(HiddenByTerrain, OnATileKeepsTheDatabaseFromHiding) {
    ModelsOnGlobe globe;
    const auto model = globe.add(kBehindRidge);
    globe.row[2]->addCullCallback(new HiddenByTerrainCallback);
    EXPECT_TRUE(globe.drawsAlongRow(*model));
    EXPECT_TRUE(globe.drawsAlongRow(*globe.row[2]));
}

// From high above, the ridge hides no tile whole, and the search rests unless it hides models.
TEST(HiddenByTerrain, KeepsTheSearchGoingWhereItIsWorthIt) {
    ModelsOnGlobe globe{CullOptions()};
    const osg::Vec3d behind = ecefDeg(0.1, 0.68, 300.0);
    const CullView view = CullView::lookAt(ecefDeg(0.1, 0.1, 12000.0), behind, {1, 0, 0}, 60.0);
    ModelsOnGlobe always;
    ASSERT_FALSE(always.draws(*always.add(behind), view));
    const auto model = globe.add(behind);
    for (int i = 0; i < 40; ++i) globe.add(kBeforeRidge);
    const auto hiddenViews = [&] {
        int hidden = 0;
        for (int i = 0; i < 400; ++i) {
            update(*globe.scene);
            const bool isDrawn = globe.draws(*model, view);
            if (i >= 360 && !isDrawn) ++hidden;
        }
        return hidden;
    };
    EXPECT_LT(hiddenViews(), 20);
    for (int i = 0; i < 100; ++i) globe.add(behind);
    EXPECT_EQ(hiddenViews(), 40);
}

}  // namespace
}  // namespace osgAnalyticBin::test
