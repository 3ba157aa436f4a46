// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases as other builders make them: without stored bins.

#pragma once

#include "CullFixture.h"
#include "TileFixture.h"

#include <osg/PagedLOD>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

/// Extents in degrees; altitudes are all 0.
[[nodiscard]] inline core::GeodeticBin extentsDeg(double south, double north, double west, double east) {
    return core::GeodeticBin::fromDegrees({south, north}, {west, east}, {0, 0});
}

/// A terrain tile of one height; skirt in metres.
[[nodiscard]] inline osg::ref_ptr<osgTerrain::TerrainTile> makeFlatTile(const core::GeodeticBin& extents, float height,
                                                                        float skirt = 0.0f, unsigned int posts = 9) {
    osg::ref_ptr<osgTerrain::TerrainTile> tile =
        makeTerrainTile(extents, posts, posts, [height](unsigned int, unsigned int) { return height; });
    heightsOf(*tile).setSkirtHeight(skirt);
    return tile;
}

template <class Group>
osg::ref_ptr<Group> withChildren(Group* group, const std::vector<osg::ref_ptr<osg::Node>>& children) {
    for (const auto& child : children) group->addChild(child);
    return group;
}

/// A globe of these radii, WGS 84 by default, with these children.
[[nodiscard]] inline osg::ref_ptr<osg::CoordinateSystemNode> makeGlobe(
    const std::vector<osg::ref_ptr<osg::Node>>& children = {}, double equatorial = osg::WGS_84_RADIUS_EQUATOR,
    double polar = osg::WGS_84_RADIUS_POLAR) {
    osg::ref_ptr<osg::CoordinateSystemNode> globe = withChildren(new osg::CoordinateSystemNode, children);
    globe->setEllipsoidModel(new osg::EllipsoidModel(equatorial, polar));
    return globe;
}

[[nodiscard]] inline osg::ref_ptr<osg::Group> makeGroup(const std::vector<osg::ref_ptr<osg::Node>>& children) {
    return withChildren(new osg::Group, children);
}

[[nodiscard]] inline osg::ref_ptr<osg::MatrixTransform> makeTransform(
    const osg::Matrixd& matrix, const std::vector<osg::ref_ptr<osg::Node>>& children) {
    return withChildren(new osg::MatrixTransform(matrix), children);
}

/// A mesh of one height: a transform to the middle of the tile, a Geode and a Geometry with posts on a square grid.
[[nodiscard]] inline osg::ref_ptr<osg::MatrixTransform> makeMeshTile(const core::GeodeticBin& extents, double height,
                                                                     unsigned int posts = 9) {
    const osg::EllipsoidModel wgs84;
    const auto at = [&](double v, double u) {
        osg::Vec3d ecef;
        wgs84.convertLatLongHeightToXYZ(extents.latitude().lower + v * extents.latitude().width(),
                                        extents.longitude().lower + u * extents.longitude().width(), height, ecef.x(),
                                        ecef.y(), ecef.z());
        return ecef;
    };
    const osg::Vec3d center = at(0.5, 0.5);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (unsigned int j = 0; j < posts; ++j)
        for (unsigned int i = 0; i < posts; ++i)
            vertices->push_back(osg::Vec3(at(j / (posts - 1.0), i / (posts - 1.0)) - center));
    return placed(makeGeometry(vertices, gridTriangles(posts)), osg::Matrixd::translate(center));
}

/// A mesh, and a file for what is nearer than `cutoff` metres to the mesh's middle.
[[nodiscard]] inline osg::ref_ptr<osg::PagedLOD> makePaged(osg::Node* mesh, const std::string& file,
                                                           float cutoff = 1e6f) {
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    paged->setCenter(mesh->getBound().center());
    paged->addChild(mesh, cutoff, 1e10f);
    paged->setFileName(1, file);
    paged->setRange(1, 0.0f, cutoff);
    return paged;
}

/// Shows what is paged below the tile within so many metres, and its mesh beyond.
inline void setFinerWithin(osg::PagedLOD& paged, float distance) {
    paged.setRange(0, distance, 1e10f);
    paged.setRange(1, 0.0f, distance);
}

/// Puts content in the place where the pager would put that of the PagedLOD's file.
inline void putBelow(osg::PagedLOD& paged, osg::Node* content) {
    paged.addChild(content);
}

/// Takes what was paged in out again, as the DatabasePager does.
inline void pageOut(osg::PagedLOD& paged) {
    // its own removeChildren() forgets the file's name as well
    paged.osg::Group::removeChildren(1, paged.getNumChildren() - 1);
}

/// Writes a database of meshes 200 m high in three files: "root.osgb", 40 degrees wide; below it "children.osgb" with a
/// leaf in the south and a PagedLOD in the north; below that "single.osgb", a leaf that is the file's root.
/// `leafHeight` and `singleHeight`: of the leaves. Returns: the root's file; empty when it cannot be written.
[[nodiscard]] inline std::string writeMeshDatabase(const std::string& folder, double leafHeight, double singleHeight) {
    const auto whole = extentsDeg(10, 50, 0, 40);
    const auto south = extentsDeg(10, 30, 0, 40);
    const auto north = extentsDeg(30, 50, 0, 40);
    const auto root = makeGlobe({makePaged(makeMeshTile(whole, 200.0), "children.osgb", 1e9f)});
    const auto children =
        makeGroup({makeMeshTile(south, leafHeight), makePaged(makeMeshTile(north, 200.0), "single.osgb", 1e9f)});
    const std::string file = folder + "/root.osgb";
    const bool isWritten = osgDB::writeNodeFile(*root, file) &&
                           osgDB::writeNodeFile(*children, folder + "/children.osgb") &&
                           osgDB::writeNodeFile(*makeMeshTile(north, singleHeight), folder + "/single.osgb");
    return isWritten ? file : std::string();
}

/// Reads the first file that the PagedLOD names as the DatabasePager does. Returns: null when that fails.
[[nodiscard]] inline osg::ref_ptr<osg::Node> readBelow(osg::PagedLOD& paged) {
    return osgDB::readRefNodeFile(paged.getDatabasePath() + paged.getFileName(1),
                                  dynamic_cast<osgDB::Options*>(paged.getDatabaseOptions()));
}

/// The bin that is installed on the node itself. Returns: nullptr when there is none.
[[nodiscard]] inline AnalyticBinCullCallback* installedOn(osg::Node& node) {
    return dynamic_cast<AnalyticBinCullCallback*>(node.getCullCallback());
}

/// What the callback culls by: its bin in the terrain's shape, skirts included.
[[nodiscard]] inline AnalyticBin culledBin(const AnalyticBinCullCallback& callback) {
    const auto& shape = callback.getTerrainShape();
    AnalyticBin bin = shape ? callback.getBin().exaggerated(shape->verticalScale) : callback.getBin();
    const core::Interval altitude = bin.bin().altitude();
    bin.setBin(bin.bin().withAltitude({altitude.lower - callback.getSkirt(), altitude.upper}));
    return bin;
}

/// Degrees and metres to ECEF on WGS 84.
[[nodiscard]] inline osg::Vec3d ecefDeg(double latitude, double longitude, double altitude) {
    osg::Vec3d ecef;
    const osg::EllipsoidModel wgs84;
    wgs84.convertLatLongHeightToXYZ(osg::DegreesToRadians(latitude), osg::DegreesToRadians(longitude), altitude,
                                    ecef.x(), ecef.y(), ecef.z());
    return ecef;
}

}  // namespace osgAnalyticBin::test
