// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "OcclusionSearch.h"

#include "../kit/tile/InstalledTile.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

namespace {

using core::BinHull;
using core::GeodeticBin;
using core::HorizonBuffer;

// A shown tile.
struct Candidate {
    const ShownTile* tile;
    double distance;   // metres from the eye to a corner of the bin, the nearest one
    double size;       // metres from corner to corner
    bool isHidden;     // as far as is known
    bool isMeshAlone;  // finer levels may reach higher
    bool isInPicture;  // at least one quarter is
};

// A quarter of a tile's bin that is not beside the picture. Quarters are tested one by one, because more terrain is in
// front of the farther ones.
struct Quarter {
    std::size_t candidate, number;
    HorizonBuffer::Outline outline;  // of all that is drawn with it
};

class OcclusionSearch {
public:
    OcclusionSearch(const TerrainHider::View& view, const std::vector<ShownTile>& shown, NearMeshes& meshes,
                    FoundOcclusion& found)
        : _region(view.region),
          _shown(shown),
          _ellipsoid(view.ellipsoid),
          _meshes(meshes),
          _found(found),
          _frame(found.eye),
          _buffer(glm::length(found.eye.origin), found.span.across, found.span.drawing, found.span.depthStep,
                  found.eyes) {}

    // Returns: whether something was found.
    [[nodiscard]] bool run() {
        const std::size_t tiles = _shown.size();
        _candidates.reserve(tiles);
        _quarters.reserve(2 * tiles);
        _order.reserve(2 * tiles);
        for (const ShownTile& tile : _shown) {
            if (!add(tile)) return false;
        }
        std::sort(_order.begin(), _order.end());
        double clearance = HUGE_VAL;
        if (_found.nearReach > 0.0) {
            const double nearReach = 1.01 * _found.nearReach;
            const std::optional<NearTerrain> terrain = terrainWithin(nearReach);
            if (!terrain || !(terrain->top < HUGE_VAL)) return false;
            clearance = terrain->nearest;
            _buffer.setLowest(terrain->top);
        }
        for (const auto& [nearest, number] : _order) {
            const Quarter& quarter = _quarters[number];
            if (_buffer.hides(quarter.outline)) continue;
            addEarth(quarter);
            _candidates[quarter.candidate].isHidden = false;
        }
        _found.lastClearance = std::min(clearance, _buffer.nearestEarth());
        _found.covered = covered();
        _found.findings.clear();
        for (const Candidate& candidate : _candidates) {
            using Finding = FoundOcclusion::Finding;
            const Finding hidden = candidate.isMeshAlone ? Finding::MeshHidden : Finding::Hidden;
            const Finding inPicture = candidate.isHidden ? hidden : Finding::Seen;
            _found.findings.push_back(candidate.isInPicture ? inPicture : Finding::Beside);
        }
        _found.profile.reset();
        _found.earth = std::move(_buffer);
        return true;
    }

private:
    // Returns: false where the place of the tile is not known.
    [[nodiscard]] bool add(const ShownTile& shown) {
        const AnalyticBinCullCallback& tile = *shown.tile;
        const GeodeticBin& bin = tile.getBin().bin();
        const core::Interval altitude{tile.getBinLow(), tile.getBinHigh()};
        if (bin.empty() || !std::isfinite(altitude.lower) || !std::isfinite(altitude.upper)) return false;
        Candidate candidate{&shown, HUGE_VAL, 0.0, true, false, false};
        const GeodeticBin drawn = bin.withAltitude(altitude);
        const core::BinBody body(_ellipsoid, drawn, tile.getBin().margin(), _frame);
        if (_buffer.isBeside(body.ball())) {
            _candidates.push_back(candidate);
            return true;
        }
        auto hulls = body.quarters();
        const InstalledTile* const installed = tile.getInstalledTile();
        const core::GroundPlates* const plates = installed && shown.isOnlyLevel ? installed->plates() : nullptr;
        candidate.isMeshAlone = plates && plates->lowerTops(drawn, hulls);
        candidate.size = 2.0 * glm::distance(hulls.back().corner(0), hulls.back().corner(7));
        std::size_t number = 0;
        for (const BinHull& hull : hulls) {
            const HorizonBuffer::Outline outline = _buffer.outlineOf(hull);
            candidate.distance = std::min(candidate.distance, outline.distance);
            if (!outline.isBeside) {
                candidate.isInPicture = true;
                _order.emplace_back(outline.nearest, _quarters.size());
                _quarters.push_back({_candidates.size(), number, outline});
            }
            ++number;
        }
        _candidates.push_back(candidate);
        return true;
    }

