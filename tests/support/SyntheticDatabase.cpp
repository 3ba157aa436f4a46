// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <cfloat>
#include <cmath>
#include <support/GridMesh.h>
#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin::test {

namespace {

constexpr int kLevels = 3;
constexpr int kColumns = 8;
constexpr int kRows = 4;
constexpr unsigned int kPosts = 17;
constexpr double kHill = 3000.0;
// A mesh of 2.8 degrees between posts sags 3.8 km below the ellipsoid along its diagonals.
constexpr double kLowest = -12000.0;
// A tile is refined nearer than this many of its radii.
constexpr double kRefineRadii = 2.5;
const double kRadiansPerDegree = osg::PI / 180.0;

struct Address {
    int level = 0;
    int row = 0;
    int column = 0;

    [[nodiscard]] double widthDeg() const { return 360.0 / kColumns / (1 << level); }
    [[nodiscard]] double southDeg() const { return -90.0 + row * widthDeg(); }
    [[nodiscard]] double westDeg() const { return -180.0 + column * widthDeg(); }
};

AnalyticBin binOf(const Address& tile) {
    const double south = tile.southDeg(), west = tile.westDeg(), width = tile.widthDeg();
    // the chord between two posts of a parallel runs poleward of it by up to 0.25 t2 for posts t radians apart
    const double step = width / (kPosts - 1);
    const double bulge = 0.25 * step * step * kRadiansPerDegree;
    return AnalyticBin(
        core::GeodeticBin::fromDegrees({south - bulge, south + width + bulge}, {west, west + width}, {kLowest, kHill}),
        1.0);
}

osg::Vec3d ecefAt(const osg::EllipsoidModel& ellipsoid, double latitude, double longitude) {
    const double altitude = kHill * std::sin(20.0 * latitude) * std::cos(24.0 * longitude) * std::cos(latitude);
    osg::Vec3d ecef;
    ellipsoid.convertLatLongHeightToXYZ(latitude, longitude, altitude, ecef.x(), ecef.y(), ecef.z());
    return ecef;
}

osg::Vec4 colourAt(const Address& tile, unsigned int i, unsigned int j) {
    const bool dark = ((i / 2u) + (j / 2u)) % 2u == 1u;
    const float brightness = dark ? 0.6f : 1.0f;
    return {brightness * (0.3f + 0.3f * static_cast<float>(tile.level)), brightness * 0.7f,
            brightness * (tile.row % 2 == tile.column % 2 ? 0.3f : 0.9f), 1.0f};
}

osg::ref_ptr<osg::Node> geometryOf(const Address& tile, const osg::EllipsoidModel& ellipsoid) {
    const osg::Vec3d center = binOf(tile).center(ellipsoid);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    const osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
    const double step = tile.widthDeg() / (kPosts - 1);
    for (unsigned int j = 0; j < kPosts; ++j) {
        for (unsigned int i = 0; i < kPosts; ++i) {
            const osg::Vec3d ecef = ecefAt(ellipsoid, (tile.southDeg() + j * step) * kRadiansPerDegree,
                                           (tile.westDeg() + i * step) * kRadiansPerDegree);
            osg::Vec3d normal = ecef;
            normal.normalize();
            vertices->push_back(osg::Vec3(ecef - center));
            normals->push_back(osg::Vec3(normal));
            colours->push_back(colourAt(tile, i, j));
        }
    }
    const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(vertices, gridTriangles(kPosts));
    geometry->setNormalArray(normals);
    geometry->setColorArray(colours);
    return placed(geometry, osg::Matrixd::translate(center));
}

// The file with the tile's four quarters.
std::string fileOf(const Address& tile) {
    return "tiles_" + std::to_string(tile.level) + "_" + std::to_string(tile.row) + "_" + std::to_string(tile.column) +
           ".osgb";
}

osg::ref_ptr<osg::Node> nodeOf(const Address& tile, const osg::EllipsoidModel& ellipsoid) {
    const osg::BoundingSphere sphere = binOf(tile).boundingSphere(ellipsoid);
    const bool leaf = tile.level + 1 == kLevels;
    const auto refineDistance = static_cast<float>(kRefineRadii * static_cast<double>(sphere.radius()));
    osg::ref_ptr<osg::PagedLOD> node = new osg::PagedLOD;
    node->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    node->setCenter(sphere.center());
    node->setRadius(sphere.radius());
    node->addChild(geometryOf(tile, ellipsoid), leaf ? 0.0f : refineDistance, FLT_MAX);
    if (!leaf) {
        node->setFileName(1, fileOf(tile));
        node->setRange(1, 0.0f, refineDistance);
    }
    setStoredBin(*node, binOf(tile));
    return node;
}

bool writeQuarters(const Address& tile, const osg::EllipsoidModel& ellipsoid, const std::string& folder) {
    const osg::ref_ptr<osg::Group> quarters = new osg::Group;
    for (int i = 0; i < 4; ++i)
        quarters->addChild(nodeOf({tile.level + 1, 2 * tile.row + i / 2, 2 * tile.column + i % 2}, ellipsoid));
    return osgDB::writeNodeFile(*quarters, folder + "/" + fileOf(tile));
}

bool writeFiner(const osg::EllipsoidModel& ellipsoid, const std::string& folder) {
    for (int level = 0; level + 1 < kLevels; ++level)
        for (int row = 0; row < kRows << level; ++row)
            for (int column = 0; column < kColumns << level; ++column)
                if (!writeQuarters({level, row, column}, ellipsoid, folder)) return false;
    return true;
}

}  // namespace

std::string writeSyntheticDatabase(const std::string& folder) {
    const osg::ref_ptr<osg::EllipsoidModel> ellipsoid = new osg::EllipsoidModel;
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(ellipsoid);
    root->setUpdateCallback(new InstallBinsCallback);
    // writing the request needs our serializer
    osgDB::Registry::instance()->getLibraryFilePathList().push_front(LIBRARY_FOLDER);
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) root->addChild(nodeOf({0, row, column}, *ellipsoid));
    const std::string file = folder + "/globe.osgb";
    return osgDB::writeNodeFile(*root, file) && writeFiner(*ellipsoid, folder) ? file : std::string();
}

}  // namespace osgAnalyticBin::test
