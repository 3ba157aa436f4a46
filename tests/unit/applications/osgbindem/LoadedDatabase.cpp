// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "LoadedDatabase.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <TileFixture.h>
#include <map>
#include <support/AnyScene.h>
#include <tuple>

namespace {

using osgAnalyticBin::core::Ellipsoid;
using osgAnalyticBin::test::metresOutside;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kStartTile = 22.5 * kDegree;
// Of packed tiles: two steps of the start tiles' vertices.
constexpr double kPackedMargin = 0.26;

LoadedTile loadTile(osg::Node& node, int level, int x, int y) {
    LoadedTile tile;
    tile.level = level;
    tile.x = x;
    tile.y = y;
    tile.node = &node;
    tile.bin = osgAnalyticBin::storedBin(node);
    auto& transform = dynamic_cast<osg::MatrixTransform&>(*node.asGroup()->getChild(0));
    tile.geometry = dynamic_cast<osg::Geometry*>(transform.getChild(0));
    if (!tile.geometry) throw std::runtime_error("a tile has no geometry");
    for (const osg::Vec3& v : dynamic_cast<osg::Vec3Array&>(*tile.geometry->getVertexArray())) {
        const osg::Vec3d ecef = osg::Vec3d(v) * transform.getMatrix();
        tile.vertices.emplace_back(ecef.x(), ecef.y(), ecef.z());
    }
    tile.cells = static_cast<int>(std::lround(std::sqrt(static_cast<double>(tile.vertices.size()) + 4.0))) - 3;
    const osg::PagedLOD* lod = tile.lod();
    if (!lod) return tile;
    const osg::ref_ptr<osg::Node> file = osgDB::readRefNodeFile(lod->getDatabasePath() + lod->getFileName(1));
    if (!file || !file->asGroup() || file->asGroup()->getNumChildren() != 4)
        throw std::runtime_error("no four children in " + lod->getFileName(1));
    for (int i = 0; i < 4; ++i)
        tile.children.push_back(loadTile(*file->asGroup()->getChild(static_cast<unsigned int>(i)), level + 1,
                                         2 * x + i % 2, 2 * y + i / 2));
    return tile;
}

void visitAll(const LoadedTile& tile, const std::function<void(const LoadedTile&)>& visit) {
    visit(tile);
    for (const LoadedTile& child : tile.children) visitAll(child, visit);
}

std::string nameOf(const LoadedTile& tile) {
    return "L" + std::to_string(tile.level) + " X" + std::to_string(tile.x) + " Y" + std::to_string(tile.y);
}

void checkHoldsMesh(const LoadedTile& tile, const Ellipsoid& ellipsoid) {
    double worst = metresOutside(tile.bin, tile.vertices, ellipsoid);
    const auto& triangles = dynamic_cast<osg::DrawElementsUShort&>(*tile.geometry->getPrimitiveSet(0));
    ASSERT_EQ(triangles.size() % 3, 0U);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const glm::dvec3& a = tile.vertices.at(triangles[i]);
        const glm::dvec3& b = tile.vertices.at(triangles[i + 1]);
        const glm::dvec3& c = tile.vertices.at(triangles[i + 2]);
        for (const glm::dvec3& p : {(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)})
            worst = std::max(worst, metresOutside(tile.bin, p, ellipsoid));
    }
    EXPECT_LE(worst, tile.bin.margin() + 1e-7) << nameOf(tile);
    const bool touchesPole = tile.y == 0 || tile.y == (8 << tile.level) - 1;
    EXPECT_LE(tile.bin.margin(), (touchesPole ? 1.1 : 0.01) + kPackedMargin) << nameOf(tile);
}

/// The altitudes that the tile and all tiles below draw, with the sag of their chords, and the source.
Range needed(const LoadedTile& tile, const Ellipsoid& ellipsoid, Range range) {
    const double sag =
        ellipsoid.equatorialRadius() * (1.0 - std::cos(0.5 * std::ldexp(kStartTile / tile.cells, -tile.level)));
    for (const glm::dvec3& vertex : tile.vertices) {
        const double altitude = ellipsoid.toGeodetic(vertex).altitude;
        range.include(altitude);
        range.include(altitude - 2.5 * sag);
    }
    for (const LoadedTile& child : tile.children) {
        range.include(child.altitude().lower);
        range.include(child.altitude().upper);
    }
    return range;
}

