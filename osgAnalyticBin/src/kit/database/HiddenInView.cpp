// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "HiddenInView.h"

#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../Spheres.h"
#include "../cull/ComputedNear.h"
#include "../cull/DrawnState.h"
#include "../cull/SelectionWalk.h"
#include "../cull/ShownDepth.h"
#include "../cull/Viewpoint.h"

#include <osgAnalyticBin/core/occlusion/BinBody.h>

#include <glm/geometric.hpp>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace osgAnalyticBin {

namespace {

constexpr unsigned int kShortestRest = 8;

// Whether to look for tiles behind terrain in this view.
bool isOcclusionDue(OcclusionUse use, CullTraversal::LastView& last) {
    if (use != OcclusionUse::Auto || last.resting == 0) return use != OcclusionUse::Off;
    --last.resting;
    return false;
}

// After a view in which occlusion did not pay, it rests, for longer each time. A hidden tile saves at least some
// microseconds of drawing; looking for hidden tiles takes three to seven microseconds for each tile in view, and serves
// some views, unless the eye is moving too fast.
void noteHidden(const TerrainHider::Hidden& hidden, CullTraversal::LastView& last) {
    if (hidden.isAwaited) return;
    constexpr unsigned int kLongestRest = 256, kMostForOneView = 8;
    last.forOneView = hidden.isForOneView ? last.forOneView + 1 : 0;
    const bool pays =
        4 * hidden.tiles.size() >= hidden.inView && !hidden.tiles.empty() && last.forOneView < kMostForOneView;
    last.rest = pays ? 0 : std::clamp(2 * last.rest, kShortestRest, kLongestRest);
    last.resting = last.rest;
}

// Where searches have come to nothing for long, as with callbacks on all tiles, some views are enough to look again.
bool isHoleTakenForGranted(OcclusionUse use, CullTraversal::LastView& last) {
    constexpr unsigned int kLong = 16, kSeldom = 8;
    if (use == OcclusionUse::On || last.holes < kLong || last.holes % kSeldom == 0) return false;
    ++last.holes;
    return true;
}

// After a jump to low above the ground the eye may be below coarse meshes until finer ones come. Tiles that the horizon
// hides once they are there are drawn until then, but need no finer levels. If the ground does not come, they ask for
// them.
bool isWaiting(const std::optional<FoundEye>& found, CullTraversal::LastView& last) {
    constexpr unsigned int kLongest = 120;
    last.waits = found && !found->isAboveGround ? last.waits + 1 : 0;
    return last.waits > 0 && last.waits <= kLongest;
}

bool isOver(const core::CoveredRegion& region, const Viewpoint& viewpoint) {
    if (!viewpoint.eye()) return false;
    const core::Geodetic at = region.ellipsoid().toGeodetic(*viewpoint.eye());
    return region.contains({{at.latitude, at.latitude}, {at.longitude, at.longitude}, {0.0, 0.0}});
}

// Whether the eye sees past the region's border before its horizon, however high the terrain is.
bool isHorizonPast(const core::CoveredRegion& region, const Viewpoint& viewpoint) {
    const auto eye = viewpoint.above(region.ellipsoid(), 0.0);
    return eye && !region.holdsHorizonOf(*eye);
}

// Whether the user has said how deep the occluder is.
bool isDepthGiven(const DatabaseView& view, const CullOptions& options) {
    return options.horizonUse == HorizonUse::Given && !view.ellipsoid.isPlane();
}

constexpr const char* kOcclusionOn = "occlusion=on or occlusion=auto";
constexpr const char* kNoGaps = "meshes that cover the globe or a rectangle without gaps";
constexpr const char* kPerspective = "a perspective camera with a depth buffer of 24 bits";
constexpr const char* kEyeOver = "an eye over the database";
constexpr const char* kPlanes = "near and far planes that OSG computes by bounding volumes, or that are set";
constexpr const char* kDrawn = "near and far planes that are set, or a tile that is surely drawn";
constexpr const char* kNotHigh = "an eye that is not high above the terrain";
constexpr const char* kDepths =
    "near and far planes that are set, or nothing but plain nodes and the tiles in the scene";

// Why nothing in this view hides tiles, by what is known of the database as a whole: the condition that is missing.
// Returns: nullptr where something may.
const char* missingToHide(const DatabaseView& view, Database& database, const CullOptions& options, bool isAltered) {
    // in a map nothing else is looked for
    if (view.ellipsoid.isPlane() && options.occlusion == OcclusionUse::Off) return kOcclusionOn;
    if (!isDepthGiven(view, options)) {
        if (options.horizonUse == HorizonUse::Off) return "options without horizon=off";
        if (database.has(Finding::Gap)) return kNoGaps;
    }
    // where other tiles cover the globe, nothing depends on stray ones
    const bool isRelyingOnStrays = (database.has(Finding::Gap) || view.region) && database.has(Finding::StrayTile);
    if (isRelyingOnStrays) return "tiles that stand in one place each";
    if (isAltered) return "no cull callbacks at the root of the database and above";
    const bool hides = !database.isTerrainBlended() && drawnStateAbove(view.visitor, view.rules).hides;
    return hides ? nullptr : "filled and opaque terrain, and declared shaders";
}

// `unknown`: of unknown depth; null: the camera's settings are the reason.
void reportUnknownNearPlane(Database& database, const osg::Node* unknown) {
    // views that follow make no text
    if (database.has(Finding::UnknownNearPlane)) return;
    std::string reason = unknown ? unknown->className() : "the camera's settings";
    if (unknown && !unknown->getName().empty()) reason += " " + unknown->getName();
    database.report(Finding::UnknownNearPlane, reason);
}

// Whether the eye is so high above the terrain, compared with the relief of what is shown, that terrain hides little.
bool isHighAbove(const DatabaseView& view, const glm::dvec3& eye) {
    constexpr double kReliefs = 8.0;
    core::Interval altitudes = core::Interval::none();
    for (const ShownTile& shown : view.selection->shown()) {
        altitudes.expandBy(shown.tile->getBinLow());
        altitudes.expandBy(shown.tile->getBinHigh());
    }
    return view.ellipsoid.toGeodetic(eye).altitude - altitudes.lower > kReliefs * altitudes.width();
}

// Marks what terrain hides in the selection. Returns: the hider if it knows what is covered.
osg::ref_ptr<TerrainHider> selectBehindTerrain(const DatabaseView& view, Database& database, const Viewpoint& viewpoint,
                                               OcclusionUse use, CullTraversal::LastView& last) {
    if (!last.hider) last.hider = makeTerrainHider();
    if (!last.hider) return nullptr;
    osg::NodeVisitor& visitor = view.visitor;
    TileSelection& selection = *view.selection;
    const bool isWorthIt = use == OcclusionUse::On || !isHighAbove(view, *viewpoint.eye());
    database.wantPlates(isWorthIt);
    if (!isWorthIt) {
        view.traversal.statistics().setNotCovered(kNotHigh, visitor.getTraversalNumber());
        noteHidden({}, last);
        return nullptr;
    }
    std::optional<ComputedNear> computed;
    if (!isFinalProjection(view.cullStack)) {
        const osg::Node* unknown = nullptr;
        computed = ComputedNear::of(*visitor.asCullVisitor(), selection, unknown);
        if (unknown) reportUnknownNearPlane(database, unknown);
        if (!computed || !(computed->least() > 0.0)) {
            view.traversal.statistics().setNotCovered(computed ? kDrawn : kDepths, visitor.getTraversalNumber());
            noteHidden({}, last);
            return nullptr;
        }
    }
    view.traversal.hiding.clear();
    const TerrainHider::Hidden hidden =
        last.hider->find({view.cullStack, view.ellipsoid, view.planes, view.shape, view.region, *viewpoint.eye(),
                          viewpoint.nearReach(), computed ? &*computed : nullptr, use == OcclusionUse::Auto},
                         selection.shown());
    for (const std::size_t i : hidden.withoutPlates) {
        const ShownTile& tile = selection.shown()[i];
        Database::of(*tile.tile->getInstalledTile()).askForPlates(*tile.tile, *tile.mesh);
    }
    for (const std::size_t i : hidden.tiles) selection.addOccluded(selection.shown()[i]);
    BinStatistics& statistics = view.traversal.statistics();
    if (hidden.covered) statistics.setCovered(hidden.covered, visitor.getTraversalNumber());
    if (!hidden.covered) statistics.setNotCovered(hidden.missing, visitor.getTraversalNumber());
    noteHidden(hidden, last);
    return hidden.covered ? last.hider : nullptr;
}

// How far from the eye the near plane cuts what is drawn at most, in metres; infinite where that is not known.
double reachOfComputedNear(const DatabaseView& view) {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    osgUtil::CullVisitor& visitor = *view.visitor.asCullVisitor();
    const osg::Node* unknown = nullptr;
    const auto eyeToEcef = affineInverse(*visitor.getModelViewMatrix());
    // tiles in front of the projection's own near plane are left out then
    const bool isNearPlaneCulling =
        visitor.getCurrentCullingSet().getCullingMask() & osg::CullingSet::NEAR_PLANE_CULLING;
    if (!ComputedNear::isPossible(visitor, visitor) || !eyeToEcef || isNearPlaneCulling) return kUnknown;
    const auto near = ComputedNear::of(visitor, *view.selection, unknown);
    if (!near) return kUnknown;
    double toCorner = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
        // written so that NaN stays
        const double length = sightThroughCorner(*visitor.getProjectionMatrix(), corner).length();
        if (!(length <= toCorner)) toCorner = length;
    }
    return near->most({}) * toCorner * stretchOf(*eyeToEcef);
}

