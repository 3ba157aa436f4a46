// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What hides is known to be drawn, and what is hidden is known to obey depth: meshes, states, callbacks, whatever an
// application makes of them. States are asked one by one; pictures of random states: long/scenes.

#include "ApplicationGlobe.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Fog>
#include <osg/FragmentProgram>
#include <osg/FrontFace>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Hint>
#include <osg/Light>
#include <osg/LogicOp>
#include <osg/Material>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osg/Scissor>
#include <osg/ShadeModel>
#include <osg/Stencil>
#include <osg/TexEnv>
#include <osg/Texture2D>
#include <osg/VertexProgram>
#include <osg/Viewport>
#include <osgTerrain/GeometryTechnique>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::test {

namespace {

using State = osg::StateAttribute;

// A texture of the application's own.
struct OwnTexture : osg::Texture2D {};

struct NamedState {
    std::string name;
    std::function<void(osg::StateSet&)> set;
};

NamedState attribute(const std::string& name, osg::StateAttribute* made, unsigned int value = State::ON) {
    const osg::ref_ptr<osg::StateAttribute> kept(made);
    return {name, [kept, value](osg::StateSet& state) { state.setAttribute(kept, value); }};
}

NamedState attributeAndModes(const std::string& name, osg::StateAttribute* made, unsigned int value = State::ON) {
    const osg::ref_ptr<osg::StateAttribute> kept(made);
    return {name, [kept, value](osg::StateSet& state) { state.setAttributeAndModes(kept, value); }};
}

NamedState mode(const std::string& name, GLenum mode, unsigned int value = State::ON) {
    return {name, [mode, value](osg::StateSet& state) { state.setMode(mode, value); }};
}

osg::StateAttribute* withShaderComponent() {
    auto* const material = new osg::Material;
    material->setShaderComponent(new osg::ShaderComponent);
    return material;
}

constexpr GLenum kRasterizerDiscard = 0x8C89, kDepthClamp = 0x864F, kPrimitiveRestart = 0x8F9D;

std::vector<NamedState> doubtfulStates() {
    return {attributeAndModes("scissor", new osg::Scissor(0, 0, 1, 1)),
            attributeAndModes("logic operation", new osg::LogicOp),
            attributeAndModes("stencil", new osg::Stencil),
            attributeAndModes("blending", new osg::BlendFunc, State::ON | State::PROTECTED),
            attributeAndModes("polygon offset", new osg::PolygonOffset(1.0f, 1.0f)),
            attributeAndModes("clip plane", new osg::ClipPlane),
            attributeAndModes("vertex program", new osg::VertexProgram),
            attributeAndModes("fragment program", new osg::FragmentProgram),
            // what it draws has other depths than beside it, where a program makes those
            attributeAndModes("program without shaders", new osg::Program),
            {"program",
             [](osg::StateSet& state) {
                 const osg::ref_ptr<osg::Program> program = new osg::Program;
                 program->addShader(new osg::Shader(osg::Shader::VERTEX, "void main() {}"));
                 state.setAttributeAndModes(program);
             }},
            attribute("shader component", withShaderComponent()),
            attribute("viewport", new osg::Viewport(0, 0, 1, 1)),
            attribute("colour mask", new osg::ColorMask(true, true, false, true)),
            attribute("depth function", new osg::Depth(osg::Depth::GREATER)),
            attribute("depth range", new osg::Depth(osg::Depth::LESS, 0.0, 0.5)),
            attribute("depth mask", new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false)),
            attribute("front faces culled", new osg::CullFace(osg::CullFace::FRONT)),
            attribute("winding", new osg::FrontFace(osg::FrontFace::CLOCKWISE), State::ON | State::OVERRIDE),
            mode("no depth test", GL_DEPTH_TEST, State::OFF),
            mode("no depth test, overriding", GL_DEPTH_TEST, State::OFF | State::OVERRIDE),
            mode("rasterizer discard", kRasterizerDiscard),
            mode("depth clamp", kDepthClamp),
            mode("primitive restart", kPrimitiveRestart),
            {"texture of the application's",
             [](osg::StateSet& state) { state.setTextureAttributeAndModes(0, new OwnTexture); }}};
}

