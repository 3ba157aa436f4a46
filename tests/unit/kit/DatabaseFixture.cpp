// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseFixture.h"

#include "CullFixture.h"
#include "TileFixture.h"

#include <osgAnalyticBin/Declarations.h>

#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgTerrain/Layer>

#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

core::GeodeticBin extentsDeg(double south, double north, double west, double east) {
    return core::GeodeticBin::fromDegrees({south, north}, {west, east}, {0, 0});
}

osg::ref_ptr<osgTerrain::TerrainTile> makeFlatTile(const core::GeodeticBin& extents, float height, float skirt,
                                                   unsigned int posts) {
    osg::ref_ptr<osgTerrain::TerrainTile> tile =
        makeTerrainTile(extents, posts, posts, [height](unsigned int, unsigned int) { return height; });
    static_cast<osgTerrain::HeightFieldLayer*>(tile->getElevationLayer())->getHeightField()->setSkirtHeight(skirt);
    return tile;
}

osg::ref_ptr<osg::CoordinateSystemNode> makeGlobe(const std::vector<osg::ref_ptr<osg::Node>>& children) {
    osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    globe->setEllipsoidModel(new osg::EllipsoidModel);
    for (const auto& child : children) globe->addChild(child);
    return globe;
}

osg::ref_ptr<osg::Group> makeGroup(const std::vector<osg::ref_ptr<osg::Node>>& children) {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const auto& child : children) group->addChild(child);
    return group;
}

osg::ref_ptr<osg::MatrixTransform> makeMeshTile(const core::GeodeticBin& extents, double height, unsigned int posts) {
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

osg::ref_ptr<osg::PagedLOD> makePaged(osg::Node* mesh, const std::string& file, float cutoff) {
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    paged->setCenter(mesh->getBound().center());
    paged->addChild(mesh, cutoff, 1e10f);
    paged->setFileName(1, file);
    paged->setRange(1, 0.0f, cutoff);
    return paged;
}

void setFinerWithin(osg::PagedLOD& paged, float distance) {
    paged.setRange(0, distance, 1e10f);
    paged.setRange(1, 0.0f, distance);
}

void putBelow(osg::PagedLOD& paged, osg::Node* content) {
    paged.addChild(content);
}

void pageOut(osg::PagedLOD& paged) {
    // its own removeChildren() forgets the file's name as well
    paged.osg::Group::removeChildren(1, paged.getNumChildren() - 1);
}

std::string writeMeshDatabase(const std::string& folder, double leafHeight, double singleHeight) {
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

osg::ref_ptr<osg::Node> readBelow(osg::PagedLOD& paged) {
    return osgDB::readRefNodeFile(paged.getDatabasePath() + paged.getFileName(1),
                                  dynamic_cast<osgDB::Options*>(paged.getDatabaseOptions()));
}

AnalyticBinCullCallback* installedOn(osg::Node& node) {
    return dynamic_cast<AnalyticBinCullCallback*>(node.getCullCallback());
}

AnalyticBin culledBin(const AnalyticBinCullCallback& callback) {
    const auto& shape = callback.getTerrainShape();
    AnalyticBin bin = shape ? callback.getBin().exaggerated(shape->verticalScale) : callback.getBin();
    const core::Interval altitude = bin.bin().altitude();
    bin.setBin(bin.bin().withAltitude({altitude.lower - callback.getSkirt(), altitude.upper}));
    return bin;
}

void ReachedTiles::watch(osg::Node& node, const std::string& name) {
    const osg::ref_ptr<VisitRecorder> recorder = new VisitRecorder(name, _names);
    setTraversesAlways(*recorder);
    node.setCullCallback(recorder);
}

const std::set<std::string>& ReachedTiles::in(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& center,
                                              double fovDeg) {
    _names.clear();
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    osg::Vec3d up = eye ^ center;
    if (up.length2() == 0.0) up.set(0, 0, 1);
    (void)cull(scene, CullView::lookAt(eye, center, up, fovDeg), *visitor);
    return _names;
}

osg::Vec3d ecefDeg(double latitude, double longitude, double altitude) {
    osg::Vec3d ecef;
    const osg::EllipsoidModel wgs84;
    wgs84.convertLatLongHeightToXYZ(osg::DegreesToRadians(latitude), osg::DegreesToRadians(longitude), altitude,
                                    ecef.x(), ecef.y(), ecef.z());
    return ecef;
}

}  // namespace osgAnalyticBin::test
