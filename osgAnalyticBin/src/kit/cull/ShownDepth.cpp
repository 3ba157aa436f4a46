// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShownDepth.h"

#include "../../core/EarthScale.h"
#include "SearchMemory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace osgAnalyticBin {

namespace {

std::optional<core::Geodetic> placeOf(const Viewpoint& viewpoint, const core::Ellipsoid& ellipsoid) {
    if (!viewpoint.eye()) return std::nullopt;
    return ellipsoid.toGeodetic(*viewpoint.eye());
}

// Whether all that hides is drawn, and the eye is above it.
bool isTrusted(const ShownDatabase& database, const SelectionWalk& walk, const std::optional<core::Geodetic>& place) {
    const auto isBelow = [&](const SelectionWalk::NearGround& close) {
        return SearchMemory::of(database.selected.visitor)
            .ground.isBelow(*place, *close.mesh, *close.tile, database.selected.view.ellipsoid);
    };
    const std::vector<SelectionWalk::NearGround>& ground = walk.nearGround();
    return !walk.hasHole() && std::all_of(ground.begin(), ground.end(), isBelow) && walk.areMeshesDrawn();
}

// Selects for an eye.
SelectionWalk walkFor(const ShownDatabase& database, const core::HorizonEye& eye, const SelectionWalk::Search& search) {
    SelectionWalk walk(database.selected, &eye, search);
    walk.select(database.root);
    return walk;
}

}  // namespace

std::optional<core::HorizonEye> eyeAboveWhatIsShown(const ShownDatabase& database, const Viewpoint& viewpoint,
                                                    double deepest, double& depth) {
    // A deeper occluder has a wider horizon, over which more may be seen that is deeper still. Raised from zero to what
    // is found until nothing deeper is, the depth is the least that will do.
    constexpr int kMostRounds = 16;
    constexpr int kExactRounds = 12;
    constexpr double kRoom = 1.05;
    const core::Ellipsoid& ellipsoid = database.selected.view.ellipsoid;
    const std::optional<core::Geodetic> place = placeOf(viewpoint, ellipsoid);
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
        if (database.region && !database.region->holdsHorizonOf(*eye)) return std::nullopt;
        const SelectionWalk lowest = walkFor(database, *eye, {place, depth, deepest, database.expectsHole});
        if (lowest.hasHole()) return std::nullopt;
        if (lowest.depth() <= depth) {
            depth = std::max(lowest.depth(), 0.0);
            // a near plane that cuts the terrain shows the inside of the globe, so no deeper occluder may be used
            const double belowEye = place && place->altitude < 0.0 ? step - place->altitude : 0.0;
            const bool isCutOpen = !viewpoint.above(ellipsoid, std::max(depth, belowEye));
            return !isCutOpen && isTrusted(database, lowest, place) ? eye : std::nullopt;
        }
        if (lowest.depth() > 0.25 * ellipsoid.polarRadius()) break;
        depth = std::min((round < kExactRounds ? 1.0 : kRoom) * lowest.depth(), deepest);
    }
    depth = 0.0;
    return std::isfinite(deepest) ? eyeAboveDepth(database, viewpoint, deepest) : std::nullopt;
}

std::optional<core::HorizonEye> eyeAboveDepth(const ShownDatabase& database, const Viewpoint& viewpoint, double depth) {
    const core::Ellipsoid& ellipsoid = database.selected.view.ellipsoid;
    const auto eye = viewpoint.above(ellipsoid, depth);
    if (!eye) return std::nullopt;
    const std::optional<core::Geodetic> place = placeOf(viewpoint, ellipsoid);
    const SelectionWalk walk = walkFor(database, *eye, {place, depth, depth, database.expectsHole});
    return isTrusted(database, walk, place) ? eye : std::nullopt;
}

bool selectWithoutHorizon(const ShownDatabase& database, const Viewpoint& viewpoint) {
    constexpr double kUnknownDepth = std::numeric_limits<double>::infinity();
    const std::optional<core::Geodetic> place = placeOf(viewpoint, database.selected.view.ellipsoid);
    SelectionWalk walk(database.selected, nullptr, {place, -kUnknownDepth, kUnknownDepth, database.expectsHole});
    walk.select(database.root);
    return isTrusted(database, walk, place);
}

}  // namespace osgAnalyticBin
