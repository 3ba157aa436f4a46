// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Surfaces of all tiles of two databases of VirtualPlanetBuilder, where these are at hand.

#include "TileFixture.h"

#include <osgAnalyticBin/TileSurface.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgTerrain/Layer>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace osgAnalyticBin::test {
namespace {

const osg::ref_ptr<osg::EllipsoidModel> kVpbModel = new osg::EllipsoidModel;
const core::Ellipsoid kVpbEllipsoid(kVpbModel->getRadiusEquator(), kVpbModel->getRadiusPolar());

// The meshes of a file: terrain tiles and the transforms above geometry.
class MeshFinder : public osg::NodeVisitor {
public:
    MeshFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override {
        if (dynamic_cast<osgTerrain::TerrainTile*>(&node)) {
            meshes.push_back(&node);
        } else {
            traverse(node);
        }
    }
    void apply(osg::MatrixTransform& node) override { meshes.push_back(&node); }

    std::vector<osg::ref_ptr<osg::Node>> meshes;
};

std::vector<osg::ref_ptr<osg::Node>> meshesOf(const std::string& database) {
    const std::string folder = std::string(SAMPLE_DATA) + "/vpb/" + database;
    std::vector<std::string> files{folder + "/earth.osgb"};
    const std::string below = folder + "/earth_root_L0_X0_Y0";
    for (const std::string& name : osgDB::getDirectoryContents(below))
        if (osgDB::getFileExtension(name) == "osgb") files.push_back(osgDB::concatPaths(below, name));
    std::vector<osg::ref_ptr<osg::Node>> meshes;
    for (const std::string& file : files) {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
        if (!node) continue;
        MeshFinder finder;
        node->accept(finder);
        meshes.insert(meshes.end(), finder.meshes.begin(), finder.meshes.end());
    }
    return meshes;
}

TEST(VpbSurface, HoldsEveryTerrainTile) {
    const auto meshes = meshesOf("terrain");
    if (meshes.empty()) GTEST_SKIP() << "no sample database";
    for (const auto& mesh : meshes) {
        const auto& tile = static_cast<osgTerrain::TerrainTile&>(*mesh);
        const TileSurface surface = tileSurface(*mesh, *kVpbModel, osg::Matrixd());
        ASSERT_TRUE(surface.bin.valid());
        const auto samples = samplesOf(drawnTriangles(tile, 1.0f).surface, 2);
        EXPECT_LE(metresOutside(surface.bin, samples, kVpbEllipsoid), surface.bin.margin());
        const auto& layer = static_cast<const osgTerrain::HeightFieldLayer&>(*tile.getElevationLayer());
        EXPECT_EQ(surface.skirt, static_cast<double>(layer.getHeightField()->getSkirtHeight()));
        EXPECT_GT(surface.skirt, 0.0);
    }
}

// The triangles of a mesh sorted by what VirtualPlanetBuilder's skirts are: the lower ones of vertices with the same
// texture coordinates, and what is joined to them.
struct SortedMesh {
    std::vector<EcefTriangle> surface;
    std::vector<EcefTriangle> skirts;
    core::Interval depths{std::numeric_limits<double>::infinity(), 0.0};
    double lean = 0.0;  // metres that skirts reach beyond the extents of the surface's vertices
};

SortedMesh sorted(osg::MatrixTransform& node) {
    auto& geometry = *node.getChild(0)->asGeode()->getDrawable(0)->asGeometry();
    const auto& vertices = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
    const auto& texCoords = static_cast<const osg::Vec2Array&>(*geometry.getTexCoordArray(0));
    std::vector<glm::dvec3> ecef;
    for (const osg::Vec3& v : vertices) {
        const osg::Vec3d w = osg::Vec3d(v) * node.getMatrix();
        ecef.emplace_back(w.x(), w.y(), w.z());
    }
    std::map<std::pair<float, float>, std::vector<std::size_t>> places;
    for (std::size_t i = 0; i < ecef.size(); ++i) places[{texCoords[i].x(), texCoords[i].y()}].push_back(i);
    SortedMesh result;
    std::vector<bool> isSkirt(ecef.size(), false);
    for (const auto& [place, same] : places) {
        if (same.size() < 2) continue;
        const double first = kVpbEllipsoid.toGeodetic(ecef[same[0]]).altitude;
        const double second = kVpbEllipsoid.toGeodetic(ecef[same[1]]).altitude;
        isSkirt[first < second ? same[0] : same[1]] = true;
        result.depths.lower = std::min(result.depths.lower, std::abs(first - second));
        result.depths.upper = std::max(result.depths.upper, std::abs(first - second));
    }
    AnalyticBin footprint;
    for (std::size_t i = 0; i < ecef.size(); ++i) {
        if (isSkirt[i]) continue;
        core::Geodetic position = kVpbEllipsoid.toGeodetic(ecef[i]);
        position.altitude = 0.0;
        if (std::hypot(ecef[i].x, ecef[i].y) > 1.0) footprint.expandBy(position);
    }
    for (std::size_t i = 0; i < ecef.size(); ++i) {
        if (!isSkirt[i]) continue;
        const AnalyticBin anyAltitude(footprint.bin().withAltitude({-1e7, 1e7}));
        if (std::hypot(ecef[i].x, ecef[i].y) > 1.0)
            result.lean = std::max(result.lean, metresOutside(anyAltitude, ecef[i], kVpbEllipsoid));
    }
    const osg::PrimitiveSet& triangles = *geometry.getPrimitiveSet(0);
    for (unsigned int i = 0; i + 2 < triangles.getNumIndices(); i += 3) {
        const unsigned int a = triangles.index(i), b = triangles.index(i + 1), c = triangles.index(i + 2);
        auto& kind = isSkirt[a] || isSkirt[b] || isSkirt[c] ? result.skirts : result.surface;
        kind.push_back({ecef[a], ecef[b], ecef[c]});
    }
    return result;
}

TEST(VpbSurface, HoldsEveryPolygonalTileWithoutItsSkirts) {
    const auto meshes = meshesOf("polygonal");
    if (meshes.empty()) GTEST_SKIP() << "no sample database";
    for (const auto& mesh : meshes) {
        auto& node = static_cast<osg::MatrixTransform&>(*mesh);
        const TileSurface surface = tileSurface(node, *kVpbModel, osg::Matrixd());
        ASSERT_TRUE(surface.bin.valid());
        const SortedMesh parts = sorted(node);
        const auto samples = samplesOf(parts.surface, 4);
        EXPECT_LE(metresOutside(surface.bin, samples, kVpbEllipsoid), surface.bin.margin());
        EXPECT_NEAR(surface.skirt, parts.depths.upper, 0.01 * surface.skirt);
        core::Interval seen{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
        for (const glm::dvec3& point : samples) {
            const double altitude = kVpbEllipsoid.toGeodetic(point).altitude;
            seen = {std::min(seen.lower, altitude), std::max(seen.upper, altitude)};
        }
        const core::Interval& found = surface.bin.bin().altitude();
        EXPECT_LE(found.upper - seen.upper, 1.0);
        EXPECT_LE(seen.lower - found.lower, surface.bin.sag() + 1.0);
        for (const double low : surface.edgeLow) EXPECT_GE(low, found.lower);
        // the surface's footprint holds its skirts, but for the rounding of floats
        EXPECT_LE(parts.lean, 1.0);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
