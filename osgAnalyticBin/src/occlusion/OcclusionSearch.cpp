// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "OcclusionSearch.h"

#include "../kit/tile/InstalledTile.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

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
using core::GroundPlates;
using core::HorizonBuffer;

// A shown tile.
struct Candidate {
    const FoundOcclusion::Tile* tile;
    const GroundPlates* plates;  // null: not known
    bool isOnlyLevel;
    double distance = HUGE_VAL;  // metres from the eye to a corner of the bin, the nearest one
    bool isHidden = true;        // as far as is known
    bool isMeshAlone = false;    // finer levels may reach higher
    bool isInPicture = false;    // at least one quarter is
};

// A quarter of a tile's bin that is not beside the picture. Quarters are tested one by one, because more terrain is in
// front of the farther ones.
struct Quarter {
    std::size_t candidate, number;
    HorizonBuffer::Outline outline;  // of all that is drawn with it
};

// Metres ahead of the eye's place within which the near plane may cut terrain.
double reachOf(const FoundOcclusion& found) {
    return 1.01 * found.nearReach;
}

// Whether nothing in a ball is between the sides of the picture and within reach of the near plane, from all eyes.
bool isBeyondNear(const HorizonBuffer& picture, const core::BinBall& ball, const FoundOcclusion& found) {
    constexpr double kRounding = 1.0;  // metres, and more
    return ball.centre.y - ball.radius - kRounding > reachOf(found) + found.eyes.y || picture.isBeside(ball);
}

// Whether something of a tile may be between the sides of the picture and within reach of the near plane.
bool isNear(const FoundOcclusion::Tile& tile, const HorizonBuffer& picture, const core::Ellipsoid& ellipsoid,
            const core::InverseFrame& frame, const FoundOcclusion& found) {
    const GeodeticBin drawn = tile.drawn();
    const core::BinBody body(ellipsoid, drawn, tile.margin, frame);
    if (isBeyondNear(picture, body.ball(), found)) return false;
    const auto hulls = body.quarters();
    return std::any_of(hulls.begin(), hulls.end(), [&](const BinHull& hull) {
        const HorizonBuffer::Outline outline = picture.outlineOf(hull);
        return !outline.isBeside && !(outline.nearest > reachOf(found) + found.eyes.y);
    });
}

std::shared_ptr<const CoveredPicture> coveredIn(const FoundOcclusion& found, const HorizonBuffer& earth) {
    const auto picture = std::make_shared<CoveredPicture>();
    picture->eye = found.eye;
    picture->across = found.span.across;
    picture->heights.reserve(HorizonBuffer::kStrips);
    for (std::size_t strip = 0; strip < HorizonBuffer::kStrips; ++strip)
        picture->heights.push_back(earth.covered(strip));
    return picture;
}

// Terrain that the near plane may cut.
struct NearTerrain {
    double top = -HUGE_VAL;     // of its picture; infinite where it may be at the eye
    double nearest = HUGE_VAL;  // metres from the eye, roughly
};

// The greatest y = up / forward of a polygon's points in front of the eye, which are seen from the eye. It is at a
// corner: along a segment y rises or falls.
double topOf(const std::vector<glm::dvec3>& polygon, const core::Frame& eye, const glm::dvec3& margin) {
    double top = -HUGE_VAL, highest = -HUGE_VAL, nearest = HUGE_VAL;
    for (const glm::dvec3& point : polygon) {
        const double height = glm::dot(point, eye.z) + margin.z, ahead = glm::dot(point, eye.y);
        highest = std::max(highest, height);
        nearest = std::min(nearest, ahead - margin.y);
        const double distance = height < 0.0 ? ahead + margin.y : ahead - margin.y;
        if (distance > 0.0) top = std::max(top, height / distance);
    }
    return highest >= 0.0 && !(nearest > 0.0) ? HUGE_VAL : top;
}