void checkTight(const LoadedTile& tile, const Range& range) {
    constexpr double kOfBounds = 0.5;  // what core::MeshBounds may be too wide by
    EXPECT_GE(tile.altitude().lower, range.lower - kOfBounds) << nameOf(tile);
    EXPECT_LE(tile.altitude().upper, range.upper + kOfBounds) << nameOf(tile);
    // Chords run poleward of their parallel, skirts lean; neither amounts to much.
    const Rect rect = tile.rect();
    const double size = rect.north - rect.south;
    const auto& latitude = tile.bin.bin().latitude();
    EXPECT_GE(latitude.lower, (rect.south - 0.01 * size) * kDegree) << nameOf(tile);
    EXPECT_LE(latitude.upper, (rect.north + 0.01 * size) * kDegree) << nameOf(tile);
    EXPECT_LE(tile.bin.bin().longitude().width(), 1.01 * size * kDegree) << nameOf(tile);
}

/// Bins hold the source, the drawn triangles and the bins below, and are not much larger.
void checkBin(const LoadedTile& tile, const Ellipsoid& ellipsoid, const Range& source) {
    ASSERT_TRUE(tile.bin.valid()) << nameOf(tile);
    checkHoldsMesh(tile, ellipsoid);
    EXPECT_LE(tile.altitude().lower, source.lower) << nameOf(tile);
    EXPECT_GE(tile.altitude().upper, source.upper) << nameOf(tile);
    for (const LoadedTile& child : tile.children) {
        EXPECT_TRUE(tile.bin.contains(child.bin)) << nameOf(child);
        EXPECT_GE(tile.bin.margin(), child.bin.margin()) << nameOf(child);
    }
    checkTight(tile, needed(tile, ellipsoid, source));
}

using PostKey = std::tuple<int, long, long>;

void checkEdgePosts(const LoadedTile& tile, std::map<PostKey, glm::dvec3>& posts) {
    const long columns = (16L << tile.level) * tile.cells;
    for (int row = 0; row <= tile.cells; ++row) {
        for (int column = 0; column <= tile.cells; ++column) {
            if (row % tile.cells != 0 && column % tile.cells != 0) continue;
            const long y = static_cast<long>(tile.y) * tile.cells + row;
            const bool isPole = y == 0 || y == columns / 2;
            const long x = isPole ? 0 : (static_cast<long>(tile.x) * tile.cells + column) % columns;
            const glm::dvec3& known = posts.emplace(PostKey{tile.level, x, y}, tile.post(column, row)).first->second;
            EXPECT_EQ(known, tile.post(column, row)) << nameOf(tile) << " column " << column << " row " << row;
        }
    }
}

void checkChildPosts(const LoadedTile& parent) {
    constexpr double kRounding = 0.25;  // twice the coarsest step to which vertices are rounded
    const int half = parent.cells / 2;
    for (std::size_t i = 0; i < parent.children.size(); ++i) {
        const LoadedTile& child = parent.children[i];
        for (int row = 0; row <= half; ++row) {
            for (int column = 0; column <= half; ++column) {
                const glm::dvec3& own = parent.post(column + (i % 2 == 1 ? half : 0), row + (i / 2 == 1 ? half : 0));
                ASSERT_LE(glm::distance(own, child.post(2 * column, 2 * row)), kRounding) << nameOf(child);
            }
        }
    }
}

void checkNode(const osg::Node& node) {
    EXPECT_TRUE(node.getCullingActive());
    EXPECT_EQ(node.getNumChildrenWithCullingDisabled(), 0U);
    EXPECT_EQ(node.getCullCallback(), nullptr);
    EXPECT_STREQ(node.libraryName(), "osg");
    if (!node.asDrawable()) return;
    EXPECT_TRUE(node.asDrawable()->getUseVertexBufferObjects());
    EXPECT_FALSE(node.asDrawable()->getUseDisplayList());
}

void checkLod(const LoadedTile& tile) {
    const osg::PagedLOD& lod = *tile.lod();
    EXPECT_EQ(lod.getCenterMode(), osg::LOD::USER_DEFINED_CENTER);
    EXPECT_EQ(lod.getMinRange(0), lod.getMaxRange(1));
    EXPECT_EQ(lod.getMinRange(1), 0.0F);
    EXPECT_EQ(lod.getMaxRange(0), 1e10F);
    const osg::Vec3d middle = lod.getCenter();
    visitAll(tile, [&](const LoadedTile& below) {
        for (const glm::dvec3& v : below.vertices)
            ASSERT_LE((osg::Vec3d(v.x, v.y, v.z) - middle).length(), lod.getRadius()) << nameOf(tile);
    });
}

}  // namespace

