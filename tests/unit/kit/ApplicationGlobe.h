// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Globes with bins that an application does something with.

#pragma once

#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osg/Drawable>
#include <osg/Geometry>
#include <osg/Light>

#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

/// The first drawable below a node; of osgTerrain tiles, as their technique made it last. Returns: nullptr when there
/// is none.
[[nodiscard]] osg::Drawable* drawableOf(osg::Node& node);

/// Of that drawable, which has to be a Geometry with float vertices.
[[nodiscard]] osg::Geometry& geometryOf(osg::Node& node);
[[nodiscard]] osg::Vec3Array& verticesOf(osg::Node& node);

/// Runs an update traversal.
void update(osg::Node& scene);

/// Switches the node's depth test off.
void ignoreDepth(osg::Node& node);

/// Lets OSG compute near and far planes for the view, by a camera with the scene below it.
void computeNear(CullView& view, osg::Node& scene);

/// Stands for the DatabasePager: notes which files are requested, and by which nodes.
struct Requests : osg::NodeVisitor::DatabaseRequestHandler {
    void requestNodeFile(const std::string& file, osg::NodePath& path, float, const osg::FrameStamp*,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced*) override {
        files.insert(file);
        nodes.insert(path.back());
        if (!request) request = new osg::Referenced;
    }
    std::set<std::string> files;
    std::set<const osg::Node*> nodes;
};

/// A small model at a place, ECEF.
[[nodiscard]] osg::ref_ptr<osg::MatrixTransform> makeTower(const osg::Vec3d& place, float size = 50.0f);

/// Looks straight down. Degrees and metres.
[[nodiscard]] CullView downTo(double latitude, double longitude, double altitude = 5e5, double fovDeg = 20.0);

/// Level, high above the terrain: only what stands in the air there is in the picture.
[[nodiscard]] CullView beside(const osg::Vec3d& place);

/// Terrain is declared to be nowhere deeper than 50 km.
[[nodiscard]] CullOptions declaredHorizon();

/// 32 tiles of 45 degrees, each a PagedLOD whose finer file never comes.
struct MeshGlobe {
    explicit MeshGlobe(double altitude = 0.0);

    [[nodiscard]] bool draws(osg::Node& content, const CullView& view);
    /// Expects it, with an update after each frame.
    void expectDrawn(osg::Node& content, const CullView& view, bool isDrawn = true, int frames = 3);
    [[nodiscard]] BinCounts counts() const { return BinStatistics::of(*visitor).getCounts(); }
    /// From above the middle of tile 19, which looks down.
    [[nodiscard]] static CullView fromAbove(double altitude = 5e5);
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
    explicit InstalledGlobe(double altitude = 0.0);
};

/// A root tile of 40 degrees, and a file below it: the application's plain group with one leaf.
struct FiledGlobe : MeshGlobe {
    FiledGlobe();
    /// Whether a light shines in this view.
    [[nodiscard]] bool shines(const osg::Light& light, const CullView& view);

    TemporaryFolder folder;
    osg::ref_ptr<osg::PagedLOD> tile;
    osg::ref_ptr<osg::Group> group;
};

}  // namespace osgAnalyticBin::test
