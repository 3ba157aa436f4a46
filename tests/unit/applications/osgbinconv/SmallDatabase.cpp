// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SmallDatabase.h"

#include <osg/CoordinateSystemNode>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgDB/WriteFile>

#include <filesystem>
#include <stdexcept>

namespace osgAnalyticBin::test {

osg::ref_ptr<osg::Node> makeSmallTile(const std::string& pagedFile, double westDeg) {
    constexpr int kPosts = 5;
    const osg::ref_ptr<osg::EllipsoidModel> ellipsoid = new osg::EllipsoidModel;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    const auto ecef = [&](int i, int k) {
        osg::Vec3d v;
        ellipsoid->convertLatLongHeightToXYZ(osg::DegreesToRadians(0.25 * k), osg::DegreesToRadians(westDeg + 0.25 * i),
                                             100.0, v.x(), v.y(), v.z());
        return v;
    };
    const osg::Vec3d origin = ecef(0, 0);
    for (int k = 0; k < kPosts; ++k) {
        for (int i = 0; i < kPosts; ++i) vertices->push_back(osg::Vec3(ecef(i, k) - origin));
    }
    for (int k = 0; k + 1 < kPosts; ++k) {
        for (int i = 0; i + 1 < kPosts; ++i) {
            const int a = k * kPosts + i;
            for (const int index : {a, a + 1, a + kPosts + 1, a, a + kPosts + 1, a + kPosts})
                triangles->push_back(static_cast<unsigned short>(index));
        }
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(triangles);
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    const osg::ref_ptr<osg::MatrixTransform> mesh = new osg::MatrixTransform(osg::Matrixd::translate(origin));
    mesh->addChild(geode);
    if (pagedFile.empty()) return mesh;
    const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->addChild(mesh, 1e6f, 1e10f);
    paged->setFileName(1, pagedFile);
    paged->setRange(1, 0.0f, 1e6f);
    return paged;
}

void writeSmallFile(const std::string& path, osg::Node& tile, bool isRoot) {
    osg::ref_ptr<osg::Node> node = &tile;
    if (isRoot) {
        const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
        root->setEllipsoidModel(new osg::EllipsoidModel);
        root->addChild(&tile);
        node = root;
    }
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    if (!osgDB::writeNodeFile(*node, path)) throw std::runtime_error("cannot write " + path);
}

}  // namespace osgAnalyticBin::test
