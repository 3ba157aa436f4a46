// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kit/SmallFeature.h"
#include "../kit/tile/InstalledTile.h"
#include "../kit/tile/TerrainHider.h"
#include "OcclusionSearch.h"
#include "SearchThread.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <future>
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

// By OSG. osgTerrain tiles have a sphere about their posts, and another one about their mesh.
bool isLeftOutAsSmall(osg::CullingSet& cullingSet, const ShownTile& shown) {
    if (!(cullingSet.getCullingMask() & osg::CullingSet::SMALL_FEATURE_CULLING)) return false;
    constexpr double kOfMesh = 0.5;
    const osg::BoundingSphere& bound = shown.mesh->getBound();
    const double radius = (shown.tile->getTerrainShape() ? kOfMesh : 1.0) * static_cast<double>(bound.radius());
    return isSmall(cullingSet, {osg::Vec3d(bound.center()) * shown.tile->getLocalToEcef(), static_cast<float>(radius)});
}

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
        if (!installed->plates()) return Ground::Unknown;
        if (isLeftOutAsSmall(cullingSet, shown)) return Ground::Unknown;
        tiles.push_back({&tile, shown.mesh, shown.isSure, installed->numberOfPlates(), tile.getBin().bin(),
                         tile.getBin().margin(), tile.getBinLow(), tile.getBinHigh()});
    }
    return ground;
}

TerrainHider::Hidden nothingFor(const char* missing) {
    TerrainHider::Hidden hidden;
    hidden.missing = missing;
    return hidden;
}

std::optional<GeodeticBin> regionOf(const TerrainHider::View& view) {
    if (!view.region) return std::nullopt;
    return view.region->extents();
}

// Meshes around the eye may change: what was found is not believed for more views.
constexpr int kMostUses = 64;

// Prepares a search that serves as many views as it can, if the camera goes on as it does. `first`: of these views,
// counted from this one.
void aim(FoundOcclusion& found, const LevelView& view, const glm::dvec3& eye, const PictureSpan& span,
         const std::optional<PictureSpan>& spanThen, int first) {
    constexpr double kViews = 8.0;       // for which a turn is foreseen
    constexpr double kMostTurned = 0.1;  // of the picture's width
    // the vertical turns as the eye moves
    constexpr double kLeastTurned = 1e-3;
    const glm::dvec3 step = eye - found.lastEye;
    const bool goesOn = spanThen && !found.isJump(step);
    found.aimAlong(view.frameAt(eye), goesOn ? step : glm::dvec3(0.0), first);
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

// The shown tiles in view that are hidden.
std::vector<std::size_t> hiddenIn(const FoundOcclusion& found, const std::vector<ShownTile>& shown) {
    std::vector<std::size_t> hidden;
    hidden.reserve(shown.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const ShownTile& tile = shown[i];
        const bool obeysDepth = !tile.tile->getInstalledTile()->has(InstalledTile::IgnoresDepth);
        if (!tile.isOutOfView && found.hides(i, tile) && obeysDepth) hidden.push_back(i);
    }
    return hidden;
}

std::size_t countInView(const FoundOcclusion& found, const std::vector<ShownTile>& shown) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (found.finding(i) != FoundOcclusion::Finding::Beside && !shown[i].isOutOfView) ++count;
    }
    return count;
}

// How far ahead of the eye the near plane cuts something that is drawn at most, in metres along the forward axis of a
// picture, if these tiles are left out. That is at a corner of the view; an oblique plane is not as far at all of them.
double reachOfNear(const TerrainHider::View& view, const LevelView& lines, const core::Frame& picture,
                   const std::vector<std::size_t>& hidden) {
    double atDepth = 0.0, atDistance = 0.0;  // metres ahead of the corners of the view at depth 1 and at distance 1
    for (const glm::dvec3& corner : lines.corners) {
        const double ahead = glm::dot(corner, picture.y);
        atDepth = std::max(atDepth, ahead);
        atDistance = std::max(atDistance, ahead / glm::length(corner));
    }
    return view.nearBound ? atDepth * view.nearBound->most(hidden) : atDistance * view.nearReach;
}

// By what factor the corners of a view may come forward, roughly, as far as the picture has room for a turn.
double turningOf(const LevelView& lines, const FoundOcclusion& found) {
    const auto [left, right] = PictureSpan::of(lines, found.eye).value_or(found.span).across;
    const auto [leftmost, rightmost] = found.span.across;
    return 1.0 + std::max(left - leftmost, rightmost - right) * std::max(std::abs(left), std::abs(right));
}

