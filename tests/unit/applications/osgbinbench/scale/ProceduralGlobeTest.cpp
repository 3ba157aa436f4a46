// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GlobeOptions.h"
#include "ProceduralGlobe.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/CoordinateSystemNode>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>

#include <Tile.h>
#include <TileFixture.h>
#include <algorithm>
#include <support/Programs.h>
#include <support/Random.h>

namespace osgAnalyticBin::globe {
namespace {

GlobeOptions optionsOf(const std::string& name) {
    return globeNameOf(name).options;
}

TEST(GlobeOptions, AreReadFromTheNameOfTheFileAndReadBackToTheSame) {
    EXPECT_EQ(optionsOf("folder/0.proceduralglobe").levels, 0);
    EXPECT_EQ(optionsOf("7.(cells=4).proceduralglobe").levels, 7);
    EXPECT_EQ(optionsOf("7.(cells=4).proceduralglobe").cells, 4);
    GlobeOptions options;
    options.levels = 24;
    options.cells = 2;
    options.bins = false;
    EXPECT_EQ(rootFileOf(options), "(levels=24,cells=2,bins=off).proceduralglobe");
    EXPECT_EQ(rootFileOf(optionsOf(rootFileOf(options))), rootFileOf(options));
    const tiles::TileId tile{23, (16 << 23) - 1, (8 << 23) - 1};
    const auto name = globeNameOf(childrenFileOf(tile, options));
    EXPECT_EQ(rootFileOf(name.options), rootFileOf(options));
    ASSERT_TRUE(name.tile);
    EXPECT_EQ(*name.tile, tile);
}

TEST(GlobeOptions, ErrorsNameWhatIsWrongAndWhatIsAllowed) {
    const auto expectError = [](const std::string& name, const std::string& what) {
        const std::string error = test::failureOf([&] { (void)globeNameOf(name); });
        EXPECT_NE(error.find(what), std::string::npos) << name << ": " << error;
    };
    for (const std::string name : {"25", "-1", "1.5", "earth"})
        expectError(name + ".proceduralglobe",
                    "\"levels=" + name + "\"; allowed are levels=0..24, cells=2..64, bins=on|off");
    for (const std::string item : {"levels=25", "cells=3", "cells=66", "bins=maybe", "colour=red", "levels"})
        expectError("(" + item + ").proceduralglobe", "\"" + item + "\"; allowed are");
    for (const std::string tile : {"3-0-0", "0-16-0", "0-0-8", "1-32-0", "2--1-0"})
        expectError(tile + ".(levels=3).proceduralglobe", "has no children");
}

using tiles::Edge;
using tiles::TileId;

constexpr int kCells = 6;

ProceduralGlobe globeWith(int levels, int cells = kCells, bool bins = true) {
    GlobeOptions options;
    options.levels = levels;
    options.cells = cells;
    options.bins = bins;
    return ProceduralGlobe(options);
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

TEST(ProceduralGlobe, NeighboursShareTheirEdgesToTheLastBit) {
    const ProceduralGlobe globe = globeWith(GlobeOptions::kMostLevels);
    test::Random random(8201);
    for (const int level : {0, 1, 4, 7, 12, 18, 24}) {
        for (const TileId& tile : someTiles(random, level)) {
            const osg::ref_ptr<osg::Node> node = nodeOf(globe, tile);
            for (const auto& [edge, opposite] : {std::pair(Edge::East, Edge::West), {Edge::North, Edge::South}}) {
                const auto neighbour = tile.neighbour(edge);
                if (!neighbour) continue;
                EXPECT_EQ(edgeOf(*node, edge), edgeOf(*nodeOf(globe, *neighbour), opposite)) << level;
            }
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

TEST(ProceduralGlobe, BinsHoldEveryTriangleAndTheBinsOfTheChildrenAndAreTight) {
    const ProceduralGlobe globe = globeWith(GlobeOptions::kMostLevels);
    test::Random random(8202);
    for (int level = 0; level <= 24; ++level) {
        for (const TileId& tile : someTiles(random, level)) {
            if (level % 3 < 2) expectBinHoldsTriangles(globe, tile, kCells);
            if (level == 24) continue;
            const AnalyticBin bin = AnalyticBin::fromText(globe.binOf(tile).toText());
            const osg::ref_ptr<osg::Node> children = globe.children(tile);
            for (unsigned int i = 0; i < 4; ++i)
                EXPECT_TRUE(bin.contains(storedBin(*children->asGroup()->getChild(i))))
                    << level << ' ' << tile.x << ' ' << tile.y;
        }
    }
    // 2.4 m wide: the bin is hardly taller than the terrain is steep.
    const AnalyticBin bin = globe.binOf({20, 8800000, 6300000});
    EXPECT_LT(bin.bin().altitude().width(), 6.0);
    EXPECT_LT(bin.margin(), 0.01);
    // Coarse tiles in the three rows next to each pole.
    const ProceduralGlobe coarse = globeWith(9, 2);
    for (int level = 0; level <= 9; ++level) {
        const int rows = TileId{level, 0, 0}.rows();
        for (const int y : {0, 1, 2, rows - 3, rows - 2, rows - 1})
            for (const int x : {0, 1}) expectBinHoldsTriangles(coarse, {level, x, y}, 2);
    }
}

TEST(ProceduralGlobe, SkirtsReachBelowTheEdgesOfCoarserAndFinerNeighbours) {
    const ProceduralGlobe globe = globeWith(GlobeOptions::kMostLevels);
    test::Random random(8204);
    for (const int level : {1, 4, 10, 18}) {
        for (int i = 0; i < 10; ++i) {
            const TileId tile{level, 2 * random.integer(0, (16 << level) / 2 - 1), random.integer(1, (8 << level) - 2)};
            // Along the parent's western edge a neighbour of the parent's level may stand.
            const auto posts = edgeOf(*nodeOf(globe, tile), Edge::West);
            const auto line = edgeOf(*nodeOf(globe, *tile.ancestor(level - 1).neighbour(Edge::West)), Edge::East);
            const int first = tile.y % 2 == 0 ? 0 : kCells / 2;
            for (int k = 1; k < kCells; k += 2) {
                const auto at = static_cast<std::size_t>(first + k / 2);
                const osg::Vec3d middle = (line[at] + line[at + 1]) * 0.5;
                EXPECT_LT((posts[static_cast<std::size_t>(k)] - middle).length(), globe.skirtDepth(level)) << level;
            }
        }
    }
}

TEST(ProceduralGlobe, EndsAtItsDeepestLevelAndMayComeWithoutBins) {
    const ProceduralGlobe globe = globeWith(1);
    GlobeOptions options;
    options.levels = 1;
    options.cells = kCells;
    const osg::ref_ptr<osg::Node> start = nodeOf(globe, {0, 3, 4});
    EXPECT_EQ(dynamic_cast<const osg::PagedLOD&>(*start).getFileName(1), childrenFileOf({0, 3, 4}, options));
    const osg::ref_ptr<osg::Node> leaf = nodeOf(globe, {1, 6, 8});
    EXPECT_FALSE(dynamic_cast<const osg::PagedLOD*>(leaf.get()));
    EXPECT_TRUE(storedBin(*leaf).valid());
    const osg::ref_ptr<osg::Node> bare = globeWith(1, kCells, false).root();
    EXPECT_FALSE(bare->getUpdateCallback());
    EXPECT_FALSE(hasStoredBin(*bare->asGroup()->getChild(0)));
}

TEST(ProceduralGlobe, RootDeclaresAHorizonBelowAllThatIsDrawn) {
    const osg::ref_ptr<osg::Node> root = globeWith(GlobeOptions().levels).root();
    ASSERT_TRUE(dynamic_cast<osg::CoordinateSystemNode*>(root.get()));
    ASSERT_EQ(root->asGroup()->getNumChildren(), 128U);
    const CullOptions& options = dynamic_cast<const InstallBinsCallback&>(*root->getUpdateCallback()).getCullOptions();
    EXPECT_EQ(options.horizonUse, HorizonUse::Given);
    for (unsigned int i = 0; i < 128; ++i) {
        const AnalyticBin bin = storedBin(*root->asGroup()->getChild(i));
        EXPECT_LE(options.horizon, bin.bin().altitude().lower - bin.margin());
    }
}

}  // namespace
}  // namespace osgAnalyticBin::globe
