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

void divide(TileTree& tree, const Terrain& terrain, const Camera& camera, double factor) {
    const core::Geodetic eye = terrain.ellipsoid().toGeodetic(camera.eye);
    for (std::size_t i = 0; i < tree.tiles.size(); ++i) {
        const TileId id = tree.tiles[i].id;
        const double width = tree.boxes[i].latitude().width() * terrain.ellipsoid().equatorialRadius();
        const bool isNear = distanceTo(tree.boxes[i], terrain.ellipsoid(), eye, camera.eye) < factor * width;
        if (!isNear || id.level == terrain.pyramid().deepestLevel()) continue;
        tree.tiles[i].firstChild = tree.tiles.size();
        for (const TileId& child : id.children()) {
            tree.tiles.push_back({child, TreeTile::kNone, false, std::nullopt});
            tree.boxes.push_back(terrain.pyramid().bin(child));
        }
    }
}

// What is true of each tile. Bins nest: what lies in a tile outside is outside.
void judge(TileTree& tree, const Terrain& terrain, const Camera& camera) {
    const Frustum frustum(camera);
    const auto& hulls = std::get<indexOf(Method::Hull)>(tree.bins);
    for (std::size_t i = 0; i < tree.tiles.size(); ++i) {
        TreeTile& tile = tree.tiles[i];
        if (!tile.isOutside) tile.isOutside = classify(hulls[i], frustum) == core::Side::Outside;
        if (!tile.isOutside) tile.witness = findWitness(terrain.ellipsoid(), tree.boxes[i], camera);
        for (std::size_t child = 0; child < 4 && !tile.isLeaf(); ++child)
            tree.tiles[tile.firstChild + child].isOutside = tile.isOutside;
    }
    // Samples stand closer in the children: what is found there is a point of the parent too.
    for (std::size_t i = tree.tiles.size(); i-- > 0;) {
        TreeTile& tile = tree.tiles[i];
        for (std::size_t child = 0; child < 4 && !tile.isLeaf() && !tile.witness; ++child)
            tile.witness = tree.tiles[tile.firstChild + child].witness;
    }
}

void keepAllBelow(const TileTree& tree, std::size_t tile, std::vector<Verdict>& verdicts) {
    if (tree.tiles[tile].isLeaf()) return;
    for (std::size_t child = tree.tiles[tile].firstChild; child < tree.tiles[tile].firstChild + 4; ++child) {
        verdicts[child] = Verdict::WithinInside;
        keepAllBelow(tree, child, verdicts);
    }
}

template <class Bin>
void cullTile(const TileTree& tree, const std::vector<Bin>& bins, const Frustum& frustum, std::size_t tile,
              std::vector<Verdict>& verdicts) {
    switch (classify(bins[tile], frustum)) {
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
    for (std::size_t child = first; child < first + 4; ++child) cullTile(tree, bins, frustum, child, verdicts);
}

}  // namespace

TileTree::TileTree(const Terrain& terrain, const Camera& camera, double factor) {
    for (int y = 0; y < TileId::kStartRows; ++y) {
        for (int x = 0; x < TileId::kStartColumns; ++x) {
            tiles.push_back({{0, x, y}, TreeTile::kNone, false, std::nullopt});
            boxes.push_back(terrain.pyramid().bin({0, x, y}));
        }
    }
    divide(*this, terrain, camera, factor);
    bins = methodBins(terrain.ellipsoid(), boxes);
    judge(*this, terrain, camera);
}

void cull(const TileTree& tree, const Frustum& frustum, Method method, std::vector<Verdict>& verdicts) {
    withBins(tree.bins, method, [&](const auto& bins) {
        for (std::size_t start = 0; start < TileTree::kStartTiles; ++start)
            cullTile(tree, bins, frustum, start, verdicts);
    });
}

}  // namespace osgAnalyticBin::paper