// Whether a near plane that reaches so far may cut terrain that is shown.
bool mayCutTerrain(const DatabaseView& view, const glm::dvec3& eye, double reach) {
    if (!std::isfinite(reach)) return true;
    const double lowest = view.ellipsoid.toGeodetic(eye).altitude - reach;
    const core::InverseFrame frame(core::Frame{eye});
    const auto mayBeCut = [&](const ShownTile& shown) {
        const AnalyticBinCullCallback& tile = *shown.tile;
        const core::GeodeticBin& bin = tile.getBin().bin();
        const double margin = tile.getBin().margin();
        const bool isFitted = !tile.getTerrainShape() || *tile.getTerrainShape() == view.shape;
        if (!isFitted || bin.empty() || !std::isfinite(tile.getBinLow())) return true;
        if (tile.getBinHigh() + margin < lowest) return false;
        const core::GeodeticBin drawn = bin.withAltitude({tile.getBinLow(), tile.getBinHigh()});
        const core::BinBall ball = core::BinBody(view.ellipsoid, drawn, margin, frame).ball();
        return !(glm::length(ball.centre) > ball.radius + margin + reach);
    };
    const std::vector<ShownTile>& shown = view.selection->shown();
    return std::any_of(shown.begin(), shown.end(), mayBeCut);
}

}  // namespace

