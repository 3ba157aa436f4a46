// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainOcclusion.h"

#include "../kit/cull/BinCulling.h"
#include "../kit/cull/CullTraversal.h"
#include "../kit/cull/TileSelection.h"
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

using core::GeodeticBin;

enum class Ground {
    Known,
    Awaited,  // the plates of a tile are not made yet
    Unknown   // a tile may have a hole, or is left out as a small feature
};

// Notes the tiles that are shown.
Ground describe(const ShownDatabase& database, std::vector<FoundOcclusion::Tile>& tiles,
                std::vector<TileSelection::ShownTile>& withoutPlates) {
    osg::CullingSet& cullingSet = database.selected.cullStack.getCurrentCullingSet();
    tiles.clear();
    Ground ground = Ground::Known;
    for (const TileSelection::ShownTile& shown : database.selected.view.selection->shown()) {
        const AnalyticBinCullCallback& tile = *shown.tile;
        const InstalledTile* const installed = tile.getInstalledTile();
        const bool isFitted = !tile.getTerrainShape() || *tile.getTerrainShape() == database.selected.view.shape;
        if (!installed || !isFitted) return Ground::Unknown;
        if (installed->numberOfPlates() == 0) {
            withoutPlates.push_back(shown);
            ground = Ground::Awaited;
            continue;
        }
        const core::GroundPlates* const plates = installed->plates();
        if (!plates || !std::isfinite(plates->least(1, 0, 0))) return Ground::Unknown;
        // osgTerrain tiles have a sphere about their posts, and another one about their mesh
        constexpr double kOfMesh = 0.5;
        const osg::BoundingSphere& bound = shown.mesh->getBound();
        const double radius = (tile.getTerrainShape() ? kOfMesh : 1.0) * static_cast<double>(bound.radius());
        if (isSmall(cullingSet, {osg::Vec3d(bound.center()) * tile.getLocalToEcef(), static_cast<float>(radius)}))
            return Ground::Unknown;
        tiles.push_back({&tile, shown.mesh, shown.isSure, installed->numberOfPlates(), tile.getBin().bin(),
                         tile.getBin().margin(), tile.getBinLow(), tile.getBinHigh()});
    }
    return ground;
}

std::optional<GeodeticBin> regionOf(const ShownDatabase& database) {
    if (!database.region) return std::nullopt;
    return database.region->extents();
}

bool isWithin(const core::Interval& inner, const core::Interval& outer) {
    return inner.lower >= outer.lower && inner.upper <= outer.upper;
}

// Whether what was found holds for a view of these tiles.
bool serves(FoundOcclusion& found, const ShownDatabase& database, const glm::dvec3& eye,
            const std::optional<PictureSpan>& span, double nearReach) {
    // meshes around the eye may change
    constexpr int kMostUses = 64;
    return found.uses++ < kMostUses && found.holds(eye) && span && isWithin(span->across, found.span.across) &&
           span->drawing <= found.span.drawing && span->depthStep <= found.span.depthStep &&
           nearReach <= found.nearReach && found.region == regionOf(database) && found.tiles == found.shown;
}

// Prepares a search that serves as many of the next views as it can, if the camera goes on as it does.
void aim(FoundOcclusion& found, const LevelView& view, const glm::dvec3& eye, const PictureSpan& span,
         const std::optional<PictureSpan>& spanThen) {
    constexpr double kViews = 8.0;       // for which a turn is foreseen
    constexpr double kMostTurned = 0.1;  // of the picture's width
    // the vertical turns as the eye moves
    constexpr double kLeastTurned = 1e-3;
    const glm::dvec3 step = eye - found.lastEye;
    const bool goesOn = spanThen && !found.isJump(step);
    found.aimAlong(view.frameAt(eye), goesOn ? step : glm::dvec3(0.0));
    found.span = span;
    found.span.drawing *= 1.25;
    found.span.depthStep *= 1.25;
    if (!goesOn) return;
    const double width = span.across.width();
    const auto room = [&](double turned) {
        return std::clamp(kViews * turned, kLeastTurned * width, kMostTurned * width);
    };
    found.span.across.lower -= room(found.lastAcross.lower - spanThen->across.lower);
    found.span.across.upper += room(spanThen->across.upper - found.lastAcross.upper);
}

OccludedTiles noteIn(TileSelection& selection, const FoundOcclusion& found) {
    OccludedTiles tiles;
    for (std::size_t i = 0; i < found.findings.size(); ++i) {
        const TileSelection::ShownTile& tile = selection.shown()[i];
        if (found.findings[i] == FoundOcclusion::Finding::Beside || tile.isOutOfView) continue;
        ++tiles.inView;
        if (!found.hides(i, tile) || tile.tile->getInstalledTile()->has(InstalledTile::IgnoresDepth)) continue;
        ++tiles.hidden;
        selection.addOccluded(tile);
    }
    return tiles;
}

}  // namespace

OccludedTiles cullBehindTerrain(const ShownDatabase& database, const Viewpoint& viewpoint,
                                std::shared_ptr<FoundOcclusion>& kept) {
    if (!viewpoint.eye() || !std::isfinite(viewpoint.nearReach())) return {};
    // tiles in front of the near plane are not looked for then
    constexpr osg::CullingSet::Mask kNear = osg::CullingSet::NEAR_PLANE_CULLING;
    if (database.selected.cullStack.getCurrentCullingSet().getCullingMask() & kNear) return {};
    const glm::dvec3& eye = *viewpoint.eye();
    if (database.region && !database.region->holdsSegmentsFrom(eye)) return {};
    const auto view = LevelView::of(database.selected.cullStack, database.selected.view.ellipsoid, eye);
    if (!view) return {};
    if (!kept) kept = std::make_shared<FoundOcclusion>();
    FoundOcclusion& found = *kept;
    OccludedTiles none;
    const Ground ground = describe(database, found.shown, none.withoutPlates);
    none.isAwaited = ground == Ground::Awaited;
    if (ground != Ground::Known) return none;
    const auto spanThen = PictureSpan::of(*view, found.eye);
    found.leaveOut(database.selected.view.planes, database.selected.view.ellipsoid);
    if (!serves(found, database, eye, spanThen, viewpoint.nearReach())) {
        const auto span = PictureSpan::of(*view, view->frameAt(eye));
        if (!span) return {};
        aim(found, *view, eye, *span, spanThen);
        found.tiles = found.shown;
        // it is rounded anew in each view
        found.nearReach = 1.001 * viewpoint.nearReach();
        found.region = regionOf(database);
        if (!findOccluded(database, found)) {
            kept = nullptr;
            return {};
        }
        found.uses = 1;
    }
    BinStatistics::of(database.selected.visitor)
        .setCovered(found.covered, static_cast<unsigned int>(database.selected.visitor.getTraversalNumber()));
    found.lastEye = eye;
    found.lastAcross = PictureSpan::of(*view, found.eye).value_or(found.span).across;
    return noteIn(*database.selected.view.selection, found);
}

}  // namespace osgAnalyticBin
