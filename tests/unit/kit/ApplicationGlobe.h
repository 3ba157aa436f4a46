// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Globes with bins that an application does something with.

#pragma once

#include "DatabaseFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/Drawable>
#include <osg/Light>
#include <osgUtil/PositionalStateContainer>
#include <osgUtil/UpdateVisitor>

#include <functional>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

/// The first drawable below a node; of osgTerrain tiles, as their technique made it last. Returns: nullptr if none.
[[nodiscard]] inline osg::Drawable* drawableOf(osg::Node& node) {
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

/// Of that drawable, which has to be a Geometry with float vertices.
[[nodiscard]] inline osg::Geometry& geometryOf(osg::Node& node) {
    return *drawableOf(node)->asGeometry();
}
[[nodiscard]] inline osg::Vec3Array& verticesOf(osg::Node& node) {
    return dynamic_cast<osg::Vec3Array&>(*geometryOf(node).getVertexArray());
}

/// Runs an update traversal.
inline void update(osg::Node& scene) {
    const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
    scene.accept(*visitor);
}

/// Switches the node's depth test off.
inline void ignoreDepth(osg::Node& node) {
    node.getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
}

/// Lets OSG compute near and far planes for the view, by a camera with the scene below it.
inline void computeNear(CullView& view, osg::Node& scene) {
    view.camera = new osg::Camera;
    view.camera->addChild(&scene);
    view.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
}

/// Stands for the DatabasePager: notes which files are requested, and by which nodes.
struct Requests : osg::NodeVisitor::DatabaseRequestHandler {
    void requestNodeFile(const std::string& file, osg::NodePath& path, float, const osg::FrameStamp*,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced*) override {
        files.insert(file);
        nodes.insert(path.back());
        if (!request) request = new osg::Referenced;
        action();
    }
    std::function<void()> action = [] {};
    std::set<std::string> files;
    std::set<const osg::Node*> nodes;
};

/// A small model at a place, ECEF.
[[nodiscard]] inline osg::ref_ptr<osg::MatrixTransform> makeTower(const osg::Vec3d& place, float size = 50.0f) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& v : {osg::Vec3(-1, 0, 0), osg::Vec3(1, 0, 0), osg::Vec3(0, 1, 1)})
        vertices->push_back(v * size);
    return placed(makeGeometry(vertices, new osg::DrawArrays(GL_TRIANGLES, 0, 3)), osg::Matrixd::translate(place));
}

/// Looks straight down. Degrees and metres.
[[nodiscard]] inline CullView downTo(double latitude, double longitude, double altitude = 5e5, double fovDeg = 20.0) {
    return CullView::lookAt(ecefDeg(latitude, longitude, altitude), ecefDeg(latitude, longitude, 0), {0, 0, 1}, fovDeg);
}

/// Level, high above the terrain: only what stands in the air there is in the picture.
[[nodiscard]] inline CullView beside(const osg::Vec3d& place) {
    const osg::Vec3d up = place / place.length();
    osg::Vec3d east = osg::Vec3d(0, 0, 1) ^ up;
    east.normalize();
    return CullView::lookAt(place - east * 5000.0, place, up, 2.0);
}

/// Terrain is declared to be nowhere deeper than 50 km.
[[nodiscard]] inline CullOptions declaredHorizon() {
    return optionsOf("horizon=-50000");
}

/// The place of a tile of a globe of 32.
[[nodiscard]] inline core::GeodeticBin extentsOfTile(int number) {
    const double south = -90.0 + 45.0 * (number / 8), west = -180.0 + 45.0 * (number % 8);
    return extentsDeg(south, south + 45.0, west, west + 45.0);
}

/// 32 tiles of 45 degrees, each a PagedLOD whose finer file never comes.
struct MeshGlobe {
    explicit MeshGlobe(double altitude = 0.0) {
        root->setEllipsoidModel(new osg::EllipsoidModel);
        for (int i = 0; i < 32; ++i) {
            tiles.push_back(makePaged(makeMeshTile(extentsOfTile(i), altitude), "no.osgb"));
            root->addChild(tiles.back());
        }
    }