// Of a mesh that may be `ofTile` metres away from its place.
NearTerrain nearTerrain(const core::EcefMesh& mesh, double ofTile, const FoundOcclusion& found) {
    NearTerrain terrain;
    const glm::dvec3 margin = found.eyes + ofTile;
    const double reach = reachOf(found);
    const auto& [eye, right, ahead, up] = found.eye;
    // inside is where p.normal >= offset
    struct HalfSpace {
        glm::dvec3 normal;
        double offset;
    };
    const auto [left, most] = found.span.across;
    const std::array<HalfSpace, 4> wedge{HalfSpace{ahead, -margin.y}, HalfSpace{-ahead, -reach - margin.y},
                                         HalfSpace{right - left * ahead, -margin.x - margin.y * std::abs(left)},
                                         HalfSpace{most * ahead - right, -margin.x - margin.y * std::abs(most)}};
    std::vector<double> forward(mesh.size());
    for (std::size_t i = 0; i < mesh.size(); ++i) forward[i] = glm::dot(mesh.vertex(i) - eye, ahead);
    std::vector<glm::dvec3> polygon, clipped;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const std::uint32_t* const corners = &mesh.triangles[i];
        const double p = forward[corners[0]], q = forward[corners[1]], r = forward[corners[2]];
        if (std::min(p, std::min(q, r)) > reach + margin.y || std::max(p, std::max(q, r)) < -margin.y) continue;
        polygon.clear();
        for (std::size_t k = 0; k < 3; ++k) polygon.push_back(mesh.vertex(corners[k]) - eye);
        for (const HalfSpace& half : wedge) {
            clipped.clear();
            for (std::size_t k = 0; k < polygon.size(); ++k) {
                const glm::dvec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
                const double da = glm::dot(a, half.normal) - half.offset, db = glm::dot(b, half.normal) - half.offset;
                if (da >= 0.0) clipped.push_back(a);
                if ((da < 0.0) != (db < 0.0)) clipped.push_back(a + da / (da - db) * (b - a));
            }
            polygon.swap(clipped);
        }
        terrain.top = std::max(terrain.top, topOf(polygon, found.eye, margin));
        for (const glm::dvec3& point : polygon) terrain.nearest = std::min(terrain.nearest, glm::length(point));
    }
    return terrain;
}

class OcclusionSearch {
public:
    OcclusionSearch(const TerrainHider::View& view, const std::vector<ShownTile>& shown, FoundPtr found)
        : _region(view.region ? std::optional(*view.region) : std::nullopt),
          _ellipsoid(view.ellipsoid),
          _found(std::move(found)),
          _frame(_found->eye),
          _buffer(glm::length(_found->eye.origin), _found->span.across, _found->span.drawing, _found->span.depthStep,
                  _found->eyes) {
        _candidates.reserve(shown.size());
        _plates.reserve(shown.size());
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const InstalledTile* const installed = shown[i].tile->getInstalledTile();
            _plates.push_back(installed ? installed->plates() : nullptr);
            _candidates.push_back({&_found->tiles[i], _plates.back().get(), shown[i].isOnlyLevel});
        }
    }

    // Reads the meshes that the near plane may cut. Returns: false where something is not known.
    [[nodiscard]] bool prepare(const std::vector<ShownTile>& shown, NearMeshes& meshes) {
        const auto isPlaced = [](const FoundOcclusion::Tile& tile) { return tile.isPlaced(); };
        if (!std::all_of(_found->tiles.begin(), _found->tiles.end(), isPlaced)) return false;
        if (!(_found->nearReach > 0.0)) return true;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const FoundOcclusion::Tile& tile = _found->tiles[i];
            if (!isNear(tile, _buffer, _ellipsoid, _frame, *_found)) continue;
            if (_near.size() == NearMeshes::kMostTiles) return false;
            _near.push_back({meshes.meshOf(*shown[i].tile, *shown[i].mesh), tile.margin});
            if (!_near.back().mesh) return false;
        }
        return true;
    }

    // Returns: null where the near plane may cut terrain at the eye.
    [[nodiscard]] FoundPtr run() {
        NearTerrain terrain;
        for (const NearMesh& near : _near) {
            const NearTerrain one = nearTerrain(*near.mesh, near.margin, *_found);
            terrain = {std::max(terrain.top, one.top), std::min(terrain.nearest, one.nearest)};
        }
        if (!(terrain.top < HUGE_VAL)) return nullptr;
        _buffer.raiseLowest(terrain.top);
        // a search before this one may have supposed another near plane
        _found->number.clear();
        _found->findings.clear();
        _found->hidden.clear();
        _quarters.reserve(2 * _candidates.size());
        _order.reserve(2 * _candidates.size());
        for (std::size_t i = 0; i < _candidates.size(); ++i) addQuarters(i);
        std::sort(_order.begin(), _order.end());
        for (const auto& [nearest, number] : _order) {
            const Quarter& quarter = _quarters[number];
            if (isHidden(quarter)) continue;
            addEarth(quarter);
            _candidates[quarter.candidate].isHidden = false;
        }
        _found->lastClearance = std::min(terrain.nearest, _buffer.nearestEarth());
        _found->covered = coveredIn(*_found, _buffer);
        for (const Candidate& candidate : _candidates) {
            using Finding = FoundOcclusion::Finding;
            const Finding hidden = candidate.isMeshAlone ? Finding::MeshHidden : Finding::Hidden;
            const Finding inPicture = candidate.isHidden ? hidden : Finding::Seen;
            _found->number.push_back(static_cast<std::uint32_t>(_found->findings.size()));
            _found->findings.push_back(candidate.isInPicture ? inPicture : Finding::Beside);
        }
        _found->earth = std::move(_buffer);
        return std::move(_found);
    }