std::vector<NamedState> harmlessStates() {
    return {attributeAndModes("material", new osg::Material),
            attributeAndModes("light", new osg::Light(3)),
            attributeAndModes("fog", new osg::Fog),
            attributeAndModes("shade model", new osg::ShadeModel),
            attributeAndModes("hint", new osg::Hint(GL_FOG_HINT, GL_NICEST)),
            attributeAndModes("culled back faces", new osg::CullFace(osg::CullFace::BACK)),
            attributeAndModes("winding", new osg::FrontFace(osg::FrontFace::COUNTER_CLOCKWISE)),
            attributeAndModes("depth", new osg::Depth(osg::Depth::LEQUAL)),
            attributeAndModes("blending off", new osg::BlendFunc, State::OFF),
            attributeAndModes("scissor off", new osg::Scissor(0, 0, 1, 1), State::OFF),
            mode("lighting off", GL_LIGHTING, State::OFF),
            {"texture", [](osg::StateSet& state) {
                 state.setTextureAttributeAndModes(0, new osg::Texture2D);
                 state.setTextureAttribute(0, new osg::TexEnv);
             }}};
}

osg::Geometry& geometryOf(osg::Node& tile) {
    return *drawableOf(tile)->asGeometry();
}

// Gives a tile the vertices of another mesh, as OSG asks for it.
void takeVertices(osg::MatrixTransform& from, osg::PagedLOD& tile) {
    const auto& mesh = dynamic_cast<const osg::MatrixTransform&>(*tile.getChild(0));
    const osg::Vec3d shift = from.getMatrix().getTrans() - mesh.getMatrix().getTrans();
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& vertex : static_cast<const osg::Vec3Array&>(*geometryOf(from).getVertexArray()))
        vertices->push_back(osg::Vec3d(vertex) + shift);
    geometryOf(tile).setVertexArray(vertices);
    geometryOf(tile).dirtyBound();
}

// Above the database, on it, on a tile, and on what the tile draws.
std::vector<osg::Node*> placesIn(MeshGlobe& globe) {
    return {globe.scene, globe.root, globe.tiles[19], drawableOf(*globe.tiles[19])->getParent(0),
            drawableOf(*globe.tiles[19])};
}

struct ScenedGlobe : MeshGlobe {
    ScenedGlobe() {
        scene = new osg::Group;
        scene->addChild(root);
    }
};