Rect LoadedTile::rect() const {
    const double size = std::ldexp(22.5, -level);
    return {-180.0 + x * size, -90.0 + y * size, -180.0 + (x + 1) * size, -90.0 + (y + 1) * size};
}

Ellipsoid LoadedDatabase::ellipsoid() const {
    return {root->getEllipsoidModel()->getRadiusEquator(), root->getEllipsoidModel()->getRadiusPolar()};
}

void LoadedDatabase::forEach(const std::function<void(const LoadedTile&)>& visit) const {
    for (const LoadedTile& tile : tiles) visitAll(tile, visit);
}

int LoadedDatabase::deepestLevel() const {
    int deepest = 0;
    forEach([&deepest](const LoadedTile& tile) { deepest = std::max(deepest, tile.level); });
    return deepest;
}

const LoadedTile& LoadedDatabase::leafAt(double latitudeDeg, double longitudeDeg) const {
    const LoadedTile* found = nullptr;
    forEach([&](const LoadedTile& tile) {
        const Rect r = tile.rect();
        const bool isThere =
            latitudeDeg >= r.south && latitudeDeg <= r.north && longitudeDeg >= r.west && longitudeDeg <= r.east;
        if (isThere && tile.children.empty()) found = &tile;
    });
    if (!found) throw std::runtime_error("no tile there");
    return *found;
}

double LoadedDatabase::altitudeAt(double latitudeDeg, double longitudeDeg) const {
    const LoadedTile& tile = leafAt(latitudeDeg, longitudeDeg);
    const Rect rect = tile.rect();
    const double spacing = (rect.north - rect.south) / tile.cells;
    const auto column = std::lround((longitudeDeg - rect.west) / spacing);
    const auto row = std::lround((latitudeDeg - rect.south) / spacing);
    return ellipsoid().toGeodetic(tile.post(static_cast<int>(column), static_cast<int>(row))).altitude;
}

LoadedDatabase loadDatabase(const std::string& rootFile) {
    osgDB::Registry::instance()->getLibraryFilePathList().push_front(OSGBINDEM_LIBRARY_FOLDER);
    LoadedDatabase database;
    database.root = dynamic_cast<osg::CoordinateSystemNode*>(osgDB::readRefNodeFile(rootFile).get());
    if (!database.root || database.root->getNumChildren() == 0) throw std::runtime_error("no database in " + rootFile);
    for (unsigned int i = 0; i < database.root->getNumChildren(); ++i) {
        osg::Node& start = *database.root->getChild(i);
        const auto bin = osgAnalyticBin::storedBin(start).bin();
        const int level = static_cast<int>(std::lround(std::log2(kStartTile / bin.latitude().width())));
        const double size = std::ldexp(kStartTile, -level);
        const int columns = 16 << level;
        const int x = static_cast<int>(std::floor((bin.longitude().middle() + 8.0 * kStartTile) / size));
        const int y = static_cast<int>(std::floor((bin.latitude().middle() + 4.0 * kStartTile) / size));
        database.tiles.push_back(loadTile(start, level, (x + columns) % columns, y));
    }
    return database;
}

void checkDatabase(const LoadedDatabase& database, const SourceRange& source) {
    const Ellipsoid ellipsoid = database.ellipsoid();
    database.forEach([&](const LoadedTile& tile) { checkBin(tile, ellipsoid, source(tile.rect())); });
    checkSharedPosts(database);
    checkNodes(database);
}

void checkDatabase(const LoadedDatabase& database, const TestRaster& source) {
    checkDatabase(database, [&source](const Rect& rect) { return source.range(rect); });
}

void checkSharedPosts(const LoadedDatabase& database) {
    std::map<PostKey, glm::dvec3> posts;
    database.forEach([&posts](const LoadedTile& tile) {
        checkEdgePosts(tile, posts);
        checkChildPosts(tile);
    });
}

void checkNodes(const LoadedDatabase& database) {
    EXPECT_NE(dynamic_cast<osgAnalyticBin::InstallBinsCallback*>(database.root->getUpdateCallback()), nullptr);
    database.forEach([](const LoadedTile& tile) {
        osgAnalyticBin::test::visitNodes(*tile.node, checkNode);
        EXPECT_EQ(tile.node->getUpdateCallback(), nullptr);
        EXPECT_TRUE(osgAnalyticBin::hasStoredBin(*tile.node));
        if (tile.lod()) {
            checkLod(tile);
        } else {
            EXPECT_STREQ(tile.node->className(), "Group") << nameOf(tile);
        }
    });
}
