// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "EmergingTiles.h"

#include "CullTraversal.h"
#include "TilePlan.h"

#include <glm/geometric.hpp>
#include <osg/FrameStamp>

#include <cstddef>
#include <iterator>
#include <utility>

namespace osgAnalyticBin {

void EmergingTiles::look(const ShownDatabase& database, const LevelView& view, const glm::dvec3& eye,
                         const FoundOcclusion& now, bool isBusy) {
    constexpr double kAhead = 1.0;      // seconds
    constexpr double kPeriod = 0.25;    // seconds
    constexpr double kLongFrame = 0.5;  // seconds: no motion is seen in it
    const osg::FrameStamp* const stamp = database.visitor.getFrameStamp();
    if (!stamp) return;
    const double time = stamp->getReferenceTime();
    const double seconds = time - std::exchange(_time, time);
    const glm::dvec3 step = eye - std::exchange(_eye, eye);
    if (time - _lastLook < (isBusy ? 2.0 : 1.0) * kPeriod && time >= _lastLook) return;
    for (auto tile = _tiles.begin(); tile != _tiles.end();)
        tile = time >= tile->second && time - tile->second < kAhead ? std::next(tile) : _tiles.erase(tile);
    // an eye that stands still is rounded anew where the camera turns
    const bool isStill = glm::length(step) <= 1e-9 * glm::length(eye);
    if (isStill || now.isJump(step) || !(seconds > 0.0 && seconds < kLongFrame)) return;
    _lastLook = time;
    _isNearLook = !_isNearLook;
    const double ahead = _isNearLook ? 0.5 * kAhead : kAhead;
    FoundOcclusion then;
    // as the search that will be made there
    then.lastClearance = now.lastClearance;
    then.aimAlong(view.frameAt(eye + ahead / seconds * step), step);
    const auto span = PictureSpan::of(view, then.eye);
    if (!span) return;
    then.span = *span;
    if (!findOccluded(database, then)) return;
    for (std::size_t i = 0; i < now.findings.size(); ++i) {
        const TilePlan::ShownTile& tile = database.view.plan->shown()[i];
        const bool isEmerging = now.hides(i, tile) && then.findings[i] == FoundOcclusion::Finding::Seen;
        if (isEmerging) _tiles[tile.tile] = time;
    }
}

}  // namespace osgAnalyticBin