private:
    void addQuarters(std::size_t number) {
        Candidate& candidate = _candidates[number];
        const GeodeticBin drawn = candidate.tile->drawn();
        const core::BinBody body(_ellipsoid, drawn, candidate.tile->margin, _frame);
        if (_buffer.isBeside(body.ball())) return;
        auto hulls = body.quarters();
        for (std::size_t i = 0; i < hulls.size(); ++i) {
            if (isMeshAll(candidate)) lower(hulls[i], candidate.plates->mostOfQuarter(i, drawn), candidate);
            const HorizonBuffer::Outline outline = _buffer.outlineOf(hulls[i]);
            candidate.distance = std::min(candidate.distance, outline.distance);
            if (outline.isBeside) continue;
            candidate.isInPicture = true;
            _order.emplace_back(outline.nearest, _quarters.size());
            _quarters.push_back({number, i, outline});
        }
    }

    // Whether a quarter is hidden, or all four parts of it: they are smaller, and most are lower. Only earth in front
    // of the whole quarter counts, because earth is used front to back.
    [[nodiscard]] bool isHidden(const Quarter& quarter) {
        const auto number = static_cast<std::uint32_t>(quarter.candidate);
        std::vector<FoundOcclusion::HiddenBody>& hidden = _found->hidden;
        if (_buffer.hides(quarter.outline)) {
            hidden.push_back({number, quarter.outline});
            return true;
        }
        const std::size_t before = hidden.size();
        Candidate& candidate = _candidates[quarter.candidate];
        const GeodeticBin drawn = candidate.tile->drawn(), bin = drawn.quarters()[quarter.number];
        auto hulls = core::BinBody(_ellipsoid, bin, candidate.tile->margin, _frame).quarters();
        for (std::size_t i = 0; i < hulls.size(); ++i) {
            if (isMeshAll(candidate)) lower(hulls[i], candidate.plates->most(4 * quarter.number + i, drawn), candidate);
            HorizonBuffer::Outline outline = _buffer.outlineOf(hulls[i]);
            outline.nearest = quarter.outline.nearest;
            if (outline.isBeside) continue;
            if (!_buffer.hides(outline)) {
                hidden.resize(before);
                return false;
            }
            hidden.push_back({number, outline});
        }
        return true;
    }

    // Whether a tile draws nothing above a mesh of known height.
    [[nodiscard]] static bool isMeshAll(const Candidate& candidate) {
        return candidate.plates && candidate.isOnlyLevel;
    }

    // Leaves out of a body of the tile what is above `top`.
    static void lower(BinHull& hull, double top, Candidate& candidate) {
        if (!(top < candidate.tile->high)) return;
        hull.lowerTop(top, {candidate.tile->low, candidate.tile->high});
        candidate.isMeshAlone = true;
    }

    // Lines of sight that meet earth there come from above the terrain, not from beside it.
    [[nodiscard]] bool isOverRegion(const GeodeticBin& bin) const { return !_region || _region->contains(bin); }

    void addEarth(const Quarter& quarter) {
        const Candidate& candidate = _candidates[quarter.candidate];
        const FoundOcclusion::Tile& tile = *candidate.tile;
        const bool isTileOverRegion = isOverRegion(tile.bin);
        if (!candidate.plates || !tile.isSure) return;
        if (!isTileOverRegion && !isOverRegion(tile.bin.quarters()[quarter.number])) return;
        // deep enough to reach below what is behind it, and not so deep that columns part
        const double radius = _ellipsoid.polarRadius();
        const double depth =
            std::min(std::min(2.0 * (tile.high - tile.low), 0.02 * radius) + 0.25 * candidate.distance, 0.09 * radius);
        // coarser cells bridge the gaps between finer ones
        // the cell of the whole tile is added once
        const std::size_t coarsest = candidate.isHidden && isTileOverRegion ? 1 : 2;
        // finer cells that stand out by less than this share of a strip's width hide hardly more
        constexpr double kWorth = 0.1;
        const double worth = kWorth * candidate.distance * _found->span.across.width() / HorizonBuffer::kStrips;
        candidate.plates->columns(GroundPlates::kFinest, coarsest, quarter.number, depth, worth, _frame, _columns);
        _buffer.add(_columns, static_cast<std::uint32_t>(quarter.candidate));
    }

    const std::optional<core::CoveredRegion> _region;
    const core::Ellipsoid _ellipsoid;
    FoundPtr _found;
    const core::InverseFrame _frame;
    HorizonBuffer _buffer;
    std::vector<std::shared_ptr<const GroundPlates>> _plates;  // held
    struct NearMesh {
        std::shared_ptr<const core::EcefMesh> mesh;
        double margin;
    };
    std::vector<NearMesh> _near;  // between the sides of the picture and within reach of the near plane
    std::vector<Candidate> _candidates;
    std::vector<Quarter> _quarters;
    std::vector<std::pair<double, std::size_t>> _order;  // of the quarters, by the distance of the nearest point
    core::EarthColumns _columns;
};

}  // namespace

