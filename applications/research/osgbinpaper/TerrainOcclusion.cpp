// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainOcclusion.h"

#include "Angles.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace osgAnalyticBin::paper {

namespace {

using core::Geodetic;
using core::HorizonBuffer;
using support::kDegreesPerRadian;

constexpr std::size_t kPlates = 8;  // along the edge of a leaf
constexpr std::size_t kQuarters = 4;
constexpr double kDepth = 2e4;         // metres of earth below a surface that count
constexpr double kLevelEnough = 0.25;  // of a corner's direction, ahead

/// The eye's frame for HorizonBuffer, and what the camera sees of its picture.
struct LevelView {
    core::Frame frame;
    core::Interval across;
};

std::optional<LevelView> levelViewOf(const Camera& camera, const core::Ellipsoid& ellipsoid) {
    const Geodetic eye = ellipsoid.toGeodetic(camera.eye);
    const glm::dvec3 up = ellipsoid.up(eye.latitude, eye.longitude);
    const glm::dvec3 ahead = glm::normalize(glm::cross(up, camera.right));
    const glm::dvec3 right = glm::cross(ahead, up);
    double left = std::numeric_limits<double>::infinity();
    double most = -left;
    for (const glm::dvec3& edge : camera.edges()) {
        const double forward = glm::dot(edge, ahead);
        if (!(forward > kLevelEnough * glm::length(edge))) return std::nullopt;
        left = std::min(left, glm::dot(edge, right) / forward);
        most = std::max(most, glm::dot(edge, right) / forward);
    }
    return LevelView{{camera.eye, right, ahead, up}, {left, most}};
}

struct Body {
    std::size_t leaf;  // among those drawn
    HorizonBuffer::Outline outline;
};

/// Which of the leaves are hidden in all their quarters.
std::vector<bool> hiddenOf(HorizonBuffer& buffer, std::vector<Body> bodies, std::size_t leaves) {
    std::sort(bodies.begin(), bodies.end(),
              [](const Body& a, const Body& b) { return a.outline.nearest < b.outline.nearest; });
    std::vector<bool> hidden(leaves, true);
    for (const Body& body : bodies)
        if (!body.outline.isBeside && !buffer.hides(body.outline)) hidden[body.leaf] = false;
    return hidden;
}

double eastOfMiddle(const core::GeodeticBin& box, const Geodetic& position) {
    return std::remainder(position.longitude - box.longitude().middle(), 2.0 * support::kPi);
}

std::size_t leafAt(const TileTree& tree, const Geodetic& position) {
    const auto part = [](double share, int count) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(share * count), 0, count - 1));
    };
    const double east = std::remainder(position.longitude, 2.0 * support::kPi) / (2.0 * support::kPi) + 0.5;
    std::size_t tile = part(position.latitude / support::kPi + 0.5, TileId::kStartRows) * TileId::kStartColumns +
                       part(east, TileId::kStartColumns);
    while (!tree.tiles[tile].isLeaf()) {
        const core::GeodeticBin& box = tree.boxes[tile];
        const bool isNorth = position.latitude >= box.latitude().middle();
        const bool isEast = eastOfMiddle(box, position) >= 0.0;
        const std::size_t first = tree.tiles[tile].firstChild;
        tile = first;
        for (std::size_t child = first; child < first + 4; ++child) {
            const core::GeodeticBin& quarter = tree.boxes[child];
            if ((quarter.latitude().middle() > box.latitude().middle()) == isNorth &&
                (quarter.longitude().middle() > box.longitude().middle()) == isEast)
                tile = child;
        }
    }
    return tile;
}

double shareOf(std::size_t post) {
    return static_cast<double>(post) / (TerrainOcclusion::kPosts - 1);
}

Geodetic at(const core::GeodeticBin& box, double north, double east, double altitude) {
    return {box.latitude().lower + north * box.latitude().width(),
            box.longitude().lower + east * box.longitude().width(), altitude};
}

}  // namespace

void OcclusionCounts::add(const OcclusionCounts& other) noexcept {
    cameras += other.cameras;
    drawn += other.drawn;
    hidden += other.hidden;
    seenHidden += other.seenHidden;
}