void tellOthers(const DatabaseView& view, const HiddenInView& hidden) {
    osgUtil::CullVisitor* const visitor = view.visitor.asCullVisitor();
    if (!visitor || !hidden.nearReach) return;
    HidingView& hiding = view.traversal.hiding;
    const auto isCutOpen = [&] {
        const double reach = isFinalProjection(view.cullStack) ? *hidden.nearReach : reachOfComputedNear(view);
        const auto eyeToEcef = affineInverse(*view.modelView);
        return !eyeToEcef || mayCutTerrain(view, toGlm(eyeToEcef->getTrans()), reach);
    };
    // where nobody asks, finding out would take longer than saying that it may be
    const bool isAsked = !hidden.hider && hidden.eye && hiding.isInUse(*visitor);
    hiding.set(*visitor, {view.ellipsoid, hidden.eye, hidden.hider, !hidden.hider && (!isAsked || isCutOpen())});
}

HiddenInView findHidden(DatabaseView& view, Database& database, const CullOptions& options, bool isAltered) {
    osg::NodeVisitor& visitor = view.visitor;
    osg::CullStack& cullStack = view.cullStack;
    const core::CoveredRegion* const region = view.region;
    const auto miss = [&](const char* condition) {
        if (condition) view.traversal.statistics().setNotCovered(condition, visitor.getTraversalNumber());
        return condition != nullptr;
    };
    if (miss(missingToHide(view, database, options, isAltered))) return {};
    const auto viewpoint = Viewpoint::of(cullStack, visitor, options.inheritViewpoint);
    if (miss(viewpoint ? nullptr : kPerspective)) return {};
    const bool isMap = view.ellipsoid.isPlane();
    const bool isGiven = isDepthGiven(view, options);
    const double deepest = isGiven ? std::max(0.0, -options.horizon) : std::numeric_limits<double>::infinity();
    CullTraversal::LastView& last = view.traversal.lastView(database, visitor);
    if (isHoleTakenForGranted(options.occlusion, last)) return {};
    view.expectsHole = last.holes > 0;
    // what is hidden among other nodes may be worth a search, too
    HidingView& hiding = view.traversal.hiding;
    if (hiding.isInUse(visitor)) last.resting = std::min(last.resting, kShortestRest);
    if (hiding.takeWorth()) last.rest = last.resting = 0;
    const auto note = [&](HiddenInView found) {
        last.holes = found.isSelected || found.fileEye ? 0 : last.holes + 1;
        if (viewpoint->eye()) found.nearReach = viewpoint->nearReach();
        return found;
    };
    if (isGiven && (database.has(Finding::Gap) || region)) {
        view.region = nullptr;
        miss(kNoGaps);
        const auto eye = eyeAboveDepth(view, *viewpoint, deepest);
        return note({eye, {}, eye.has_value(), {}, {}});
    }
    if (region && !isOver(*region, *viewpoint)) {
        if (!isMap) database.report(Finding::EyeBesideRegion);
        miss(kEyeOver);
        return {};
    }
    const bool isNearPlaneBounded = isFinalProjection(cullStack) || ComputedNear::isPossible(visitor, cullStack);
    if (viewpoint->eye() && options.occlusion != OcclusionUse::Off && !isNearPlaneBounded)
        reportUnknownNearPlane(database, nullptr);
    miss(options.occlusion == OcclusionUse::Off ? kOcclusionOn
         : !viewpoint->eye()                    ? kPerspective
         : !isNearPlaneBounded                  ? kPlanes
                                                : nullptr);
    const bool findsOccluded = viewpoint->eye() && isNearPlaneBounded && isOcclusionDue(options.occlusion, last);
    // Starting from the last frame's depth is quick, and sound, but may stay deeper than a fresh start: the horizon
    // shall not depend on where the camera has been.
    constexpr unsigned int kFreshStart = 16;
    if (visitor.getTraversalNumber() % kFreshStart == 0) last.depth = 0.0;
    const bool hasHorizon = !isMap && !(region && isHorizonPast(*region, *viewpoint));
    const auto found = hasHorizon ? eyeAboveWhatIsShown(view, *viewpoint, deepest, last.depth) : std::nullopt;
    const auto eye = found && found->isAboveGround ? std::optional(found->horizon) : std::nullopt;
    const auto fileEye = isWaiting(found, last) ? std::optional(found->horizon) : std::nullopt;
    // coarse meshes, while finer ones are awaited, may be too deep for a horizon
    const bool isSelected = eye || (findsOccluded && region && selectWithoutHorizon(view, *viewpoint));
    osg::ref_ptr<TerrainHider> hider;
    if (isSelected && findsOccluded) hider = selectBehindTerrain(view, database, *viewpoint, options.occlusion, last);
    // a hole leaves nothing to pay for
    if (!isSelected && findsOccluded) {
        noteHidden({}, last);
        miss("an eye above the ground, and tiles in view without holes and callbacks");
    }
    // where there is no horizon and occlusion rests there was no search
    return !hasHorizon && !findsOccluded ? HiddenInView() : note({eye, fileEye, isSelected, {}, hider});
}

}  // namespace osgAnalyticBin