bool FoundOcclusion::Tile::isPlaced() const {
    return !bin.empty() && std::isfinite(low) && std::isfinite(high);
}

bool FoundOcclusion::Tile::operator==(const Tile& other) const {
    return std::tie(tile, mesh, isSure, plates, margin, low, high) ==
               std::tie(other.tile, other.mesh, other.isSure, other.plates, other.margin, other.low, other.high) &&
           bin == other.bin;
}

namespace {

std::array<BinHull, 4> quartersOf(const FoundOcclusion::Tile& tile, const core::Ellipsoid& ellipsoid) {
    const GeodeticBin drawn = tile.drawn();
    return core::BinBody(ellipsoid, drawn, tile.margin, core::Frame()).quarters();
}

bool isOutOfView(const std::array<BinHull, 4>& quarters, const core::PlaneSet& view) {
    constexpr double kRoom = 1.0;  // metres, more than rounding
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

// Whether two tiles have a place in common, apart from their borders.
bool areOverOneAnother(const GeodeticBin& a, const GeodeticBin& b) {
    constexpr double kRounding = 1e-12;  // radians, of edges that are the same
    constexpr double kTurn = glm::two_pi<double>();
    if (!(a.latitude().overlap(b.latitude()) > kRounding)) return false;
    const core::Interval& around = b.longitude();
    const double turns = std::round((a.longitude().middle() - around.middle()) / kTurn) * kTurn;
    return a.longitude().overlap({around.lower + turns, around.upper + turns}) > kRounding;
}

}  // namespace

bool FoundOcclusion::follow(const core::PlaneSet& view, const core::Ellipsoid& ellipsoid, const MeshOf& meshOf) {
    std::optional<Change> change = tiles == shown ? Change() : match(ellipsoid, meshOf);
    if (!change) return false;
    const auto isOverOneThatCame = [&](const Left& left) {
        const auto isOver = [&](const GeodeticBin& bin) { return areOverOneAnother(bin, left.bin); };
        return std::any_of(come.begin(), come.end(), isOver);
    };
    // finer levels in a place that is in view again may be lower, and out of view
    const auto isGone = [&](const Left& left) {
        if (isOutOfView(left.quarters, view) && !isOverOneThatCame(left)) return false;
        change->lost.push_back(left.number);
        return true;
    };
    leftView.erase(std::remove_if(leftView.begin(), leftView.end(), isGone), leftView.end());
    // each tile that has come, or left the view, costs a look at all others
    constexpr std::size_t kMostLeft = 16;
    for (; leftView.size() > kMostLeft; leftView.pop_back()) change->lost.push_back(leftView.back().number);
    const bool isRaised = earth && earth->raiseLowest(change->top);
    if (isRaised || !change->lost.empty()) forget(change->lost);
    isOutdated = isOutdated || !change->lost.empty() || !come.empty();
    return true;
}

std::optional<FoundOcclusion::Change> FoundOcclusion::match(const core::Ellipsoid& ellipsoid, const MeshOf& meshOf) {
    const core::InverseFrame frame(eye);
    std::vector<std::uint32_t> now;
    now.reserve(shown.size());
    std::size_t next = 0, near = 0;
    Change change;
    const auto isKnown = [&](const Tile& tile) {
        if (!earth || come.size() == kMostCome || !tile.isPlaced()) return false;
        if (!isNear(tile, *earth, ellipsoid, frame, *this)) return true;
        const auto mesh = ++near <= NearMeshes::kMostTiles ? meshOf(now.size()) : nullptr;
        if (mesh) change.top = std::max(change.top, nearTerrain(*mesh, tile.margin, *this).top);
        return mesh && change.top < HUGE_VAL;
    };
    const auto passUntil = [&](std::size_t end) {
        for (; next < end; ++next) {
            if (number[next] != kCame && findings[number[next]] == Finding::Seen)
                leftView.push_back({number[next], tiles[next].bin, quartersOf(tiles[next], ellipsoid)});
        }
    };
    for (const Tile& tile : shown) {
        const auto from = tiles.begin() + static_cast<std::ptrdiff_t>(next);
        const auto same = static_cast<std::size_t>(std::find(from, tiles.end(), tile) - tiles.begin());
        if (same == tiles.size()) {
            if (!isKnown(tile)) return std::nullopt;
            come.push_back(tile.bin);
            now.push_back(kCame);
        } else {
            passUntil(same);
            now.push_back(number[next++]);
        }
    }
    passUntil(tiles.size());
    number = std::move(now);
    tiles = shown;
    return change;
}

// The earth of these tiles hides nothing any more.
void FoundOcclusion::forget(const std::vector<std::uint32_t>& numbers) {
    if (!earth) return;
    earth->restart(numbers);
    for (const HiddenBody& body : hidden) {
        if (!earth->hides(body.outline)) findings[body.tile] = Finding::Seen;
    }
    covered = coveredIn(*this, *earth);
}

void FoundOcclusion::aimAlong(const core::Frame& from, const glm::dvec3& step, int first) {
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
    const double toMiddle = std::max(static_cast<double>(first), views);
    eye.origin += toMiddle * step;
    eyes += views * glm::abs(along) + kWobble * (toMiddle * glm::abs(along) + toMiddle * length);
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

std::function<FoundPtr()> prepareSearch(const TerrainHider::View& view, const std::vector<ShownTile>& shown,
                                        NearMeshes& meshes, FoundPtr found) {
    const auto search = std::make_shared<OcclusionSearch>(view, shown, std::move(found));
    if (!search->prepare(shown, meshes)) return nullptr;
    return [search] { return search->run(); };
}

}  // namespace osgAnalyticBin