// What is hidden in a view, and how far ahead the near plane reaches without it.
struct LeftOut {
    std::vector<std::size_t> tiles;  // by their positions among those that are shown
    double reach;                    // metres along the forward axis of the picture
};

LeftOut leftOut(const TerrainHider::View& view, const LevelView& lines, const std::vector<ShownTile>& shown,
                const FoundOcclusion& found) {
    LeftOut left{hiddenIn(found, shown), 0.0};
    left.reach = reachOfNear(view, lines, found.eye, left.tiles);
    return left;
}

// Whether more may be found where the near plane reaches no farther than this.
bool isMuchNearer(double reach, const FoundOcclusion& found) {
    return reach < 0.5 * found.nearReach;
}

// How far ahead of the eye the near plane reaches in the views that a search serves, to begin with. Where OSG computes
// the plane, it follows from what is drawn, and so from what is found: see search().
double reachToBeginWith(const TerrainHider::View& view, const LevelView& lines, const FoundOcclusion& found) {
    constexpr double kLeast = 1.0 / 64.0, kRoom = 1.03;
    // it is rounded anew in each view, and corners of the view come forward as the camera turns
    const double turned = 1.001 * turningOf(lines, found);
    const double farthest = turned * reachOfNear(view, lines, found.eye, {});
    if (!view.nearBound) return farthest;
    const double needed = found.neededReach > 0.0 ? found.neededReach : kLeast * farthest;
    return std::min(farthest, kRoom * turned * needed);
}

// Searches, supposing how far the near plane reaches. If it turns out no farther, the supposition is right. The farther
// it reaches the less is found, so that the search begins with less than it may be. Returns: nullopt where nothing is
// known; `found` is null then.
std::optional<LeftOut> search(const TerrainHider::View& view, const LevelView& lines,
                              const std::vector<ShownTile>& shown, NearMeshes& nearMeshes, FoundPtr& found) {
    constexpr int kMostSearches = 4;
    for (int i = 0; i < kMostSearches; ++i) {
        found->nearReach = reachToBeginWith(view, lines, *found);
        const auto run = prepareSearch(view, shown, nearMeshes, std::move(found));
        if (!run) return std::nullopt;
        found = run();
        if (!found) return std::nullopt;
        LeftOut left = leftOut(view, lines, shown, *found);
        found->neededReach = left.reach;
        const bool isNearEnough = i > 0 || !view.nearBound || !isMuchNearer(left.reach, *found);
        if (left.reach <= found->nearReach && isNearEnough) return left;
    }
    found.reset();
    return std::nullopt;
}

// What a search in this view begins with. `first`: as for aim().
FoundPtr aimed(const FoundOcclusion& last, const TerrainHider::View& view, const LevelView& lines,
               const std::optional<PictureSpan>& spanThen, int first) {
    const auto span = PictureSpan::of(lines, lines.frameAt(view.eye));
    if (!span) return nullptr;
    auto found = std::make_unique<FoundOcclusion>();
    found->lastEye = last.lastEye;
    found->lastAcross = last.lastAcross;
    found->lastClearance = last.lastClearance;
    found->neededReach = last.neededReach;
    aim(*found, lines, view.eye, *span, spanThen, first);
    found->tiles = last.shown;
    found->region = regionOf(view);
    return found;
}

// How many of the next views, up to kForeseen, what was found will serve, if the camera goes on as it does.
constexpr int kForeseen = 3;
int viewsLeft(const FoundOcclusion& found, const glm::dvec3& eye, const core::Interval& across) {
    int views = 0;
    const auto serves = [&](int view) {
        const core::Interval then{across.lower + view * std::min(0.0, across.lower - found.lastAcross.lower),
                                  across.upper + view * std::max(0.0, across.upper - found.lastAcross.upper)};
        return found.uses + view < kMostUses && found.holds(eye + static_cast<double>(view) * (eye - found.lastEye)) &&
               found.span.across.contains(then);
    };
    while (views < kForeseen && serves(views + 1)) ++views;
    return views;
}

// Whether to search anew for tiles that have come or gone. They come in many views, and a search costs as much as all
// other culling; a view that may wait draws those that have come, and does without what they hide.
bool isDue(const FoundOcclusion& found, const TerrainHider::View& view) {
    constexpr int kLeastUses = 8;
    const bool waits = view.mayWait && found.uses < kLeastUses && 2 * found.come.size() < FoundOcclusion::kMostCome;
    return found.isOutdated && !waits;
}

