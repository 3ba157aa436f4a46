// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ProceduralGlobe.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>

#include <TileFixture.h>
#include <TileNode.h>
#include <algorithm>
#include <support/Random.h>

namespace osgAnalyticBin::globe {
namespace {

using osgbindem::Edge;
using osgbindem::TileId;

constexpr int kCells = 6;

GlobeOptions deepGlobe() {
    GlobeOptions options;
    options.levels = GlobeOptions::kMostLevels;
    options.cells = kCells;
    return options;
}

// A tile as it is paged in.
osg::ref_ptr<osg::Node> nodeOf(const ProceduralGlobe& globe, const TileId& tile) {
    if (tile.level == 0) return globe.root()->asGroup()->getChild(static_cast<unsigned int>(tile.y * 16 + tile.x));
    const TileId parent = tile.ancestor(tile.level - 1);
    const auto siblings = parent.children();
    const auto place = std::find(siblings.begin(), siblings.end(), tile) - siblings.begin();
    return globe.children(parent)->asGroup()->getChild(static_cast<unsigned int>(place));
}

// A tile's own mesh, which stands in front of what it pages.
osg::MatrixTransform& placedMeshOf(osg::Node& tile) {
    return *tile.asGroup()->getChild(0)->asTransform()->asMatrixTransform();
}

// The vertices of an edge in ECEF, as they are drawn.
std::vector<osg::Vec3d> edgeOf(osg::Node& tile, Edge edge) {
    osg::MatrixTransform& placed = placedMeshOf(tile);
    const auto& vertices =
        static_cast<const osg::Vec3Array&>(*placed.getChild(0)->asGeometry()->getVertexArray()).asVector();
    const bool isParallel = edge == Edge::South || edge == Edge::North;
    const int across = edge == Edge::North || edge == Edge::East ? kCells : 0;
    std::vector<osg::Vec3d> points;
    for (int along = 0; along <= kCells; ++along) {
        const int vertex = isParallel ? across * (kCells + 1) + along : along * (kCells + 1) + across;
        points.push_back(osg::Vec3d(vertices[static_cast<std::size_t>(vertex)]) + placed.getMatrix().getTrans());
    }
    return points;
}

// Tiles of a level: at the poles, at the date line, anywhere.
std::vector<TileId> someTiles(test::Random& random, int level) {
    const TileId any{level, 0, 0};
    const int east = any.columns() - 1;
    const int north = any.rows() - 1;
    std::vector<TileId> tiles{{level, 0, 0}, {level, east, north}, {level, east, any.rows() / 2}};
    tiles.push_back({level, random.integer(0, east), north - std::min(1, north)});
    for (int i = 0; i < 3; ++i) tiles.push_back({level, random.integer(0, east), random.integer(0, north)});
    return tiles;
}

// Of a level, in the three rows next to each pole.
std::vector<TileId> tilesAtThePoles(int level) {
    const int rows = TileId{level, 0, 0}.rows();
    std::vector<TileId> tiles;
    for (const int y : {0, 1, 2, rows - 3, rows - 2, rows - 1})
        for (const int x : {0, 1}) tiles.push_back({level, x, y});
    return tiles;
}

TEST(ProceduralGlobe, NeighboursShareTheirEdgesToTheLastBit) {
    const ProceduralGlobe globe(deepGlobe());
    test::Random random(8201);
    for (const int level : {0, 1, 4, 7, 12, 18, 24}) {
        for (const TileId& tile : someTiles(random, level)) {
            const osg::ref_ptr<osg::Node> node = nodeOf(globe, tile);
            const osg::ref_ptr<osg::Node> east = nodeOf(globe, *tile.neighbour(Edge::East));
            EXPECT_EQ(edgeOf(*node, Edge::East), edgeOf(*east, Edge::West)) << level;
            const auto northern = tile.neighbour(Edge::North);
            if (!northern) continue;
            const osg::ref_ptr<osg::Node> north = nodeOf(globe, *northern);
            EXPECT_EQ(edgeOf(*node, Edge::North), edgeOf(*north, Edge::South)) << level;
        }
    }
}

void expectBinHoldsTriangles(const ProceduralGlobe& globe, const TileId& tile, int cells) {
    const osg::ref_ptr<osg::Node> node = nodeOf(globe, tile);
    const AnalyticBin bin = storedBin(*node);
    const test::DrawnTriangles drawn = test::drawnTriangles(placedMeshOf(*node));
    const auto side = static_cast<std::size_t>(cells);
    ASSERT_EQ(drawn.surface.size(), 2 * side * side + 8 * side) << "skirts included";
    EXPECT_LE(test::metresOutside(bin, test::samplesOf(drawn.surface, 24 / cells), globe.layout().ellipsoid()),
              bin.margin())
        << tile.level << ' ' << tile.x << ' ' << tile.y;
}

TEST(ProceduralGlobe, BinsHoldEveryTriangle) {
    const ProceduralGlobe globe(deepGlobe());
    test::Random random(8202);
    for (const int level : {0, 1, 3, 7, 12, 18, 24})
        for (const TileId& tile : someTiles(random, level)) expectBinHoldsTriangles(globe, tile, kCells);
    GlobeOptions options;
    options.levels = 9;
    options.cells = 2;
    const ProceduralGlobe coarse(options);
    for (int level = 0; level <= options.levels; ++level)
        for (const TileId& tile : tilesAtThePoles(level)) expectBinHoldsTriangles(coarse, tile, options.cells);
}

TEST(ProceduralGlobe, BinsHoldThoseOfTheChildren) {
    const ProceduralGlobe globe(deepGlobe());
    test::Random random(8203);
    for (int level = 0; level < 24; ++level) {
        for (const TileId& tile : someTiles(random, level)) {
            const AnalyticBin bin = AnalyticBin::fromText(globe.binOf(tile).toText());
            const osg::ref_ptr<osg::Node> children = globe.children(tile);
            for (unsigned int i = 0; i < 4; ++i)
                EXPECT_TRUE(bin.contains(storedBin(*children->asGroup()->getChild(i))))
                    << level << ' ' << tile.x << ' ' << tile.y;
        }
    }
}

TEST(ProceduralGlobe, BinsAreTight) {
    const ProceduralGlobe globe(deepGlobe());
    // 2.4 m wide: the bin is hardly taller than the terrain is steep.
    const AnalyticBin bin = globe.binOf({20, 8800000, 6300000});
    EXPECT_LT(bin.bin().altitude().width(), 6.0);
    EXPECT_LT(bin.margin(), 0.01);
}

TEST(ProceduralGlobe, SkirtsReachBelowTheEdgesOfCoarserAndFinerNeighbours) {
    const ProceduralGlobe globe(deepGlobe());
    test::Random random(8204);
    for (const int level : {1, 4, 10, 18}) {
        for (int i = 0; i < 10; ++i) {
            const TileId tile{level, 2 * random.integer(0, (16 << level) / 2 - 1), random.integer(1, (8 << level) - 2)};
            // Along the parent's western edge a neighbour of the parent's level may stand.
            const osg::ref_ptr<osg::Node> own = nodeOf(globe, tile);
            const osg::ref_ptr<osg::Node> coarse = nodeOf(globe, *tile.ancestor(level - 1).neighbour(Edge::West));
            const auto posts = edgeOf(*own, Edge::West);
            const auto line = edgeOf(*coarse, Edge::East);
            const int first = tile.y % 2 == 0 ? 0 : kCells / 2;
            for (int k = 1; k < kCells; k += 2) {
                const auto at = static_cast<std::size_t>(first + k / 2);
                const osg::Vec3d middle = (line[at] + line[at + 1]) * 0.5;
                EXPECT_LT((posts[static_cast<std::size_t>(k)] - middle).length(), globe.skirtDepth(level)) << level;
            }
        }
    }
}

TEST(ProceduralGlobe, EndsAtItsDeepestLevel) {
    GlobeOptions options;
    options.levels = 1;
    options.cells = kCells;
    const ProceduralGlobe globe(options);
    const osg::ref_ptr<osg::Node> start = nodeOf(globe, {0, 3, 4});
    const auto* paged = dynamic_cast<const osg::PagedLOD*>(start.get());
    ASSERT_TRUE(paged);
    EXPECT_EQ(paged->getFileName(1), childrenFileOf({0, 3, 4}, options));
    const osg::ref_ptr<osg::Node> leaf = nodeOf(globe, {1, 6, 8});
    EXPECT_FALSE(dynamic_cast<const osg::PagedLOD*>(leaf.get()));
    EXPECT_TRUE(storedBin(*leaf).valid());
}

TEST(ProceduralGlobe, RootDeclaresAHorizonBelowAllThatIsDrawn) {
    GlobeOptions options;
    options.cells = kCells;
    const ProceduralGlobe globe(options);
    const osg::ref_ptr<osg::Node> root = globe.root();
    ASSERT_TRUE(dynamic_cast<osg::CoordinateSystemNode*>(root.get()));
    ASSERT_EQ(root->asGroup()->getNumChildren(), 128U);
    const auto* request = dynamic_cast<const InstallBinsCallback*>(root->getUpdateCallback());
    ASSERT_TRUE(request);
    EXPECT_EQ(request->getCullOptions().horizonUse, HorizonUse::Given);
    for (unsigned int i = 0; i < 128; ++i) {
        const AnalyticBin bin = storedBin(*root->asGroup()->getChild(i));
        EXPECT_LE(request->getCullOptions().horizon, bin.bin().altitude().lower - bin.margin());
    }
}

TEST(ProceduralGlobe, MayComeWithoutBins) {
    GlobeOptions options;
    options.cells = kCells;
    options.bins = false;
    const osg::ref_ptr<osg::Node> root = ProceduralGlobe(options).root();
    EXPECT_FALSE(root->getUpdateCallback());
    EXPECT_FALSE(hasStoredBin(*root->asGroup()->getChild(0)));
}

}  // namespace
}  // namespace osgAnalyticBin::globe
