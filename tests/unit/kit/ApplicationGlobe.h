// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Globes with bins that an application does something with.

#pragma once

#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osg/CoordinateSystemNode>
#include <osg/Drawable>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgUtil/CullVisitor>

#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin::test {

/// The first drawable below a node; of osgTerrain tiles, as their technique made it last. Returns: nullptr when there
/// is none.
[[nodiscard]] osg::Drawable* drawableOf(osg::Node& node);

/// Runs an update traversal.
void update(osg::Node& scene);

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
    /// From above the middle of tile 19, which looks down.
    [[nodiscard]] static CullView fromAbove(double altitude = 5e5);
    /// Tile 15, on the other side of the globe, from there.
    [[nodiscard]] bool drawsAntipode(double altitude = 5e5) { return draws(*tiles[15], fromAbove(altitude)); }

    osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    osg::ref_ptr<osg::Group> scene = root;
    std::vector<osg::ref_ptr<osg::PagedLOD>> tiles;
    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    unsigned int frame = 0;
};

/// A root tile of 40 degrees, and a file below it: the application's plain group with one leaf.
struct FiledGlobe : MeshGlobe {
    FiledGlobe();

    TemporaryFolder folder;
    osg::ref_ptr<osg::PagedLOD> tile;
    osg::ref_ptr<osg::Group> group;
};

}  // namespace osgAnalyticBin::test