OcclusionCounts TerrainOcclusion::count(const TileTree& tree, const std::vector<Verdict>& verdicts,
                                        const Camera& camera) {
    const core::Ellipsoid& ellipsoid = _terrain.ellipsoid();
    const std::optional<LevelView> view = levelViewOf(camera, ellipsoid);
    // an eye below a surface that is drawn sees through it
    const Geodetic eye = ellipsoid.toGeodetic(camera.eye);
    if (!view || highestAt(tree, eye) >= eye.altitude) return {};
    std::vector<std::size_t> leaves;
    for (std::size_t i = 0; i < tree.tiles.size(); ++i)
        if (tree.tiles[i].isLeaf() && isKept(verdicts[i])) leaves.push_back(i);
    const core::InverseFrame frame(view->frame);
    HorizonBuffer buffer(glm::length(camera.eye), view->across);
    std::vector<Body> bodies;
    core::EarthColumns columns;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const core::GeodeticBin& box = tree.boxes[leaves[i]];
        const Surface& surface = surfaceOf(tree.tiles[leaves[i]], box);
        const auto hulls = core::BinBody(ellipsoid, box, 0.0, frame).quarters();
        for (std::size_t quarter = 0; quarter < kQuarters; ++quarter) {
            surface.plates.columns(kPlates, kPlates, quarter, kDepth, frame, columns);
            buffer.add(columns);
            bodies.push_back({i, buffer.outlineOf(hulls[quarter])});
        }
    }
    const std::vector<bool> hidden = hiddenOf(buffer, std::move(bodies), leaves.size());
    OcclusionCounts counts{1, leaves.size(), 0, 0};
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (!hidden[i]) continue;
        ++counts.hidden;
        counts.seenHidden += isSeen(tree, leaves[i], camera) ? 1U : 0U;
    }
    return counts;
}

const TerrainOcclusion::Surface& TerrainOcclusion::surfaceOf(const TreeTile& tile, const core::GeodeticBin& box) {
    const std::tuple key(tile.id.level, tile.id.x, tile.id.y);
    const auto found = _surfaces.find(key);
    if (found != _surfaces.end()) return found->second;
    _terrain.prefetch(tile.id.rect());
    Surface surface;
    for (std::size_t row = 0; row < kPosts; ++row) {
        for (std::size_t column = 0; column < kPosts; ++column) {
            const Geodetic post = at(box, shareOf(row), shareOf(column), 0.0);
            surface.altitudes.push_back(
                _terrain.height({post.latitude * kDegreesPerRadian, post.longitude * kDegreesPerRadian}));
        }
    }
    const core::GeodeticGrid grid{
        {box.latitude().lower, box.latitude().upper}, {box.longitude().lower, box.longitude().upper}, kPosts, kPosts};
    surface.plates = core::GroundPlates(_terrain.ellipsoid(), grid, surface.altitudes);
    return _surfaces.emplace(key, std::move(surface)).first->second;
}

// The highest corner of the cell of the surface drawn there: no triangle of the cell is above it.
double TerrainOcclusion::highestAt(const TileTree& tree, const Geodetic& position) {
    const std::size_t leaf = leafAt(tree, position);
    const core::GeodeticBin& box = tree.boxes[leaf];
    const auto cellOf = [](double share) {
        return static_cast<std::size_t>(std::clamp(share * (kPosts - 1), 0.0, static_cast<double>(kPosts - 2)));
    };
    const std::size_t row = cellOf((position.latitude - box.latitude().lower) / box.latitude().width());
    const std::size_t column = cellOf(0.5 + eastOfMiddle(box, position) / box.longitude().width());
    const double* const south = &surfaceOf(tree.tiles[leaf], box).altitudes[row * kPosts + column];
    const double* const north = south + kPosts;
    return std::max({south[0], south[1], north[0], north[1]});
}

// Whether a line of sight is above all terrain but that around its end, by samples.
bool TerrainOcclusion::isFree(const TileTree& tree, const Camera& camera, const glm::dvec3& target, double around) {
    constexpr int kSamples = 400;
    const double length = glm::distance(target, camera.eye);
    for (int i = 1; i < kSamples; ++i) {
        const double share = static_cast<double>(i) / kSamples;
        if ((1.0 - share) * length < around) break;
        const Geodetic sample = _terrain.ellipsoid().toGeodetic(camera.eye + share * (target - camera.eye));
        if (sample.altitude < highestAt(tree, sample)) return false;
    }
    return true;
}

bool TerrainOcclusion::isSeen(const TileTree& tree, std::size_t leaf, const Camera& camera) {
    constexpr std::size_t kStep = 8;
    constexpr double kCells = 2.0;  // around a post, whose own cells are as high as it is
    const core::GeodeticBin& box = tree.boxes[leaf];
    const auto planes = camera.planes();
    const double around = kCells * box.latitude().width() / (kPosts - 1) * _terrain.ellipsoid().equatorialRadius();
    for (std::size_t row = 0; row < kPosts; row += kStep) {
        for (std::size_t column = 0; column < kPosts; column += kStep) {
            const double altitude = surfaceOf(tree.tiles[leaf], box).altitudes[row * kPosts + column];
            const glm::dvec3 post = _terrain.ellipsoid().toEcef(at(box, shareOf(row), shareOf(column), altitude));
            const bool isInPicture = std::all_of(planes.begin(), planes.end(),
                                                 [&](const core::Plane& plane) { return plane.distance(post) >= 0.0; });
            if (isInPicture && isFree(tree, camera, post, around)) return true;
        }
    }
    return false;
}

}  // namespace osgAnalyticBin::paper
