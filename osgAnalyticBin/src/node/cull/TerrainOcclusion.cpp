// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainOcclusion.h"

#include "../../core/LocalFrame.h"
#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../install/InstalledTile.h"
#include "BinCulling.h"
#include "CullTraversal.h"
#include "TilePlan.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

namespace {

using core::BinHull;
using core::GeodeticBin;
using core::HorizonBuffer;

// The picture of an eye on the vertical plane in front of it.
struct Picture {
    core::Frame eye;  // x to the right, y forward, z up
    core::Interval across;
    double drawing;  // by how much corners of triangles may be drawn elsewhere
};

// Views that look up or down more steeply, or whose corners do, have no picture on a vertical plane.
constexpr double kLevel = 0.2;

std::optional<Picture> pictureOf(const ShownDatabase& database, const glm::dvec3& eye) {
    const osg::Matrixd& projection = *database.cullStack.getProjectionMatrix();
    const auto eyeToWorld = affineInverse(*database.cullStack.getModelViewMatrix());
    osg::Matrixd unproject;
    if (!eyeToWorld || !unproject.invert(projection)) return std::nullopt;
    const auto toWorld = [&](const osg::Vec3d& v) { return toGlm(osg::Matrixd::transform3x3(v, *eyeToWorld)); };
    const core::Geodetic place = database.view.ellipsoid.toGeodetic(eye);
    const glm::dvec3 up = core::LocalFrame(place.latitude, place.longitude).up;
    const glm::dvec3 look = glm::normalize(toWorld({0.0, 0.0, -1.0}));
    const glm::dvec3 level = look - glm::dot(look, up) * up;
    if (!(glm::length(level) > kLevel)) return std::nullopt;
    const glm::dvec3 forward = glm::normalize(level), right = glm::cross(forward, up);
    Picture picture{{eye, right, forward, up}, {1e300, -1e300}, 0.0};
    double levelness = 1.0;
    for (int corner = 0; corner < 4; ++corner) {
        const osg::Vec4d clip(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, 0.5, 1.0);
        const osg::Vec4d point = clip * unproject;
        osg::Vec3d ray(point.x(), point.y(), point.z());
        if (ray.z() * projection(2, 3) < 0.0) ray = -ray;
        const glm::dvec3 direction = toWorld(ray);
        const double ahead = glm::dot(direction, forward), length = glm::length(direction);
        if (!(ahead > kLevel * length)) return std::nullopt;
        const double x = glm::dot(direction, right) / ahead;
        picture.across = {std::min(picture.across.lower, x), std::max(picture.across.upper, x)};
        levelness = std::min(levelness, ahead / length);
    }
    if (!(picture.across.width() > 0.0)) return std::nullopt;
    constexpr double kRounding = 1e-6;
    const double room = kRounding * picture.across.width();
    picture.across = {picture.across.lower - room, picture.across.upper + room};
    // Drivers snap corners to 1/256 of a pixel, both of the tile that hides and of the hidden one. Where the view is
    // not level, pixels are larger in this picture.
    const osg::Viewport* const viewport = database.cullStack.getViewport();
    if (!viewport || !(viewport->width() > 0.0 && viewport->height() > 0.0)) return std::nullopt;
    const double pixels = std::min(viewport->width(), viewport->height());
    picture.drawing = picture.across.width() / (128.0 * pixels * levelness * levelness);
    return picture;
}

// A shown tile.
struct Candidate {
    const TilePlan::ShownTile* tile;
    double distance;   // metres from the eye to a corner of the bin, the nearest one
    double size;       // metres from corner to corner
    bool isHidden;     // as far as is known
    bool isInPicture;  // at least one quarter is
};

// A quarter of a tile's bin. Quarters are tested one by one, because more terrain is in front of the farther ones.
struct Quarter {
    std::size_t candidate, number;
    HorizonBuffer::Outline outline;  // of all that is drawn with it
};

class TerrainOcclusion {
public:
    TerrainOcclusion(const ShownDatabase& database, const Picture& picture)
        : _database(database),
          _ellipsoid(database.view.ellipsoid),
          _plan(*database.view.plan),
          _picture(picture),
          _buffer(glm::length(picture.eye.origin), picture.across, picture.drawing) {}

