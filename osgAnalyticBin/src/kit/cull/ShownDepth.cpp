// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShownDepth.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "../tile/InstalledTile.h"
#include "SelectionWalk.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <algorithm>
#include <limits>

namespace osgAnalyticBin {

namespace {

// From the viewpoint; walkFor() sets the depths.
SelectionWalk::Search searchFrom(const Viewpoint& viewpoint, const DatabaseView& view) {
    SelectionWalk::Search search;
    search.isEager = view.expectsHole;
    if (!viewpoint.eye()) return search;
    search.place = view.ellipsoid.toGeodetic(*viewpoint.eye());
    search.eye = toOsg(*viewpoint.eye());
    return search;
}

// False in doubt, and for terrain tiles whose technique may draw the mesh elsewhere.
bool isBelow(const SelectionWalk::NearGround& close, const core::Geodetic& place, const DatabaseView& view) {
    const AnalyticBinCullCallback& tile = *close.tile;
    if (tile.getTerrainShape() && tile.getTerrainShape()->techniqueMargin > 0.0) return false;
    const InstalledTile* const installed = tile.getInstalledTile();
    const bool isAsRead = installed && !installed->has(InstalledTile::MeshChanged);
    const double margin = tile.getBin().margin();
    const Ground ground{
        tile, *close.mesh, tile.getLocalToEcef(), tile.getBinLow() - margin, tile.getBinHigh() + margin, isAsRead};
    return view.traversal.ground.isBelow(place, ground, view.ellipsoid);
}

// Whether the eye is above the ground, or will be, once finer meshes come.
enum class AboveGround { Yes, NotYet, Unknown };

AboveGround aboveGround(const DatabaseView& view, const SelectionWalk& walk,
                        const std::optional<core::Geodetic>& place) {
    AboveGround above = AboveGround::Yes;
    for (const SelectionWalk::NearGround& close : walk.nearGround()) {
        if (isBelow(close, *place, view)) continue;
        if (!close.isFinerAwaited) return AboveGround::Unknown;
        above = AboveGround::NotYet;
    }
    return above;
}

// Whether all that hides is drawn, and the eye is above it.
bool isTrusted(const DatabaseView& view, const SelectionWalk& walk, const std::optional<core::Geodetic>& place) {
    return !walk.hasHole() && aboveGround(view, walk, place) == AboveGround::Yes && walk.areMeshesDrawn();
}

// Selects for an eye; null: nothing is hidden.
SelectionWalk walkFor(const DatabaseView& view, const core::HorizonEye* eye, SelectionWalk::Search search,
                      double occluder, double deepest) {
    search.occluder = occluder;
    search.deepest = deepest;
    SelectionWalk walk(view, eye, &search);
    walk.select(view.root);
    return walk;
}

}  // namespace

std::optional<FoundEye> eyeAboveWhatIsShown(const DatabaseView& view, const Viewpoint& viewpoint, double deepest,
                                            double& depth) {
    // A deeper occluder has a wider horizon, over which more may be seen that is deeper still. Raised from zero to what
    // is found until nothing deeper is, the depth is the least that will do.
    constexpr int kMostRounds = 16;
    constexpr int kExactRounds = 12;
    constexpr double kRoom = 1.05;
    const core::Ellipsoid& ellipsoid = view.ellipsoid;
    const SelectionWalk::Search search = searchFrom(viewpoint, view);
    const std::optional<core::Geodetic>& place = search.place;
    const double step = 500.0 * core::earthScale(ellipsoid);
    depth = std::clamp(depth, 0.0, deepest);
    for (int round = 0; round < kMostRounds; ++round) {
        const auto eye = viewpoint.above(ellipsoid, depth);
        if (!eye && depth >= deepest) break;
        if (!eye) {
            // the eye may stand in a valley below the ellipsoid
            depth = std::min(2.0 * depth + step, deepest);
            continue;
        }
        if (view.region && !view.region->holdsHorizonOf(*eye)) return std::nullopt;
        const SelectionWalk lowest = walkFor(view, &*eye, search, depth, deepest);
        if (lowest.hasHole()) return std::nullopt;
        if (lowest.depth() <= depth) {
            depth = std::max(lowest.depth(), 0.0);
            // a near plane that cuts the terrain shows the inside of the globe, so no deeper occluder may be used
            const double belowEye = place && place->altitude < 0.0 ? step - place->altitude : 0.0;
            const bool isCutOpen = !viewpoint.above(ellipsoid, std::max(depth, belowEye));
            if (isCutOpen) return std::nullopt;
            const AboveGround above = aboveGround(view, lowest, place);
            if (above == AboveGround::Unknown || !lowest.areMeshesDrawn()) return std::nullopt;
            return FoundEye{*eye, above == AboveGround::Yes};
        }
        if (lowest.depth() > 0.25 * ellipsoid.polarRadius()) break;
        depth = std::min((round < kExactRounds ? 1.0 : kRoom) * lowest.depth(), deepest);
    }
    depth = 0.0;
    const auto eye = std::isfinite(deepest) ? eyeAboveDepth(view, viewpoint, deepest) : std::nullopt;
    return eye ? std::optional(FoundEye{*eye, true}) : std::nullopt;
}

std::optional<core::HorizonEye> eyeAboveDepth(const DatabaseView& view, const Viewpoint& viewpoint, double depth) {
    const core::Ellipsoid& ellipsoid = view.ellipsoid;
    const auto eye = viewpoint.above(ellipsoid, depth);
    if (!eye) return std::nullopt;
    const SelectionWalk::Search search = searchFrom(viewpoint, view);
    const SelectionWalk walk = walkFor(view, &*eye, search, depth, depth);
    return isTrusted(view, walk, search.place) ? eye : std::nullopt;
}

bool selectWithoutHorizon(const DatabaseView& view, const Viewpoint& viewpoint) {
    constexpr double kUnknownDepth = std::numeric_limits<double>::infinity();
    const SelectionWalk::Search search = searchFrom(viewpoint, view);
    return isTrusted(view, walkFor(view, nullptr, search, -kUnknownDepth, kUnknownDepth), search.place);
}

}  // namespace osgAnalyticBin