    // Terrain that the near plane may cut.
    struct NearTerrain {
        double top = -HUGE_VAL;     // of its picture; infinite where it may be at the eye
        double nearest = HUGE_VAL;  // metres from the eye, roughly
    };

    // All that is between the sides of the picture and within `reach` of the eye. Returns: nullopt where that is not
    // known.
    [[nodiscard]] std::optional<NearTerrain> terrainWithin(double reach) const {
        const core::Interval& across = _found.span.across;
        const double widest = std::max(std::abs(across.lower), std::abs(across.upper));
        NearTerrain terrain;
        std::vector<std::size_t> tiles;
        for (const auto& [nearest, number] : _order) {
            if (nearest - _found.eyes.y > reach) break;
            const Quarter& quarter = _quarters[number];
            const bool isKnown = std::find(tiles.begin(), tiles.end(), quarter.candidate) != tiles.end();
            if (isKnown) continue;
            if (tiles.size() == NearMeshes::kMostTiles) return std::nullopt;
            tiles.push_back(quarter.candidate);
            const ShownTile& tile = *_candidates[quarter.candidate].tile;
            const glm::dvec3 margin = _found.eyes + tile.tile->getBin().margin();
            const double radius = (reach + 2.0 * std::max(margin.x, margin.y)) * (1.0 + widest);
            const core::EcefMesh* const mesh = _meshes.trianglesNear(*tile.tile, *tile.mesh, _found.eye, radius);
            if (!mesh) return std::nullopt;
            add(*mesh, reach, margin, terrain);
        }
        return terrain;
    }

    // Triangles that may be `margin` metres away from their place, along each axis.
    void add(const core::EcefMesh& mesh, double reach, const glm::dvec3& margin, NearTerrain& terrain) const {
        const auto& [eye, right, ahead, up] = _found.eye;
        // inside is where p.normal >= offset
        struct HalfSpace {
            glm::dvec3 normal;
            double offset;
        };
        const auto [left, most] = _found.span.across;
        const std::array<HalfSpace, 4> wedge{HalfSpace{ahead, -margin.y}, HalfSpace{-ahead, -reach - margin.y},
                                             HalfSpace{right - left * ahead, -margin.x - margin.y * std::abs(left)},
                                             HalfSpace{most * ahead - right, -margin.x - margin.y * std::abs(most)}};
        std::vector<double> forward(mesh.size());
        for (std::size_t i = 0; i < mesh.size(); ++i) forward[i] = glm::dot(mesh.vertex(i) - eye, ahead);
        std::vector<glm::dvec3> polygon, clipped;
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const std::uint32_t* const corners = &mesh.triangles[i];
            const auto [least, greatest] = std::minmax({forward[corners[0]], forward[corners[1]], forward[corners[2]]});
            if (least > reach + margin.y || greatest < -margin.y) continue;
            polygon.clear();
            for (std::size_t k = 0; k < 3; ++k) polygon.push_back(mesh.vertex(corners[k]) - eye);
            for (const HalfSpace& half : wedge) {
                clipped.clear();
                for (std::size_t k = 0; k < polygon.size(); ++k) {
                    const glm::dvec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
                    const double da = glm::dot(a, half.normal) - half.offset,
                                 db = glm::dot(b, half.normal) - half.offset;
                    if (da >= 0.0) clipped.push_back(a);
                    if ((da < 0.0) != (db < 0.0)) clipped.push_back(a + da / (da - db) * (b - a));
                }
                polygon.swap(clipped);
            }
            terrain.top = std::max(terrain.top, topOf(polygon, margin));
            for (const glm::dvec3& point : polygon) terrain.nearest = std::min(terrain.nearest, glm::length(point));
        }
    }