    // `nearReach`: metres from the eye at which the near plane may still cut terrain away.
    OccludedTiles run(double nearReach) {
        for (const TilePlan::ShownTile& tile : _plan.shown()) {
            if (!isWhole(tile) || !add(tile)) return {};
        }
        std::sort(_order.begin(), _order.end());
        const std::optional<double> lowest = lowestSight(1.01 * nearReach);
        if (!lowest) return {};
        _buffer.setLowest(*lowest);
        for (const auto& [nearest, number] : _order) {
            const Quarter& quarter = _quarters[number];
            if (quarter.outline.isBeside || _buffer.hides(quarter.outline)) continue;
            addEarth(quarter);
            _candidates[quarter.candidate].isHidden = false;
        }
        std::vector<TilePlan::ShownTile> occluded;
        OccludedTiles tiles;
        for (const Candidate& candidate : _candidates) {
            if (!candidate.isInPicture || _plan.isOutOfView(*candidate.tile)) continue;
            ++tiles.inView;
            if (candidate.isHidden) occluded.push_back(*candidate.tile);
        }
        tiles.hidden = occluded.size();
        _plan.setOccluded(occluded);
        return tiles;
    }

private:
    // Returns: false where the place of the tile is not known.
    [[nodiscard]] bool add(const TilePlan::ShownTile& shown) {
        const AnalyticBinCullCallback& tile = *shown.tile;
        const GeodeticBin& bin = tile.getBin().bin();
        const core::Interval altitude{tile.getBinLow(), tile.getBinHigh()};
        if (bin.empty() || !std::isfinite(altitude.lower) || !std::isfinite(altitude.upper)) return false;
        Candidate candidate{&shown, HUGE_VAL, 0.0, true, false};
        const GeodeticBin drawn = bin.withAltitude(altitude);
        const auto hulls = core::hullsOfQuarters(_ellipsoid, drawn, tile.getBin().margin(), _picture.eye);
        candidate.size = 2.0 * glm::distance(hulls.back().corners.front(), hulls.back().corners.back());
        std::size_t number = 0;
        for (const BinHull& hull : hulls) {
            for (const glm::dvec3& corner : hull.corners)
                candidate.distance = std::min(candidate.distance, glm::length(corner));
            const HorizonBuffer::Outline outline = _buffer.outlineOf(hull);
            candidate.isInPicture = candidate.isInPicture || !outline.isBeside;
            _order.emplace_back(outline.nearest, _quarters.size());
            _quarters.push_back({_candidates.size(), number++, outline});
        }
        _candidates.push_back(candidate);
        return true;
    }

    // Whether the mesh of a tile in view is drawn whole, has no holes, and is not left out as a small feature.
    [[nodiscard]] bool isWhole(const TilePlan::ShownTile& shown) const {
        const InstalledTile* const installed = shown.tile->getInstalledTile();
        const core::GroundPlates* const plates = installed ? installed->plates() : nullptr;
        if (!plates || !std::isfinite(plates->least(1, 0, 0))) return false;
        const osg::BoundingSphere& bound = shown.mesh->getBound();
        return !isSmall(_database.cullStack.getCurrentCullingSet(),
                        {osg::Vec3d(bound.center()) * shown.tile->getLocalToEcef(), bound.radius()});
    }

    // Where lines of sight in the picture pass above all terrain that is within `reach` of the eye. Returns: nullopt
    // where that is not known.
    [[nodiscard]] std::optional<double> lowestSight(double reach) const {
        NearMeshes& meshes = CullTraversal::of(_database.visitor).nearMeshes();
        const double widest = std::max(std::abs(_picture.across.lower), std::abs(_picture.across.upper));
        double highest = -HUGE_VAL;  // metres above the eye
        std::vector<std::size_t> tiles;
        for (const auto& [nearest, number] : _order) {
            if (nearest > reach) break;
            const Quarter& quarter = _quarters[number];
            const bool isKnown = std::find(tiles.begin(), tiles.end(), quarter.candidate) != tiles.end();
            if (isKnown || quarter.outline.isBeside) continue;
            if (tiles.size() == NearMeshes::kMostTiles) return std::nullopt;
            tiles.push_back(quarter.candidate);
            const TilePlan::ShownTile& tile = *_candidates[quarter.candidate].tile;
            const double margin = tile.tile->getBin().margin();
            const double radius = (reach + 2.0 * margin) * (1.0 + widest);
            const core::EcefMesh* const mesh = meshes.trianglesNear(*tile.tile, *tile.mesh, _picture.eye, radius);
            if (!mesh) return std::nullopt;
            highest = std::max(highest, highestOf(*mesh, reach, margin));
        }
        if (!(highest < 0.0)) return std::nullopt;
        return highest / reach;
    }

