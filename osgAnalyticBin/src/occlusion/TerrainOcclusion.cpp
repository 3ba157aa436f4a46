// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainOcclusion.h"

#include "../kit/SmallFeature.h"
#include "../kit/tile/InstalledTile.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
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
Ground describe(const TerrainHider::View& view, const std::vector<ShownTile>& allShown,
                std::vector<FoundOcclusion::Tile>& tiles, std::vector<std::size_t>& withoutPlates) {
    osg::CullingSet& cullingSet = view.cullStack.getCurrentCullingSet();
    tiles.clear();
    Ground ground = Ground::Known;
    for (const ShownTile& shown : allShown) {
        const AnalyticBinCullCallback& tile = *shown.tile;
        const InstalledTile* const installed = tile.getInstalledTile();
        const bool isFitted = !tile.getTerrainShape() || *tile.getTerrainShape() == view.shape;
        if (!installed || !isFitted) return Ground::Unknown;
        if (installed->numberOfPlates() == 0) {
            withoutPlates.push_back(static_cast<std::size_t>(&shown - allShown.data()));
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

std::optional<GeodeticBin> regionOf(const TerrainHider::View& view) {
    if (!view.region) return std::nullopt;
    return view.region->extents();
}

bool isWithin(const core::Interval& inner, const core::Interval& outer) {
    return inner.lower >= outer.lower && inner.upper <= outer.upper;
}

// Whether what was found holds for a view of these tiles.
bool serves(FoundOcclusion& found, const TerrainHider::View& view, const std::optional<PictureSpan>& span) {
    // meshes around the eye may change
    constexpr int kMostUses = 64;
    return found.uses++ < kMostUses && found.holds(view.eye) && span && isWithin(span->across, found.span.across) &&
           span->drawing <= found.span.drawing && span->depthStep <= found.span.depthStep &&
           view.nearReach <= found.nearReach && found.region == regionOf(view) && found.tiles == found.shown;
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

void note(const FoundOcclusion& found, const std::vector<ShownTile>& shown, TerrainHider::Hidden& hidden) {
    hidden.tiles.reserve(found.findings.size());
    for (std::size_t i = 0; i < found.findings.size(); ++i) {
        const ShownTile& tile = shown[i];
        if (found.findings[i] == FoundOcclusion::Finding::Beside || tile.isOutOfView) continue;
        ++hidden.inView;
        if (!found.hides(i, tile) || tile.tile->getInstalledTile()->has(InstalledTile::IgnoresDepth)) continue;
        hidden.tiles.push_back(i);
    }
}

}  // namespace

TerrainHider::Hidden TerrainOcclusion::find(const View& view, const std::vector<ShownTile>& shown) {
    if (!std::isfinite(view.nearReach)) return {};
    // tiles in front of the near plane are not looked for then
    constexpr osg::CullingSet::Mask kNear = osg::CullingSet::NEAR_PLANE_CULLING;
    if (view.cullStack.getCurrentCullingSet().getCullingMask() & kNear) return {};
    if (view.region && !view.region->holdsSegmentsFrom(view.eye)) return {};
    const auto lines = LevelView::of(view.cullStack, view.ellipsoid, view.eye);
    if (!lines) return {};
    if (!_found) _found.emplace();
    FoundOcclusion& found = *_found;
    Hidden hidden;
    const Ground ground = describe(view, shown, found.shown, hidden.withoutPlates);
    hidden.isAwaited = ground == Ground::Awaited;
    if (ground != Ground::Known) return hidden;
    const auto spanThen = PictureSpan::of(*lines, found.eye);
    found.leaveOut(view.planes, view.ellipsoid);
    if (!serves(found, view, spanThen)) {
        const auto span = PictureSpan::of(*lines, lines->frameAt(view.eye));
        if (!span) return {};
        aim(found, *lines, view.eye, *span, spanThen);
        found.tiles = found.shown;
        // it is rounded anew in each view
        found.nearReach = 1.001 * view.nearReach;
        found.region = regionOf(view);
        if (!findOccluded(view, shown, _nearMeshes, found)) {
            _found.reset();
            return {};
        }
        found.uses = 1;
    }
    hidden.covered = found.covered;
    found.lastEye = view.eye;
    found.lastAcross = PictureSpan::of(*lines, found.eye).value_or(found.span).across;
    note(found, shown, hidden);
    return hidden;
}

osg::ref_ptr<TerrainHider> makeTerrainHider() {
    return new TerrainOcclusion;
}

}  // namespace osgAnalyticBin
