// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTree.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

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
    const auto by = [&](const auto& bin) { return core::classify(bin, planes, undecided); };
    return method == Method::Box         ? by(box)
           : method == Method::Corners   ? by(corners)
           : method == Method::Paper     ? by(paper)
           : method == Method::Quadratic ? by(quadratic)
                                         : by(exact);
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

template <class Depth>
struct Best {
    const Depth& depthAt;
    Shares shares{0.5};
    double depth = -std::numeric_limits<double>::infinity();

    void consider(const Shares& other) {
        const double value = depthAt(other);
        if (!(value > depth)) return;
        shares = other;
        depth = value;
    }
};

// A grid of samples, then ever smaller steps from the best: along the axes and along the diagonals, which a corner
// between two sides of the frustum needs. `axes`: 2 on a surface, where the last share does not count.
template <class Depth>
Best<Depth> deepest(const Depth& depth, int axes) {
    Best<Depth> best{depth};
    for (int i = 0; i <= kSearchSteps; ++i)
        for (int j = 0; j <= kSearchSteps; ++j)
            for (int k = 0; k <= axes - 2; ++k)
                best.consider({static_cast<double>(i) / kSearchSteps, static_cast<double>(j) / kSearchSteps, k});
    double step = 0.5 / kSearchSteps;
    for (int halving = 0; halving < kHalvings; step *= 0.5, ++halving) {
        const Shares from = best.shares;
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j) best.consider(glm::clamp(from + step * glm::dvec3(i, j, 0.0), 0.0, 1.0));
        for (int k = 0; k <= axes - 2; ++k) best.consider({best.shares.x, best.shares.y, k});
    }
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
    const auto best = deepest(depth, 3);
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
    const auto best = deepest(depth, 2);
    if (!(best.depth > 0.0)) return std::nullopt;
    return Witness{terrain.onSurface(positionIn(bin, best.shares)), best.depth};
}

namespace {

// From the eye to the nearest position of the bin by latitude, longitude and altitude: close enough for a level of
// detail.
double distanceTo(const core::GeodeticBin& bin, const core::Ellipsoid& ellipsoid, const core::Geodetic& eye,
                  const glm::dvec3& eyeEcef) {
    const double middle = bin.longitude().middle();
    const double half = 0.5 * bin.longitude().width();
    const double east = std::remainder(eye.longitude - middle, glm::two_pi<double>());
    const core::Geodetic nearest{std::clamp(eye.latitude, bin.latitude().lower, bin.latitude().upper),
                                 middle + std::clamp(east, -half, half),
                                 std::clamp(eye.altitude, bin.altitude().lower, bin.altitude().upper)};
    return glm::distance(ellipsoid.toEcef(nearest), eyeEcef);
}

void divide(std::vector<TreeTile>& tiles, Terrain& terrain, const Camera& camera) {
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

void cullTile(const TileTree& tree, Method method, const Frustum& frustum, std::size_t tile, bool isWithinInside,
              std::vector<Verdict>& verdicts) {
    Verdict& verdict = verdicts[tile];
    if (isWithinInside) {
        verdict = Verdict::WithinInside;
    } else {
        const Side side = tree.tiles[tile].bins.classify(method, frustum);
        verdict = side == Side::Outside  ? Verdict::Outside
                  : side == Side::Inside ? Verdict::Inside
                                         : Verdict::Straddling;
    }
    if (verdict == Verdict::Outside || tree.tiles[tile].isLeaf()) return;
    const std::size_t first = tree.tiles[tile].firstChild;
    for (std::size_t child = first; child < first + 4; ++child)
        cullTile(tree, method, frustum, child, verdict != Verdict::Straddling, verdicts);
}

}  // namespace

TileTree::TileTree(Terrain& terrain, const Camera& camera) {
    for (int y = 0; y < TileId::kStartRows; ++y)
        for (int x = 0; x < TileId::kStartColumns; ++x) tiles.emplace_back(terrain, TileId{0, x, y});
    divide(tiles, terrain, camera);
    judge(tiles, terrain, camera);
}

std::vector<Verdict> cull(const TileTree& tree, const Frustum& frustum, Method method) {
    std::vector<Verdict> verdicts(tree.tiles.size(), Verdict::Untested);
    for (std::size_t start = 0; start < TileTree::kStartTiles; ++start)
        cullTile(tree, method, frustum, start, false, verdicts);
    return verdicts;
}

}  // namespace osgAnalyticBin::paper