    // Metres above the eye of the highest point of the triangles that is in the picture and within reach.
    [[nodiscard]] double highestOf(const core::EcefMesh& mesh, double reach, double margin) const {
        const auto& [eye, right, ahead, up] = _picture.eye;
        // inside is where p.normal >= offset
        struct HalfSpace {
            glm::dvec3 normal;
            double offset;
        };
        const auto [left, most] = _picture.across;
        const std::array<HalfSpace, 4> wedge{HalfSpace{ahead, -margin}, HalfSpace{-ahead, -reach - margin},
                                             HalfSpace{right - left * ahead, -margin * (1.0 + std::abs(left))},
                                             HalfSpace{most * ahead - right, -margin * (1.0 + std::abs(most))}};
        double highest = -HUGE_VAL;
        std::vector<double> forward(mesh.size());
        for (std::size_t i = 0; i < mesh.size(); ++i) forward[i] = glm::dot(mesh.vertex(i) - eye, ahead);
        std::vector<glm::dvec3> polygon, clipped;
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const std::uint32_t* const corners = &mesh.triangles[i];
            const auto [least, greatest] = std::minmax({forward[corners[0]], forward[corners[1]], forward[corners[2]]});
            if (least > reach + margin || greatest < -margin) continue;
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
            for (const glm::dvec3& point : polygon) highest = std::max(highest, glm::dot(point, up) + margin);
        }
        return highest;
    }

    // Lines of sight that meet earth there come from above the terrain, not from beside it.
    [[nodiscard]] bool isOverRegion(const GeodeticBin& bin) const {
        return !_database.region || _database.region->contains(bin);
    }
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
                              _picture.across.width() * HorizonBuffer::kStrips;
        std::size_t cells = 8;
        while (cells > 2 && strips < kStripsOfCell * static_cast<double>(cells)) cells /= 2;
        // deep enough to reach below what is behind it, and not so deep that columns part
        const AnalyticBinCullCallback& tile = *candidate.tile->tile;
        const double radius = _ellipsoid.polarRadius();
        const double depth =
            std::min(std::min(2.0 * (tile.getBinHigh() - tile.getBinLow()), 0.02 * radius) + 0.25 * candidate.distance,
                     0.09 * radius);
        _columns.clear();
        // coarser cells bridge the gaps between finer ones
        // the cell of the whole tile is added once
        const std::size_t coarsest = candidate.isHidden && isTileOverRegion ? 1 : 2;
        for (; cells >= coarsest; cells /= 2)
            plates->appendColumns(cells, quarter.number, depth, _picture.eye, _columns);
        for (const core::EarthColumn& column : _columns) _buffer.add(column);
    }

    const ShownDatabase& _database;
    const core::Ellipsoid& _ellipsoid;
    TilePlan& _plan;
    const Picture& _picture;
    HorizonBuffer _buffer;
    std::vector<Candidate> _candidates;
    std::vector<Quarter> _quarters;
    std::vector<std::pair<double, std::size_t>> _order;  // of the quarters, by the distance of the nearest point
    std::vector<core::EarthColumn> _columns;
};

}  // namespace

OccludedTiles cullBehindTerrain(const ShownDatabase& database, const Viewpoint& viewpoint) {
    if (!viewpoint.eye() || !database.view.plan || !std::isfinite(viewpoint.nearReach())) return {};
    // tiles in front of the near plane are not looked for then
    constexpr osg::CullingSet::Mask kNear = osg::CullingSet::NEAR_PLANE_CULLING;
    if (database.cullStack.getCurrentCullingSet().getCullingMask() & kNear) return {};
    if (database.region && !database.region->holdsSegmentsFrom(*viewpoint.eye())) return {};
    const auto picture = pictureOf(database, *viewpoint.eye());
    return picture ? TerrainOcclusion(database, *picture).run(viewpoint.nearReach()) : OccludedTiles();
}

}  // namespace osgAnalyticBin