TEST(Evidence, IsMissingInStatesThatAreNotKnown) {
    ScenedGlobe globe;
    installBins(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    for (const NamedState& state : doubtfulStates()) {
        for (osg::Node* const node : placesIn(globe)) {
            const osg::ref_ptr<osg::StateSet> before = node->getStateSet();
            node->setStateSet(new osg::StateSet);
            state.set(*node->getStateSet());
            EXPECT_TRUE(globe.drawsAntipode()) << state.name << " on " << node->className();
            node->setStateSet(before);
            EXPECT_FALSE(globe.drawsAntipode()) << state.name;
        }
    }
}

TEST(Evidence, IsNotMissingInHarmlessStates) {
    ScenedGlobe globe;
    installBins(*globe.root);
    for (const NamedState& state : harmlessStates()) {
        for (osg::Node* const node : placesIn(globe)) {
            node->setStateSet(new osg::StateSet);
            state.set(*node->getStateSet());
            EXPECT_FALSE(globe.drawsAntipode()) << state.name << " on " << node->className();
            node->setStateSet(nullptr);
        }
    }
    installBins(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
}

// A face is culled by an attribute and a mode, which may stand in different states.
TEST(Evidence, IsMissingWhereAnAttributeAndItsModeStandApart) {
    for (const bool isModeAbove : {false, true}) {
        ScenedGlobe globe;
        installBins(*globe.root);
        osg::StateSet& above = *globe.scene->getOrCreateStateSet();
        osg::StateSet& below = *globe.root->getOrCreateStateSet();
        (isModeAbove ? above : below).setMode(GL_CULL_FACE, State::ON);
        EXPECT_FALSE(globe.drawsAntipode());
        (isModeAbove ? below : above).setAttribute(new osg::CullFace(osg::CullFace::FRONT));
        EXPECT_TRUE(globe.drawsAntipode());
    }
}

void takeTriangle(osg::Geometry& geometry, std::size_t number) {
    auto& triangles = static_cast<osg::DrawElementsUInt&>(*geometry.getPrimitiveSet(0));
    const auto at = triangles.begin() + static_cast<std::ptrdiff_t>(3 * number);
    triangles.erase(at, at + 3);
    triangles.dirty();
    geometry.dirtyBound();
}

TEST(Evidence, IsMissingForAMeshWithoutOneTriangle) {
    for (const bool isLater : {false, true}) {
        for (const std::size_t number : {0U, 7U, 13U}) {
            MeshGlobe globe;
            if (isLater) installBins(*globe.root);
            EXPECT_EQ(globe.drawsAntipode(), !isLater);
            takeTriangle(geometryOf(*globe.tiles[19]), number);
            if (!isLater) installBins(*globe.root);
            for (int i = 0; i < 3; ++i) {
                EXPECT_TRUE(globe.drawsAntipode()) << number << isLater;
                update(*globe.root);
            }
        }
    }
}

TEST(Evidence, ComesBackWithTheMesh) {
    MeshGlobe globe;
    installBins(*globe.root);
    osg::Geometry& geometry = geometryOf(*globe.tiles[19]);
    const osg::ref_ptr<osg::PrimitiveSet> whole = osg::clone(geometry.getPrimitiveSet(0), osg::CopyOp::DEEP_COPY_ALL);
    takeTriangle(geometry, 7);
    EXPECT_TRUE(globe.drawsAntipode());
    update(*globe.root);
    geometry.setPrimitiveSet(0, whole);
    geometry.dirtyBound();
    EXPECT_TRUE(globe.drawsAntipode());
    update(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
}

TEST(Evidence, IsMissingForAMeshThatHasBecomeNarrower) {
    MeshGlobe globe;
    installBins(*globe.root);
    takeVertices(*makeMeshTile(extentsDeg(0.0, 45.0, -45.0, -1.0), 0.0), *globe.tiles[19]);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(globe.drawsAntipode()) << i;
        update(*globe.root);
    }
}

TEST(Evidence, IsOfMeshesAsDeepAsTheyHaveBecome) {
    MeshGlobe globe;
    installBins(*globe.root);
    const auto hidden = [&] {
        EXPECT_FALSE(globe.drawsAntipode());
        return BinStatistics::of(*globe.visitor).getCounts().hidden;
    };
    const auto before = hidden();
    takeVertices(*makeMeshTile(extentsDeg(0.0, 45.0, -45.0, 0.0), -6e5), *globe.tiles[19]);
    EXPECT_TRUE(globe.drawsAntipode());
    update(*globe.root);
    EXPECT_LT(hidden(), before);
}

TEST(Evidence, IsMissingForATileThatIsNarrowerThanItsPlace) {
    MeshGlobe globe;
    globe.root->removeChild(globe.tiles[19]);
    globe.tiles[19] = makePaged(makeMeshTile(extentsDeg(0.0, 45.0, -45.0, -1.0), 0.0), "no.osgb");
    globe.root->addChild(globe.tiles[19]);
    setStoredBin(*globe.tiles[19],
                 AnalyticBin(extentsDeg(0.0, 45.0, -45.0, 0.0).withAltitude({-60000.0, 9000.0}), 10.0));
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsAntipode());
}

// Shown in place of the tile's own mesh.
TEST(Evidence, IsMissingForAFinerLevelThatLeavesAGap) {
    const std::pair<double, bool> cases[] = {{0.0, false}, {0.0, true}, {-1.0, false}, {-1.0, true}};
    for (const auto& [east, hasCallback] : cases) {
        MeshGlobe globe;
        if (hasCallback) globe.tiles[19]->setCullCallback(new osg::NodeCallback);
        const osg::ref_ptr<osg::Group> file = new osg::Group;
        file->addChild(makeMeshTile(extentsDeg(0.0, 45.0, -45.0, -22.5), 10.0));
        file->addChild(makeMeshTile(extentsDeg(0.0, 45.0, -22.5, east), 10.0));
        globe.tiles[19]->setRange(0, 1e9f, 1e10f);
        globe.tiles[19]->setRange(1, 0.0f, 1e9f);
        putBelow(*globe.tiles[19], file);
        installBins(*globe.root);
        EXPECT_EQ(globe.drawsAntipode(), east < 0.0) << east;
        // where the tile's own mesh is shown, too, the gap does not matter
        globe.tiles[19]->setRange(0, 0.0f, 1e10f);
        EXPECT_FALSE(globe.drawsAntipode()) << east;
    }
}

TEST(Evidence, IsMissingForGeometryOfAnotherClass) {
    struct Own : osg::Geometry {
        explicit Own(const osg::Geometry& other) : osg::Geometry(other) {}
        void drawImplementation(osg::RenderInfo&) const override {}
    };
    MeshGlobe globe;
    osg::Geometry& geometry = geometryOf(*globe.tiles[19]);
    const osg::ref_ptr<osg::Geometry> own = new Own(geometry);
    geometry.getParent(0)->replaceChild(&geometry, own);
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsAntipode());
}