// What is hidden by what was found before, if that holds for this view. `span`: of the view in the picture.
std::optional<LeftOut> served(FoundOcclusion& found, const TerrainHider::View& view, const LevelView& lines,
                              const std::vector<ShownTile>& shown, const std::optional<PictureSpan>& span,
                              NearMeshes& nearMeshes) {
    const auto meshOf = [&](std::size_t i) { return nearMeshes.meshOf(*shown[i].tile, *shown[i].mesh); };
    const bool holds = found.uses++ < kMostUses && found.holds(view.eye) && span &&
                       found.span.across.contains(span->across) && span->drawing <= found.span.drawing &&
                       span->depthStep <= found.span.depthStep && found.region == regionOf(view) &&
                       found.follow(view.planes, view.ellipsoid, meshOf);
    if (!holds) return std::nullopt;
    LeftOut left = leftOut(view, lines, shown, found);
    if (left.reach > found.nearReach || (view.nearBound && isMuchNearer(left.reach, found))) return std::nullopt;
    return left;
}

// Hides shown tiles behind the terrain of others, for an eye above the terrain. It finds nothing for views that look so
// steeply that there is no horizon in front of them, if the near plane may cut into terrain, and if a tile may have a
// hole. The result of a search is used again while the eye has moved little and the result holds for the tiles that are
// shown; the next search is made in another thread. Source: doc/theory/occlusion.md, section 5; tests:
// TerrainOcclusion.*. Cost: some tens of nanoseconds for each shown tile; if there has to be a search, a sort of the
// shown tiles and a few microseconds for each that is not hidden.
class TerrainOcclusion final : public TerrainHider {
public:
    [[nodiscard]] Hidden find(const View& view, const std::vector<ShownTile>& shown) override {
        constexpr const char* kSteep = "a view that is steeper than 78 degrees nowhere";
        constexpr const char* kNearPlane = "a near plane that surely cuts no terrain";
        if (!view.nearBound && !std::isfinite(view.nearReach)) return nothingFor(kNearPlane);
        // tiles in front of the near plane are not looked for then
        constexpr osg::CullingSet::Mask kNear = osg::CullingSet::NEAR_PLANE_CULLING;
        if (view.cullStack.getCurrentCullingSet().getCullingMask() & kNear)
            return nothingFor("no culling by the near plane");
        if (view.region && !view.region->holdsSegmentsFrom(view.eye)) return nothingFor("an eye over the database");
        const auto leastNear = view.nearBound ? std::optional(view.nearBound->least()) : std::nullopt;
        const auto lines = LevelView::of(view.cullStack, view.ellipsoid, view.eye, leastNear);
        if (!lines) return nothingFor(kSteep);
        if (!_found) _found = std::make_unique<FoundOcclusion>();
        _nearMeshes.setMostReads(NearMeshes::kMostTiles);
        Hidden hidden;
        const Ground ground = describe(view, shown, _found->shown, hidden.withoutPlates);
        hidden.isAwaited = ground == Ground::Awaited;
        hidden.missing = hidden.isAwaited ? "tiles that are prepared: wait a moment" : "tiles without holes";
        if (ground != Ground::Known) return hidden;
        auto spanThen = PictureSpan::of(*lines, _found->eye);
        std::optional<LeftOut> left;
        if (_found->isOutdated) left = servedAhead(view, *lines, shown, spanThen);
        if (!left) left = served(*_found, view, *lines, shown, spanThen, _nearMeshes);
        if (!left) left = servedAhead(view, *lines, shown, spanThen);
        if (!left && view.mayWait && leaveToNextView(view, *lines, shown, spanThen)) {
            hidden.isAwaited = true;
            hidden.missing = "a search for this view, which is under way";
            noteView(view.eye, spanThen);
            return hidden;
        }
        if (!left) {
            FoundPtr next = aimed(*_found, view, *lines, spanThen, 0);
            if (!next) return nothingFor(kSteep);
            left = search(view, *lines, shown, _nearMeshes, next);
            if (!left) {
                _found = std::move(next);
                return nothingFor(kNearPlane);
            }
            next->uses = 1;
            next->shown.swap(_found->shown);
            hidden.isForOneView = _found->isJump(view.eye - _found->lastEye);
            takeOver(std::move(next), *lines, spanThen);
        }
        if (!_ahead.valid() && spanThen) {
            const int more = viewsLeft(*_found, view.eye, spanThen->across);
            // while there is time, one mesh is read in each view
            _nearMeshes.setMostReads(more > 0 ? 1 : NearMeshes::kMostTiles);
            const bool isNow = isDue(*_found, view);
            if (isNow || more < kForeseen) searchAhead(view, *lines, shown, spanThen, isNow ? 1 : more + 1);
        }
        hidden.tiles = std::move(left->tiles);
        _found->neededReach = left->reach;
        hidden.inView = countInView(*_found, shown);
        hidden.covered = _found->covered;
        noteView(view.eye, spanThen);
        _isLeftToNext = false;
        return hidden;
    }
    [[nodiscard]] bool hidesBall(const glm::dvec3& centre, double radius, bool isBehindHorizon) override {
        if (!_found || !_found->earth) return false;
        FoundOcclusion& found = *_found;
        core::HorizonBuffer& earth = *found.earth;
        if (!earth.isSorted()) earth.sort();
        const glm::dvec3 from = centre - found.eye.origin;
        const core::BinBall ball{
            {glm::dot(from, found.eye.x), glm::dot(from, found.eye.y), glm::dot(from, found.eye.z)}, radius};
        const core::HorizonBuffer::Outline outline = earth.outlineOf(ball);
        return (isBehindHorizon && earth.isAboveLowest(outline)) || earth.hidesInAnyOrder(outline);
    }

protected:
    ~TerrainOcclusion() override = default;

private:
    // By the search for views that follow, if it serves this one. `spanThen`: in the picture of what was found before.
    [[nodiscard]] std::optional<LeftOut> servedAhead(const View& view, const LevelView& lines,
                                                     const std::vector<ShownTile>& shown,
                                                     std::optional<PictureSpan>& spanThen) {
        if (!_ahead.valid()) return std::nullopt;
        FoundPtr ahead = _ahead.get();
        if (!ahead) return std::nullopt;
        ahead->uses += _found->uses;
        ahead->shown.swap(_found->shown);
        const auto span = PictureSpan::of(lines, ahead->eye);
        std::optional<LeftOut> left = served(*ahead, view, lines, shown, span, _nearMeshes);
        if (!left) {
            ahead->shown.swap(_found->shown);
            return std::nullopt;
        }
        takeOver(std::move(ahead), lines, spanThen);
        return left;
    }