    [[nodiscard]] bool draws(osg::Node& content, const CullView& view) {
        return cull(*scene, view, *visitor, ++frame).drawn.count(drawableOf(content)) > 0;
    }
    /// Expects it, with an update after each frame.
    void expectDrawn(osg::Node& content, const CullView& view, bool isDrawn = true, int frames = 3) {
        for (int i = 0; i < frames; ++i) {
            EXPECT_EQ(draws(content, view), isDrawn) << "frame " << i;
            update(*scene);
        }
    }
    [[nodiscard]] BinCounts counts() const { return BinStatistics::of(*visitor).getCounts(); }
    /// From above the middle of tile 19, which looks down.
    [[nodiscard]] static CullView fromAbove(double altitude = 5e5) {
        return CullView::lookAt(ecefDeg(22.5, -22.5, altitude), {0, 0, 0}, {0, 0, 1}, 100.0);
    }
    /// Tile 15, on the other side of the globe, from there.
    [[nodiscard]] bool drawsAntipode(double altitude = 5e5) { return draws(*tiles[15], fromAbove(altitude)); }
    void expectAntipode(bool isDrawn, int frames = 3) { expectDrawn(*tiles[15], fromAbove(), isDrawn, frames); }

    osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    osg::ref_ptr<osg::Group> scene = root;
    std::vector<osg::ref_ptr<osg::PagedLOD>> tiles;
    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    unsigned int frame = 0;
};

/// With bins.
struct InstalledGlobe : MeshGlobe {
    explicit InstalledGlobe(double altitude = 0.0) : MeshGlobe(altitude) { installBins(*root); }
};

/// A globe of 32 tiles, of which one has a row of tiles of 0.2 degrees along the equator: a plain, and in the third
/// tile a ridge, which tile 4 lies behind. The eye is above the middle of tile 0.
struct RidgeGlobe : MeshGlobe {
    explicit RidgeGlobe(double ridgeHeight = 8000.0, int tilesInRow = 10) {
        root->removeChild(tiles[20]);
        const auto add = [this](double south, double north, double west, double east, double height) {
            row.push_back(makePaged(makeMeshTile(extentsDeg(south, north, west, east), height), "no.osgb"));
            // what is below the tiles may have any height
            setStoredBin(*row.back(),
                         AnalyticBin(extentsDeg(south, north, west, east).withAltitude({-12000.0, 9000.0}), 10.0));
            root->addChild(row.back());
        };
        for (int i = 0; i < tilesInRow; ++i) add(0, 0.2, 0.2 * i, 0.2 * i + 0.2, i == 2 ? ridgeHeight : 0.0);
        add(0, 0.2, 0.2 * tilesInRow, 45, 0.0);
        add(0.2, 45, 0, 45, 0.0);
    }

    [[nodiscard]] static CullView alongRow(double altitude = 1000.0) {
        return CullView::lookAt(ecefDeg(0.1, 0.1, altitude), ecefDeg(0.1, 1.0, altitude), {1, 0, 0}, 30.0);
    }
    [[nodiscard]] bool drawsFarTile(const CullView& view = alongRow()) { return draws(*row[4], view); }

    std::vector<osg::ref_ptr<osg::PagedLOD>> row;
};

/// With bins that look for what is hidden.
struct InstalledRidge : RidgeGlobe {
    explicit InstalledRidge(double ridgeHeight = 8000.0, int tilesInRow = 10) : RidgeGlobe(ridgeHeight, tilesInRow) {
        installBins(*root, optionsOf("occlusion=on"));
    }
};

/// A root tile of 40 degrees, and a file below it: the application's plain group with one leaf.
struct FiledGlobe : MeshGlobe {
    FiledGlobe() {
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
    /// Whether a light shines in this view.
    [[nodiscard]] bool shines(const osg::Light& light, const CullView& view) {
        (void)draws(*tile, view);
        const auto& lights = visitor->getRenderStage()->getPositionalStateContainer()->getAttrMatrixList();
        return std::any_of(lights.begin(), lights.end(), [&](const auto& at) { return at.first == &light; });
    }

    TemporaryFolder folder;
    osg::ref_ptr<osg::PagedLOD> tile;
    osg::ref_ptr<osg::Group> group;
};

}  // namespace osgAnalyticBin::test