    // The greatest y = up / forward of a polygon's points in front of the eye, which are seen from the eye. It is at a
    // corner: along a segment y rises or falls.
    [[nodiscard]] double topOf(const std::vector<glm::dvec3>& polygon, const glm::dvec3& margin) const {
        double top = -HUGE_VAL, highest = -HUGE_VAL, nearest = HUGE_VAL;
        for (const glm::dvec3& point : polygon) {
            const double height = glm::dot(point, _found.eye.z) + margin.z, ahead = glm::dot(point, _found.eye.y);
            highest = std::max(highest, height);
            nearest = std::min(nearest, ahead - margin.y);
            const double distance = height < 0.0 ? ahead + margin.y : ahead - margin.y;
            if (distance > 0.0) top = std::max(top, height / distance);
        }
        return highest >= 0.0 && !(nearest > 0.0) ? HUGE_VAL : top;
    }

    [[nodiscard]] std::shared_ptr<const CoveredPicture> covered() const {
        const auto picture = std::make_shared<CoveredPicture>();
        picture->eye = _found.eye;
        picture->across = _found.span.across;
        picture->heights.reserve(HorizonBuffer::kStrips);
        for (std::size_t strip = 0; strip < HorizonBuffer::kStrips; ++strip)
            picture->heights.push_back(_buffer.covered(strip));
        return picture;
    }

    // Lines of sight that meet earth there come from above the terrain, not from beside it.
    [[nodiscard]] bool isOverRegion(const GeodeticBin& bin) const { return !_region || _region->contains(bin); }
    [[nodiscard]] bool isQuarterOverRegion(const Quarter& quarter) const {
        return isOverRegion(_candidates[quarter.candidate].tile->tile->getBin().bin().quarters()[quarter.number]);
    }

    void addEarth(const Quarter& quarter) {
        const Candidate& candidate = _candidates[quarter.candidate];
        const InstalledTile* const installed = candidate.tile->tile->getInstalledTile();
        const core::GroundPlates* const plates = installed && candidate.tile->isSure ? installed->plates() : nullptr;
        const bool isTileOverRegion = isOverRegion(candidate.tile->tile->getBin().bin());
        if (!plates || (!isTileOverRegion && !isQuarterOverRegion(quarter))) return;
        // a cell should be some strips wide
        constexpr double kStripsOfCell = 8.0;
        const double strips = candidate.size / std::max(candidate.distance, 1e-3 * candidate.size) /
                              _found.span.across.width() * HorizonBuffer::kStrips;
        std::size_t cells = 8;
        while (cells > 2 && strips < kStripsOfCell * static_cast<double>(cells)) cells /= 2;
        // deep enough to reach below what is behind it, and not so deep that columns part
        const AnalyticBinCullCallback& tile = *candidate.tile->tile;
        const double radius = _ellipsoid.polarRadius();
        const double depth =
            std::min(std::min(2.0 * (tile.getBinHigh() - tile.getBinLow()), 0.02 * radius) + 0.25 * candidate.distance,
                     0.09 * radius);
        // coarser cells bridge the gaps between finer ones
        // the cell of the whole tile is added once
        const std::size_t coarsest = candidate.isHidden && isTileOverRegion ? 1 : 2;
        plates->columns(cells, coarsest, quarter.number, depth, _frame, _columns);
        _buffer.add(_columns);
    }

    const core::CoveredRegion* const _region;
    const std::vector<ShownTile>& _shown;
    const core::Ellipsoid& _ellipsoid;
    NearMeshes& _meshes;
    FoundOcclusion& _found;
    const core::InverseFrame _frame;
    HorizonBuffer _buffer;
    std::vector<Candidate> _candidates;
    std::vector<Quarter> _quarters;
    std::vector<std::pair<double, std::size_t>> _order;  // of the quarters, by the distance of the nearest point
    core::EarthColumns _columns;
};

}  // namespace