TEST(Evidence, IsMissingForADrawableThatIsDrawnByACallback) {
    struct DrawsNothing : osg::Drawable::DrawCallback {
        void drawImplementation(osg::RenderInfo&, const osg::Drawable*) const override {}
    };
    MeshGlobe globe;
    installBins(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    geometryOf(*globe.tiles[19]).setDrawCallback(new DrawsNothing);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(globe.drawsAntipode()) << i;
}

// They may change its vertices or leave it out; where they do in their own time cannot be known.
TEST(Evidence, IsMissingForADrawableThatACallbackMayChange) {
    for (const bool isUpdate : {false, true}) {
        MeshGlobe globe;
        installBins(*globe.root);
        EXPECT_FALSE(globe.drawsAntipode());
        osg::Geometry& geometry = geometryOf(*globe.tiles[19]);
        if (isUpdate) geometry.setUpdateCallback(new osg::DrawableUpdateCallback);
        if (!isUpdate) geometry.setEventCallback(new osg::DrawableEventCallback);
        EXPECT_TRUE(globe.drawsAntipode()) << isUpdate;
    }
}

// Such callbacks often run once, when a file has come, and take themselves off.
TEST(Evidence, ComesWhenTheCallbacksOfAMeshAreGone) {
    MeshGlobe globe;
    osg::Node& mesh = *globe.tiles[19]->getChild(0)->asGroup()->getChild(0);
    ASSERT_TRUE(mesh.asGroup());
    mesh.setUpdateCallback(new osg::NodeCallback);
    EXPECT_EQ(installBins(*globe.root), 32u);
    EXPECT_TRUE(globe.drawsAntipode());
    mesh.setUpdateCallback(nullptr);
    EXPECT_FALSE(globe.drawsAntipode());
    mesh.setEventCallback(new osg::NodeCallback);
    EXPECT_TRUE(globe.drawsAntipode());
}

// Leaves one child out.
struct LeavesOut : osg::NodeCallback {
    explicit LeavesOut(osg::Node* node) : out(node) {}
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        osg::Group& group = *node->asGroup();
        for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
            if (group.getChild(i) != out) group.getChild(i)->accept(*nv);
        }
    }
    osg::Node* out;
};

TEST(Evidence, IsMissingBelowACallbackOfTheApplicationsAtTheRootOrAbove) {
    for (const bool isLater : {false, true}) {
        for (const bool isAbove : {false, true}) {
            ScenedGlobe globe;
            const osg::ref_ptr<osg::NodeCallback> callback = new LeavesOut(globe.tiles[19]);
            osg::Node& node = isAbove ? *globe.scene : *static_cast<osg::Group*>(globe.root.get());
            if (isLater) installBins(*globe.root);
            node.addCullCallback(callback);
            if (!isLater) installBins(*globe.root);
            EXPECT_TRUE(globe.drawsAntipode()) << isLater << isAbove;
        }
    }
}

// A map above everything, a label, a target: what is drawn on top of the globe.
TEST(WhatIgnoresDepth, IsDrawnFromTheOtherSideOfTheGlobe) {
    const std::vector<NamedState> states{
        mode("no depth test", GL_DEPTH_TEST, State::OFF), attribute("always", new osg::Depth(osg::Depth::ALWAYS)),
        attribute("range", new osg::Depth(osg::Depth::LESS, 0.0, 0.01)), mode("depth clamp", kDepthClamp)};
    for (const NamedState& state : states) {
        for (const bool isLater : {false, true}) {
            MeshGlobe globe;
            osg::Node& node = isLater ? *globe.tiles[15] : *static_cast<osg::Node*>(drawableOf(*globe.tiles[15]));
            if (isLater) installBins(*globe.root);
            EXPECT_EQ(globe.drawsAntipode(), !isLater);
            state.set(*node.getOrCreateStateSet());
            if (!isLater) installBins(*globe.root);
            EXPECT_TRUE(globe.drawsAntipode()) << state.name << isLater;
            // another tile there is hidden as before
            EXPECT_FALSE(globe.draws(*globe.tiles[14], MeshGlobe::fromAbove())) << state.name << isLater;
        }
    }
}

TEST(WhatIgnoresDepth, KeepsTheTileThatItStandsBelow) {
    const auto sign = [](const osg::Vec3d& at) {
        const osg::ref_ptr<osg::MatrixTransform> tower = makeTower(at);
        drawableOf(*tower)->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, State::OFF);
        return tower;
    };
    const osg::Vec3d antipode = ecefDeg(-22.5, 157.5, 0.0);
    const std::pair<bool, bool> pairs[] = {{false, false}, {false, true}, {true, false}, {true, true}};
    // in a file, and added by the application
    for (const auto& [isLater, isTestedByItself] : pairs) {
        MeshGlobe globe;
        BinStatistics::of(*globe.visitor).setTileByTile(isTestedByItself);
        const osg::ref_ptr<osg::Group> file = new osg::Group;
        if (!isLater) file->addChild(sign(antipode));
        globe.tiles[15]->setRange(1, 0.0f, 1e10f);
        putBelow(*globe.tiles[15], file);
        installBins(*globe.root);
        if (isLater) {
            EXPECT_FALSE(globe.drawsAntipode());
            file->addChild(sign(antipode));
        }
        EXPECT_TRUE(globe.draws(*file, MeshGlobe::fromAbove())) << isLater << isTestedByItself;
    }
}

