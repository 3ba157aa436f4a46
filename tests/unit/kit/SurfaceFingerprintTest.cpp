// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

osg::ref_ptr<osgTerrain::TerrainTile> makeTile() {
    return makeTerrainTile(core::GeodeticBin::fromDegrees({0, 45}, {0, 90}, {0, 0}), 17, 13,
                           [](unsigned int i, unsigned int j) { return static_cast<float>(100 * i + j); });
}

osg::ref_ptr<osg::Geometry> makeMesh() {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec2Array> texCoords = new osg::Vec2Array;
    const osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (int i = 0; i < 50; ++i) {
        vertices->push_back(osg::Vec3(6378137.0f, 7.0f * static_cast<float>(i), static_cast<float>(i * i)));
        texCoords->push_back(osg::Vec2(0.02f * static_cast<float>(i), 0.5f));
        for (int k = 0; k < 3; ++k) triangles->push_back(static_cast<GLushort>((i + k) % 50));
    }
    geometry->setVertexArray(vertices);
    geometry->setTexCoordArray(0, texCoords);
    geometry->addPrimitiveSet(triangles);
    return geometry;
}

std::uint64_t fingerprintOf(osg::Node& node) {
    return surfaceFingerprint(node, osg::Matrixd());
}

// Indexes keep fingerprints: a change of the function is a change of their format.
TEST(SurfaceFingerprint, StaysAsItIs) {
    EXPECT_EQ(fingerprintOf(*makeTile()), 3446540989968547260u);
    EXPECT_EQ(fingerprintOf(*makeMesh()), 1996310240858576859u);
    const osg::ref_ptr<osg::Group> empty = new osg::Group;
    EXPECT_NE(fingerprintOf(*empty), 0u);
}

TEST(SurfaceFingerprint, TellsEveryPostOfATerrainTile) {
    std::set<std::uint64_t> seen{fingerprintOf(*makeTile())};
    for (unsigned int i = 0; i < 17; ++i) {
        for (unsigned int j = 0; j < 13; ++j) {
            const auto tile = makeTile();
            auto& layer = static_cast<osgTerrain::HeightFieldLayer&>(*tile->getElevationLayer());
            layer.getHeightField()->setHeight(i, j, -layer.getHeightField()->getHeight(i, j) - 0.001f);
            EXPECT_TRUE(seen.insert(fingerprintOf(*tile)).second) << i << " " << j;
        }
    }
    auto tile = makeTile();
    tile->getElevationLayer()->getLocator()->setTransformAsExtents(0, 0, 1, 1);
    EXPECT_TRUE(seen.insert(fingerprintOf(*tile)).second);
    tile = makeTile();
    static_cast<osgTerrain::HeightFieldLayer&>(*tile->getElevationLayer()).getHeightField()->setSkirtHeight(1.0f);
    EXPECT_TRUE(seen.insert(fingerprintOf(*tile)).second);
    EXPECT_TRUE(seen.insert(surfaceFingerprint(*makeTile(), osg::Matrixd::translate(0, 0, 1))).second);
    for (const float noData : {-1.0f, 3.0f, 4.0f}) {
        tile = makeTile();
        tile->getElevationLayer()->setValidDataOperator(new osgTerrain::NoDataValue(noData));
        EXPECT_TRUE(seen.insert(fingerprintOf(*tile)).second) << noData;
    }
    tile = makeTile();
    tile->getElevationLayer()->getLocator()->setEllipsoidModel(new osg::EllipsoidModel(6378137.0, 6356752.0));
    EXPECT_TRUE(seen.insert(fingerprintOf(*tile)).second);
}

TEST(SurfaceFingerprint, TellsEveryVertexAndIndexOfAMesh) {
    std::set<std::uint64_t> seen{fingerprintOf(*makeMesh())};
    for (unsigned int i = 0; i < 50; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto mesh = makeMesh();
            float& value = static_cast<osg::Vec3Array&>(*mesh->getVertexArray())[i][axis];
            value = std::nextafter(value, 1e9f);
            EXPECT_TRUE(seen.insert(fingerprintOf(*mesh)).second);
        }
        const auto mesh = makeMesh();
        static_cast<osg::DrawElementsUShort&>(*mesh->getPrimitiveSet(0))[3 * i] = 49;
        EXPECT_EQ(seen.insert(fingerprintOf(*mesh)).second, i != 49);
    }
}

TEST(SurfaceFingerprint, TellsWhereABillboardsDrawablesStand) {
    const osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
    for (int i = 0; i < 3; ++i) billboard->addDrawable(makeMesh(), osg::Vec3(1.0f, 2.0f, 3.0f));
    std::set<std::uint64_t> seen{fingerprintOf(*billboard)};
    for (unsigned int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            billboard->getPositionList()[i][axis] += 1.0f;
            EXPECT_TRUE(seen.insert(fingerprintOf(*billboard)).second);
        }
    }
    static_cast<osg::Vec3Array&>(*billboard->getDrawable(2)->asGeometry()->getVertexArray())[0].x() += 1.0f;
    EXPECT_TRUE(seen.insert(fingerprintOf(*billboard)).second);
}

TEST(SurfaceFingerprint, TellsSignsThatChangeTogether) {
    std::set<std::uint64_t> seen{fingerprintOf(*makeMesh())};
    for (unsigned int i = 0; i < 50; ++i) {
        for (unsigned int j = i + 1; j < 50; ++j) {
            const auto mesh = makeMesh();
            auto& vertices = static_cast<osg::Vec3Array&>(*mesh->getVertexArray());
            vertices[i] = -vertices[i];
            vertices[j] = -vertices[j];
            EXPECT_TRUE(seen.insert(fingerprintOf(*mesh)).second) << i << " " << j;
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
