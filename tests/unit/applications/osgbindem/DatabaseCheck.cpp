// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseCheck.h"

#include "Program.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <osg/Texture2D>

#include <TileFixture.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace {

using osgAnalyticBin::core::Ellipsoid;
using osgAnalyticBin::test::metresOutside;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::string nameOf(const LoadedTile& tile) {
    return "L" + std::to_string(tile.level) + " X" + std::to_string(tile.x) + " Y" + std::to_string(tile.y);
}

/// The sag of a chord between two posts of the level.
double sag(const LoadedTile& tile, double radius) {
    const double step = std::ldexp(22.5 * kDegree / tile.cells, -tile.level);
    return radius * (1.0 - std::cos(0.5 * step));
}

// Of packed tiles: two steps of the start tiles' vertices.
constexpr double kPackedMargin = 0.26;

void checkHoldsMesh(const LoadedTile& tile, const Ellipsoid& ellipsoid) {
    const double allowed = tile.bin.margin() + 1e-7;
    double worst = 0.0;
    for (const glm::dvec3& vertex : tile.vertices) worst = std::max(worst, metresOutside(tile.bin, vertex, ellipsoid));
    const auto& triangles = dynamic_cast<osg::DrawElementsUShort&>(*tile.geometry->getPrimitiveSet(0));
    ASSERT_EQ(triangles.size() % 3, 0U);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const glm::dvec3& a = tile.vertices.at(triangles[i]);
        const glm::dvec3& b = tile.vertices.at(triangles[i + 1]);
        const glm::dvec3& c = tile.vertices.at(triangles[i + 2]);
        for (const glm::dvec3& p : {(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {
            worst = std::max(worst, metresOutside(tile.bin, p, ellipsoid));
        }
    }
    EXPECT_LE(worst, allowed) << nameOf(tile);
    EXPECT_LE(tile.bin.margin(), (tile.touchesPole() ? 1.1 : 0.01) + kPackedMargin) << nameOf(tile);
}

/// The altitudes that the tile and all tiles below draw, with the sag of their chords, and the source.
Range needed(const LoadedTile& tile, const Ellipsoid& ellipsoid, const SourceRange& source) {
    Range range = source(tile.rect());
    Range drawn;
    for (const glm::dvec3& vertex : tile.vertices) drawn.include(ellipsoid.toGeodetic(vertex).altitude);
    range.include(drawn.lower - 2.5 * sag(tile, ellipsoid.equatorialRadius()));
    range.include(drawn.upper);
    for (const LoadedTile& child : tile.children) {
        range.include(child.bin.bin().altitude().lower);
        range.include(child.bin.bin().altitude().upper);
    }
    return range;
}

void checkTight(const LoadedTile& tile, const Ellipsoid& ellipsoid, const SourceRange& source) {
    constexpr double kOfBounds = 0.5;  // what core::MeshBounds may be too wide by
    const Range range = needed(tile, ellipsoid, source);
    EXPECT_GE(tile.bin.bin().altitude().lower, range.lower - kOfBounds) << nameOf(tile);
    EXPECT_LE(tile.bin.bin().altitude().upper, range.upper + kOfBounds) << nameOf(tile);
    // Chords run poleward of their parallel, skirts lean; neither amounts to much.
    const Rect rect = tile.rect();
    const double size = rect.north - rect.south;
    const auto& latitude = tile.bin.bin().latitude();
    EXPECT_GE(latitude.lower, (rect.south - 0.01 * size) * kDegree) << nameOf(tile);
    EXPECT_LE(latitude.upper, (rect.north + 0.01 * size) * kDegree) << nameOf(tile);
    EXPECT_LE(tile.bin.bin().longitude().width(), 1.01 * size * kDegree) << nameOf(tile);
}

using PostKey = std::tuple<int, long, long>;

void collect(const LoadedTile& tile, std::map<PostKey, glm::dvec3>& posts) {
    const long columns = (16L << tile.level) * tile.cells;
    const long rows = columns / 2;
    for (int row = 0; row <= tile.cells; ++row) {
        for (int column = 0; column <= tile.cells; ++column) {
            const bool isEdge = row == 0 || column == 0 || row == tile.cells || column == tile.cells;
            if (!isEdge) continue;
            const long y = static_cast<long>(tile.y) * tile.cells + row;
            const bool isPole = y == 0 || y == rows;
            const long x = isPole ? 0 : (static_cast<long>(tile.x) * tile.cells + column) % columns;
            const auto [place, isNew] = posts.emplace(PostKey{tile.level, x, y}, tile.post(column, row));
            if (!isNew) {
                EXPECT_EQ(glm::distance(place->second, tile.post(column, row)), 0.0)
                    << nameOf(tile) << " column " << column << " row " << row;
            }
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

class NodeCheck : public osg::NodeVisitor {
public:
    NodeCheck() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override {
        EXPECT_TRUE(node.getCullingActive());
        EXPECT_EQ(node.getNumChildrenWithCullingDisabled(), 0U);
        EXPECT_EQ(node.getCullCallback(), nullptr);
        EXPECT_STREQ(node.libraryName(), "osg");
        if (node.asDrawable() != nullptr) {
            EXPECT_TRUE(node.asDrawable()->getUseVertexBufferObjects());
            EXPECT_FALSE(node.asDrawable()->getUseDisplayList());
        }
        traverse(node);
    }
};

void checkLod(const LoadedTile& tile) {
    const osg::PagedLOD& lod = *tile.lod();
    EXPECT_EQ(lod.getCenterMode(), osg::LOD::USER_DEFINED_CENTER);
    EXPECT_EQ(lod.getMinRange(0), lod.getMaxRange(1));
    EXPECT_EQ(lod.getMinRange(1), 0.0F);
    EXPECT_EQ(lod.getMaxRange(0), 1e10F);
    const osg::Vec3d middle = lod.getCenter();
    const std::function<void(const LoadedTile&)> check = [&](const LoadedTile& below) {
        for (const glm::dvec3& v : below.vertices) {
            ASSERT_LE((osg::Vec3d(v.x, v.y, v.z) - middle).length(), static_cast<double>(lod.getRadius()))
                << nameOf(tile);
        }
        for (const LoadedTile& child : below.children) check(child);
    };
    check(tile);
}

}  // namespace

LoadedDatabase databaseOf(std::vector<std::string> words) {
    const TempFolder folder;
    words.insert(words.end(), {"-o", folder.file("earth.osgb")});
    build(words);
    return loadDatabase(folder.file("earth.osgb"));
}

LoadedDatabase databaseOf(const TestRaster& raster, std::vector<std::string> options) {
    const TempFolder folder;
    raster.write(folder.file("raster.tif"));
    options.insert(options.begin(), folder.file("raster.tif"));
    return databaseOf(options);
}

void checkBins(const LoadedDatabase& database, const SourceRange& source) {
    const Ellipsoid ellipsoid = database.ellipsoid();
    database.forEach([&](const LoadedTile& tile) {
        ASSERT_TRUE(tile.bin.valid()) << nameOf(tile);
        checkHoldsMesh(tile, ellipsoid);
        const Range range = source(tile.rect());
        EXPECT_LE(tile.bin.bin().altitude().lower, range.lower) << nameOf(tile);
        EXPECT_GE(tile.bin.bin().altitude().upper, range.upper) << nameOf(tile);
        for (const LoadedTile& child : tile.children) {
            EXPECT_TRUE(tile.bin.contains(child.bin)) << nameOf(child);
            EXPECT_GE(tile.bin.margin(), child.bin.margin()) << nameOf(child);
        }
        checkTight(tile, ellipsoid, source);
    });
}

void checkSharedPosts(const LoadedDatabase& database) {
    std::map<PostKey, glm::dvec3> posts;
    database.forEach([&posts](const LoadedTile& tile) {
        collect(tile, posts);
        checkChildPosts(tile);
    });
}

void checkNodes(const LoadedDatabase& database) {
    EXPECT_NE(dynamic_cast<osgAnalyticBin::InstallBinsCallback*>(database.root->getUpdateCallback()), nullptr);
    database.forEach([](const LoadedTile& tile) {
        NodeCheck check;
        tile.node->accept(check);
        EXPECT_EQ(tile.node->getUpdateCallback(), nullptr);
        EXPECT_TRUE(osgAnalyticBin::hasStoredBin(*tile.node));
        if (tile.lod() != nullptr) {
            checkLod(tile);
        } else {
            EXPECT_STREQ(tile.node->className(), "Group") << nameOf(tile);
        }
    });
}

void checkDatabase(const LoadedDatabase& database, const SourceRange& source) {
    checkBins(database, source);
    checkSharedPosts(database);
    checkNodes(database);
}

void checkDatabase(const LoadedDatabase& database, const TestRaster& source) {
    checkDatabase(database, [&source](const Rect& rect) { return source.range(rect); });
}