bool FoundOcclusion::Tile::operator==(const Tile& other) const {
    return std::tie(tile, mesh, isSure, plates, margin, low, high) ==
               std::tie(other.tile, other.mesh, other.isSure, other.plates, other.margin, other.low, other.high) &&
           bin == other.bin;
}

namespace {

bool isOutOfView(const FoundOcclusion::Tile& tile, const core::PlaneSet& view, const core::Ellipsoid& ellipsoid) {
    constexpr double kRoom = 1.0;  // metres, more than rounding
    const GeodeticBin drawn = tile.bin.withAltitude({tile.low, tile.high});
    const auto quarters = core::BinBody(ellipsoid, drawn, tile.margin, core::Frame()).quarters();
    return std::all_of(quarters.begin(), quarters.end(), [&](const BinHull& hull) {
        for (std::size_t i = 0; i < view.size(); ++i) {
            double highest = -HUGE_VAL;
            for (std::size_t k = 0; k < hull.x.size(); ++k)
                highest = std::max(highest, view[i].distance(hull.corner(k)));
            if (highest < -(hull.reach + kRoom)) return true;
        }
        return false;
    });
}

}  // namespace

void FoundOcclusion::leaveOut(const core::PlaneSet& view, const core::Ellipsoid& ellipsoid) {
    if (tiles.size() <= shown.size() || findings.size() != tiles.size()) return;
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (left.size() < shown.size() && tiles[i] == shown[left.size()]) {
            left.push_back(i);
        } else if (findings[i] == Finding::Seen && !isOutOfView(tiles[i], view, ellipsoid)) {
            return;
        }
    }
    if (left.size() != shown.size()) return;
    for (std::size_t i = 0; i < left.size(); ++i) findings[i] = findings[left[i]];
    findings.resize(left.size());
    tiles = shown;
}

void FoundOcclusion::aimAlong(const core::Frame& from, const glm::dvec3& step) {
    constexpr double kViews = 16.0;  // to the middle of the way that is foreseen
    // Shares of the clearance: farther, terrain near the eye hides too little. What is straight ahead only grows.
    constexpr double kAhead = 0.25, kAside = 0.03;
    constexpr double kWobble = 0.02;  // of the way
    // a camera that only turns has an eye that is rounded anew in each view
    const double rounding = 1e-9 * glm::length(from.origin);
    const glm::dvec3 along(glm::dot(step, from.x), glm::dot(step, from.y), glm::dot(step, from.z));
    const double aside = std::hypot(along.x, along.z), length = glm::length(step);
    const double views =
        std::min({kViews, kAside * lastClearance / (aside + kWobble * length), kAhead * lastClearance / length});
    eye = from;
    eyes = glm::dvec3(rounding);
    if (!(length > rounding && views > 0.0)) return;
    eye.origin += views * step;
    eyes += (1.0 + kWobble) * views * glm::abs(along) + kWobble * views * length;
}

bool FoundOcclusion::holds(const glm::dvec3& place) const {
    const glm::dvec3 from = place - eye.origin;
    return std::abs(glm::dot(from, eye.x)) <= eyes.x && std::abs(glm::dot(from, eye.y)) <= eyes.y &&
           std::abs(glm::dot(from, eye.z)) <= eyes.z;
}

bool FoundOcclusion::isJump(const glm::dvec3& step) const {
    constexpr double kJump = 0.5;  // of the clearance
    return glm::length(step) >= kJump * lastClearance;
}

bool findOccluded(const TerrainHider::View& view, const std::vector<ShownTile>& shown, NearMeshes& meshes,
                  FoundOcclusion& found) {
    return OcclusionSearch(view, shown, meshes, found).run();
}

}  // namespace osgAnalyticBin