    void noteView(const glm::dvec3& eye, const std::optional<PictureSpan>& span) {
        _found->lastEye = eye;
        _found->lastAcross = span.value_or(_found->span).across;
    }

    // Starts a search in the thread for the next view; this view hides nothing. Where a camera turns faster than
    // before, or clipping planes change, that costs less than to wait. It does not do so twice in succession, nor after
    // a jump, because a picture that stands alone has to be searched for at once. `spanThen`: as for servedAhead().
    // Returns: whether it did.
    [[nodiscard]] bool leaveToNextView(const View& view, const LevelView& lines, const std::vector<ShownTile>& shown,
                                       const std::optional<PictureSpan>& spanThen) {
        if (!_isLeftToNext && spanThen) searchAhead(view, lines, shown, spanThen, 1);
        _isLeftToNext = _ahead.valid();
        return _isLeftToNext;
    }

    // A new result serves from this view on. `spanThen`: in the picture of the old one; afterwards, of the new one.
    void takeOver(FoundPtr found, const LevelView& lines, std::optional<PictureSpan>& spanThen) {
        const auto span = PictureSpan::of(lines, found->eye);
        // the same turn in the other picture
        const core::Interval before = _found->lastAcross, now = spanThen ? spanThen->across : before;
        found->lastEye = _found->lastEye;
        if (span)
            found->lastAcross = {span->across.lower + before.lower - now.lower,
                                 span->across.upper + before.upper - now.upper};
        _found = std::move(found);
        spanThen = span;
    }

    // Starts a search for the views that follow those which what was found serves. `first`: of them, counted from this
    // one.
    void searchAhead(const View& view, const LevelView& lines, const std::vector<ShownTile>& shown,
                     const std::optional<PictureSpan>& spanThen, int first) {
        // it would serve none of them
        if (_found->isJump(view.eye - _found->lastEye)) return;
        FoundPtr next = aimed(*_found, view, lines, spanThen, first);
        if (!next) return;
        next->nearReach = reachToBeginWith(view, lines, *next);
        next->uses = -_found->uses;  // it grows old while the other one serves
        if (auto run = prepareSearch(view, shown, _nearMeshes, std::move(next))) _ahead = _thread.start(std::move(run));
    }

    FoundPtr _found;               // by the last search; null: none
    std::future<FoundPtr> _ahead;  // of a search for the views that follow those which that one serves
    bool _isLeftToNext = false;    // the last search was left to the thread
    SearchThread _thread;
    NearMeshes _nearMeshes;  // last read around the eye
};

}  // namespace

osg::ref_ptr<TerrainHider> makeTerrainHider() {
    return new TerrainOcclusion;
}

}  // namespace osgAnalyticBin
