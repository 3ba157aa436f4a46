// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases as other builders make them: without stored bins.

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <set>

namespace osgAnalyticBin::test {

/// Extents in degrees; altitudes are all 0.
[[nodiscard]] core::GeodeticBin extentsDeg(double south, double north, double west, double east);

/// A terrain tile of one height; skirt in metres.
[[nodiscard]] osg::ref_ptr<osgTerrain::TerrainTile> makeFlatTile(const core::GeodeticBin& extents, float height,
                                                                 float skirt = 0.0f, unsigned int posts = 9);

/// WGS 84, with these children.
[[nodiscard]] osg::ref_ptr<osg::CoordinateSystemNode> makeGlobe(
    const std::vector<osg::ref_ptr<osg::Node>>& children = {});

[[nodiscard]] osg::ref_ptr<osg::Group> makeGroup(const std::vector<osg::ref_ptr<osg::Node>>& children);

/// A mesh of one height: a transform to the middle of the tile, a Geode and a Geometry with posts on a square grid.
[[nodiscard]] osg::ref_ptr<osg::MatrixTransform> makeMeshTile(const core::GeodeticBin& extents, double height,
                                                              unsigned int posts = 9);

/// A mesh, and a file for what is nearer than `cutoff` metres to the mesh's middle.
[[nodiscard]] osg::ref_ptr<osg::PagedLOD> makePaged(osg::Node* mesh, const std::string& file, float cutoff = 1e6f);

/// Shows what is paged below the tile within so many metres, and its mesh beyond.
void setFinerWithin(osg::PagedLOD& paged, float distance);

/// Puts content in the place where the pager would put that of the PagedLOD's file.
void putBelow(osg::PagedLOD& paged, osg::Node* content);

/// Takes what was paged in out again, as the DatabasePager does.
void pageOut(osg::PagedLOD& paged);

/// Writes a database of meshes 200 m high in three files: "root.osgb", 40 degrees wide; below it "children.osgb" with a
/// leaf in the south and a PagedLOD in the north; below that "single.osgb", a leaf that is the file's root.
/// `leafHeight` and `singleHeight`: of the leaves. Returns: the root's file; empty when it cannot be written.
[[nodiscard]] std::string writeMeshDatabase(const std::string& folder, double leafHeight, double singleHeight);

/// Reads the first file that the PagedLOD names as the DatabasePager does. Returns: null when that fails.
[[nodiscard]] osg::ref_ptr<osg::Node> readBelow(osg::PagedLOD& paged);

/// The bin that is installed on the node itself. Returns: nullptr when there is none.
[[nodiscard]] AnalyticBinCullCallback* installedOn(osg::Node& node);

/// What the callback culls by: its bin in the terrain's shape, skirts included.
[[nodiscard]] AnalyticBin culledBin(const AnalyticBinCullCallback& callback);

/// The names of tiles that a cull traversal reaches; they are noted by VisitRecorders named so, which are put on nodes
/// before bins are installed.
class ReachedTiles {
public:
    void watch(osg::Node& node, const std::string& name);
    [[nodiscard]] const std::set<std::string>& in(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& center,
                                                  double fovDeg);

private:
    std::set<std::string> _names;
};

/// Degrees and metres to ECEF on WGS 84.
[[nodiscard]] osg::Vec3d ecefDeg(double latitude, double longitude, double altitude);

}  // namespace osgAnalyticBin::test
