// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTree.h"

#include "Angles.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::paper {

using core::Side;

Frustum::Frustum(const Camera& camera) noexcept : hull(camera.planes(), camera.planes().size()) {
    for (const core::Plane& plane : camera.planes()) planes.push_back(plane);
}

TileBins::TileBins(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin)
    : box(ellipsoid, bin),
      corners(core::GeodeticMapping(ellipsoid), core::parameterBox(bin)),
      paper(core::GeodeticMapping(ellipsoid), core::parameterBox(bin)),
      quadratic(core::quadraticOrExact(ellipsoid, bin)),
      exact(ellipsoid, bin),
      reverse(exact, bin) {}

Side TileBins::classify(Method method, const core::PlaneSet& planes, core::PlaneMask& undecided) const noexcept {
    switch (method) {
        case Method::Box:
            return core::classify(box, planes, undecided);
        case Method::Corners:
            return core::classify(corners, planes, undecided);
        case Method::Paper:
            return core::classify(paper, planes, undecided);
        case Method::Quadratic:
            return core::classify(quadratic, planes, undecided);
        case Method::Exact:
        case Method::Hull:
            break;
    }
    return core::classify(exact, planes, undecided);
}

Side TileBins::classify(Method method, const Frustum& frustum) const noexcept {
    core::PlaneMask undecided = frustum.planes.all();
    const Side side = classify(method, frustum.planes, undecided);
    if (method != Method::Hull || side != Side::Straddling) return side;
    const std::size_t count = frustum.planes.size();
    const bool isApart =
        isSeparated(reverse, frustum.hull) || core::isSeparated(exact, frustum.planes, count, undecided, count);
    return isApart ? Side::Outside : Side::Straddling;
}

namespace {

constexpr int kSearchSteps = 6;
constexpr int kHalvings = 14;
// Of the radius: what rounding may add to a line of sight that ends on the globe.
constexpr double kGrazing = 1e-9;

// A position of the unit cube, in latitude, longitude and altitude.
using Shares = glm::dvec3;

double depthOf(const glm::dvec3& point, const std::array<core::Plane, 4>& planes) {
    double least = std::numeric_limits<double>::infinity();
    for (const core::Plane& plane : planes) least = std::min(least, plane.distance(point));
    return least;
}

struct Best {
    Shares shares{0.5};
    double depth = -std::numeric_limits<double>::infinity();
};

// Steps along the axes and along the diagonals, which a corner between two sides of the frustum needs.
template <class Depth>
void climb(const Depth& depth, glm::length_t axes, Best& best) {
    double step = 0.5 / kSearchSteps;
    for (int halving = 0; halving < kHalvings; step *= 0.5, ++halving) {
        const Shares from = best.shares;
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                Shares to = from + step * glm::dvec3(i, j, 0.0);
                to = {std::clamp(to.x, 0.0, 1.0), std::clamp(to.y, 0.0, 1.0), to.z};
                const double value = depth(to);
                if (value > best.depth) best = {to, value};
            }
        }
        if (axes < 3) continue;
        for (const double z : {0.0, 1.0}) {
            const Shares to{best.shares.x, best.shares.y, z};
            const double value = depth(to);
            if (value > best.depth) best = {to, value};
        }
    }
}

template <class Depth>
Best deepest(const Depth& depth, glm::length_t axes) {
    Best best;
    for (int i = 0; i <= kSearchSteps; ++i) {
        for (int j = 0; j <= kSearchSteps; ++j) {
            for (int k = 0; k <= (axes < 3 ? 0 : 1); ++k) {
                const Shares shares{static_cast<double>(i) / kSearchSteps, static_cast<double>(j) / kSearchSteps, k};
                const double value = depth(shares);
                if (value > best.depth) best = {shares, value};
            }
        }
    }
    climb(depth, axes, best);
    return best;
}

// Whether the ellipsoid leaves the line of sight free.
bool isInSight(const core::Ellipsoid& ellipsoid, const glm::dvec3& eye, const glm::dvec3& point) {
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    const glm::dvec3 from = point / radii;
    const glm::dvec3 step = eye / radii - from;
    const double nearest = std::clamp(-glm::dot(from, step) / glm::dot(step, step), 0.0, 1.0);
    return glm::length(from + nearest * step) >= 1.0 - kGrazing;
}

}  // namespace

core::Geodetic positionIn(const core::GeodeticBin& bin, const glm::dvec3& shares) noexcept {
    return {bin.latitude().lower + shares.x * bin.latitude().width(),
            bin.longitude().lower + shares.y * bin.longitude().width(),
            bin.altitude().lower + shares.z * bin.altitude().width()};
}

std::optional<Witness> findWitness(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                                   const Camera& camera) {
    const std::array<core::Plane, 4> planes = camera.planes();
    const auto depth = [&](const Shares& shares) { return depthOf(ellipsoid.toEcef(positionIn(bin, shares)), planes); };
    const Best best = deepest(depth, 3);
    if (!(best.depth > 0.0)) return std::nullopt;
    return Witness{positionIn(bin, best.shares), best.depth};
}

std::optional<Witness> findTerrainWitness(Terrain& terrain, const core::GeodeticBin& bin, const Camera& camera) {
    const std::array<core::Plane, 4> planes = camera.planes();
    const auto depth = [&](const Shares& shares) {
        const glm::dvec3 point = terrain.ellipsoid().toEcef(terrain.onSurface(positionIn(bin, shares)));
        if (!isInSight(terrain.ellipsoid(), camera.eye, point)) return -std::numeric_limits<double>::infinity();
        return depthOf(point, planes);
    };
    const Best best = deepest(depth, 2);
    if (!(best.depth > 0.0)) return std::nullopt;
    return Witness{terrain.onSurface(positionIn(bin, best.shares)), best.depth};
}

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
