// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTree.h"

#include "Angles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

using support::kPi;

// From the eye to the nearest position of the bin by latitude, longitude and altitude: close enough for a level of
// detail.
double distanceTo(const core::GeodeticBin& bin, const core::Ellipsoid& ellipsoid, const core::Geodetic& eye,
                  const glm::dvec3& eyeEcef) {
    const double middle = bin.longitude().middle();
    const double half = 0.5 * bin.longitude().width();
    const double east = std::remainder(eye.longitude - middle, 2.0 * kPi);
    const core::Geodetic nearest{std::clamp(eye.latitude, bin.latitude().lower, bin.latitude().upper),
                                 middle + std::clamp(east, -half, half),
                                 std::clamp(eye.altitude, bin.altitude().lower, bin.altitude().upper)};
    return glm::distance(ellipsoid.toEcef(nearest), eyeEcef);
}

void divide(std::vector<TreeTile>& tiles, const Terrain& terrain, const Camera& camera) {
    constexpr double kWidths = 3.0;
    const core::Geodetic eye = terrain.ellipsoid().toGeodetic(camera.eye);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const TileId id = tiles[i].id;
        const double width = tiles[i].box.latitude().width() * terrain.ellipsoid().equatorialRadius();
        const bool isNear = distanceTo(tiles[i].box, terrain.ellipsoid(), eye, camera.eye) < kWidths * width;
        if (!isNear || id.level == terrain.deepestLevel()) continue;
        tiles[i].firstChild = tiles.size();
        for (const TileId& child : id.children()) tiles.emplace_back(terrain, child);
    }
}

// What is true of each tile. Bins nest: what lies in a tile outside is outside.
void judge(std::vector<TreeTile>& tiles, const Terrain& terrain, const Camera& camera) {
    const Frustum frustum(camera);
    for (TreeTile& tile : tiles) {
        if (!tile.isOutside) tile.isOutside = tile.bins.classify(Method::Hull, frustum) == core::Side::Outside;
        if (!tile.isOutside) tile.witness = findWitness(terrain.ellipsoid(), tile.box, camera);
        for (std::size_t child = 0; child < 4 && !tile.isLeaf(); ++child)
            tiles[tile.firstChild + child].isOutside = tile.isOutside;
    }
    // Samples stand closer in the children: what is found there is a point of the parent too.
    for (std::size_t i = tiles.size(); i-- > 0;) {
        TreeTile& tile = tiles[i];
        for (std::size_t child = 0; child < 4 && !tile.isLeaf() && !tile.witness; ++child)
            tile.witness = tiles[tile.firstChild + child].witness;
    }
}

void keepAllBelow(const TileTree& tree, std::size_t tile, std::vector<Verdict>& verdicts) {
    if (tree.tiles[tile].isLeaf()) return;
    for (std::size_t child = tree.tiles[tile].firstChild; child < tree.tiles[tile].firstChild + 4; ++child) {
        verdicts[child] = Verdict::WithinInside;
        keepAllBelow(tree, child, verdicts);
    }
}

void cullTile(const TileTree& tree, Method method, const Frustum& frustum, std::size_t tile,
              std::vector<Verdict>& verdicts) {
    switch (tree.tiles[tile].bins.classify(method, frustum)) {
        case core::Side::Outside:
            verdicts[tile] = Verdict::Outside;
            return;
        case core::Side::Inside:
            verdicts[tile] = Verdict::Inside;
            return keepAllBelow(tree, tile, verdicts);
        case core::Side::Straddling:
            break;
    }
    verdicts[tile] = Verdict::Straddling;
    if (tree.tiles[tile].isLeaf()) return;
    const std::size_t first = tree.tiles[tile].firstChild;
    for (std::size_t child = first; child < first + 4; ++child) cullTile(tree, method, frustum, child, verdicts);
}

}  // namespace

TileTree::TileTree(const Terrain& terrain, const Camera& camera) {
    for (int y = 0; y < TileId::kStartRows; ++y)
        for (int x = 0; x < TileId::kStartColumns; ++x) tiles.emplace_back(terrain, TileId{0, x, y});
    divide(tiles, terrain, camera);
    judge(tiles, terrain, camera);
}

std::vector<Verdict> cull(const TileTree& tree, const Frustum& frustum, Method method) {
    std::vector<Verdict> verdicts(tree.tiles.size(), Verdict::Untested);
    for (std::size_t start = 0; start < TileTree::kStartTiles; ++start)
        cullTile(tree, method, frustum, start, verdicts);
    return verdicts;
}

}  // namespace osgAnalyticBin::paper