// States are inherited: those of a group above tiles, those of a tile by its finer ones, and those of a file by its
// tiles.
TEST(WhatIgnoresDepth, IsAllThatIsBelowIt) {
    struct Derived : osgUtil::CullVisitor {};
    enum Place { Group, Tile, File };
    const std::pair<Place, bool> cases[] = {{Group, false}, {Group, true}, {Tile, false}, {Tile, true}, {File, false}};
    for (const bool isDerived : {false, true}) {
        for (const auto& [place, isLater] : cases) {
            MeshGlobe globe;
            if (isDerived) globe.visitor = new Derived;
            const osg::ref_ptr<osg::Group> group = new osg::Group, file = new osg::Group;
            osg::PagedLOD& tile = *globe.tiles[15];
            globe.root->replaceChild(&tile, group);
            group->addChild(&tile);
            tile.setRange(0, 1e9f, 1e10f);
            tile.setRange(1, 0.0f, 1e9f);
            file->addChild(makePaged(makeMeshTile(extentsDeg(-45.0, 0.0, 135.0, 180.0), 10.0), "no.osgb"));
            putBelow(tile, file);
            if (isLater) installBins(*globe.root);
            EXPECT_EQ(globe.draws(*file, MeshGlobe::fromAbove()), !isLater);
            osg::Node& node = place == Group ? *group : place == Tile ? static_cast<osg::Node&>(tile) : *file;
            node.getOrCreateStateSet()->setMode(GL_DEPTH_TEST, State::OFF);
            if (!isLater) installBins(*globe.root);
            EXPECT_TRUE(globe.draws(*file, MeshGlobe::fromAbove())) << isDerived << place << isLater;
            EXPECT_FALSE(globe.draws(*globe.tiles[14], MeshGlobe::fromAbove()));
        }
    }
}

TEST(Evidence, IsMissingForGroundThatHasRisenAboveTheEye) {
    // above all posts, and between them, where the mesh sags
    for (const double altitude : {4000.0, -1000.0}) {
        MeshGlobe globe;
        installBins(*globe.root);
        const CullView low =
            CullView::lookAt(ecefDeg(22.0, -22.5, altitude), ecefDeg(60.0, 60.0, 0.0), {0, 0, 1}, 60.0);
        for (int i = 0; i < 4; ++i) {
            EXPECT_FALSE(globe.draws(*globe.tiles[15], low)) << altitude;
            EXPECT_GT(BinStatistics::find(*globe.visitor)->getCounts().hidden, 0u) << altitude;
        }
        takeVertices(*makeMeshTile(extentsDeg(0.0, 45.0, -45.0, 0.0), 20000.0), *globe.tiles[19]);
        for (int i = 0; i < 20; ++i) {
            (void)globe.draws(*globe.tiles[15], low);
            EXPECT_EQ(BinStatistics::find(*globe.visitor)->getCounts().hidden, 0u) << altitude << ' ' << i;
            update(*globe.root);
        }
    }
}

struct OwnBound : osg::Node::ComputeBoundingSphereCallback {
    osg::BoundingSphere computeBound(const osg::Node& node) const override { return node.computeBound(); }
};

TEST(AddedContent, IsNoticedWhereTheApplicationComputesTheBoundOfATile) {
    for (const bool isOwn : {false, true}) {
        MeshGlobe globe;
        installBins(*globe.root);
        const osg::Vec3d at = ecefDeg(22.5, -22.5, 300000.0);
        const CullView view = beside(at);
        EXPECT_FALSE(globe.draws(*globe.tiles[19], view));
        globe.tiles[19]->setComputeBoundingSphereCallback(isOwn ? new OwnBound : nullptr);
        const osg::ref_ptr<osg::Node> tower = makeTower(at);
        globe.tiles[19]->addChild(tower, 0.0f, 1e10f);
        globe.tiles[19]->setRange(1, 0.0f, 1e10f);
        for (int i = 0; i < 4; ++i) {
            EXPECT_TRUE(globe.draws(*tower, view)) << isOwn << i;
            update(*globe.root);
        }
    }
}

}  // namespace

}  // namespace osgAnalyticBin::test
