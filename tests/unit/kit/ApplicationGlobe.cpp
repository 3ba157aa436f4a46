// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ApplicationGlobe.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osgDB/WriteFile>
#include <osgUtil/PositionalStateContainer>
#include <osgUtil/RenderStage>
#include <osgUtil/UpdateVisitor>

#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

osg::Drawable* drawableOf(osg::Node& node) {
    if (osg::Drawable* drawable = node.asDrawable()) return drawable;
    if (auto* const tile = dynamic_cast<osgTerrain::TerrainTile*>(&node)) {
        struct First : osg::NodeVisitor {
            First() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
            void apply(osg::Drawable& drawable) override { first = &drawable; }
            osg::Drawable* first = nullptr;
        } visitor;
        if (tile->getTerrainTechnique()) tile->getTerrainTechnique()->traverse(visitor);
        return visitor.first;
    }
    osg::Group* group = node.asGroup();
    return group && group->getNumChildren() > 0 ? drawableOf(*group->getChild(0)) : nullptr;
}

osg::Geometry& geometryOf(osg::Node& node) {
    return *drawableOf(node)->asGeometry();
}

osg::Vec3Array& verticesOf(osg::Node& node) {
    return dynamic_cast<osg::Vec3Array&>(*geometryOf(node).getVertexArray());
}

void update(osg::Node& scene) {
    const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
    scene.accept(*visitor);
}

void ignoreDepth(osg::Node& node) {
    node.getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
}

void computeNear(CullView& view, osg::Node& scene) {
    view.camera = new osg::Camera;
    view.camera->addChild(&scene);
    view.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
}

osg::ref_ptr<osg::MatrixTransform> makeTower(const osg::Vec3d& place, float size) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& v : {osg::Vec3(-1, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 1)})
        vertices->push_back(v * size);
    const osg::ref_ptr<osg::Geometry> tower = makeGeometry(vertices, new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    return placed(tower, osg::Matrixd::translate(place));
}

CullView downTo(double latitude, double longitude, double altitude, double fovDeg) {
    return CullView::lookAt(ecefDeg(latitude, longitude, altitude), ecefDeg(latitude, longitude, 0), {0, 0, 1}, fovDeg);
}

CullView beside(const osg::Vec3d& place) {
    const osg::Vec3d up = place / place.length();
    osg::Vec3d east = osg::Vec3d(0, 0, 1) ^ up;
    east.normalize();
    return CullView::lookAt(place - east * 5000.0, place, up, 2.0);
}

CullOptions declaredHorizon() {
    CullOptions options;
    options.horizonUse = HorizonUse::Given;
    options.horizon = -50000.0;
    return options;
}

MeshGlobe::MeshGlobe(double altitude) {
    root->setEllipsoidModel(new osg::EllipsoidModel);
    for (int i = 0; i < 32; ++i) {
        const double south = -90.0 + 45.0 * (i / 8);
        const double west = -180.0 + 45.0 * (i % 8);
        tiles.push_back(makePaged(makeMeshTile(extentsDeg(south, south + 45, west, west + 45), altitude), "no.osgb"));
        root->addChild(tiles.back());
    }
}

bool MeshGlobe::draws(osg::Node& content, const CullView& view) {
    return cull(*scene, view, *visitor, ++frame).drawn.count(drawableOf(content)) > 0;
}

void MeshGlobe::expectDrawn(osg::Node& content, const CullView& view, bool isDrawn, int frames) {
    for (int i = 0; i < frames; ++i) {
        EXPECT_EQ(draws(content, view), isDrawn) << "frame " << i;
        update(*scene);
    }
}

CullView MeshGlobe::fromAbove(double altitude) {
    return CullView::lookAt(ecefDeg(22.5, -22.5, altitude), {0, 0, 0}, {0, 0, 1}, 100.0);
}

InstalledGlobe::InstalledGlobe(double altitude) : MeshGlobe(altitude) {
    installBins(*root);
}

FiledGlobe::FiledGlobe() {
    const auto file = makeGroup({makeMeshTile(extentsDeg(10, 30, 0, 40), 200.0)});
    EXPECT_TRUE(osgDB::writeNodeFile(*file, folder / "group.osgb"));
    tile = makePaged(makeMeshTile(extentsDeg(10, 50, 0, 40), 200.0), "group.osgb", 1e9f);
    tile->setDatabasePath(std::string(folder / ""));
    root->removeChildren(0, root->getNumChildren());
    root->addChild(tile);
    installBins(*root);
    group = readBelow(*tile)->asGroup();
    putBelow(*tile, group);
    update(*root);
}

bool FiledGlobe::shines(const osg::Light& light, const CullView& view) {
    (void)draws(*tile, view);
    const auto& lights = visitor->getRenderStage()->getPositionalStateContainer()->getAttrMatrixList();
    return std::any_of(lights.begin(), lights.end(), [&](const auto& at) { return at.first == &light; });
}

}  // namespace osgAnalyticBin::test
