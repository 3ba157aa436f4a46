// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "OcclusionSearch.h"

#include <glm/vec3.hpp>

#include <limits>
#include <unordered_map>

namespace osgAnalyticBin {

/// Tiles that terrain hides now, and that come into view within the next second if the eye goes on as it does. Their
/// files are requested before they are seen.
class EmergingTiles {
public:
    /// Looks ahead four times a second, from where the eye will be in half a second and in one second in turn. Times
    /// are those of the visitor's frame stamp. An eye that stands still or jumps has nothing ahead. `now`: what terrain
    /// hides in this view. `isBusy`: hidden tiles were searched for in this view, so looking ahead is put off. Cost:
    /// that of findOccluded() at each of these times.
    void look(const ShownDatabase& database, const LevelView& view, const glm::dvec3& eye, const FoundOcclusion& now,
              bool isBusy);

    /// Whether the tile was found in the last second.
    [[nodiscard]] bool contains(const AnalyticBinCullCallback& tile) const { return _tiles.count(&tile) != 0; }

private:
    static constexpr double kNever = -std::numeric_limits<double>::infinity();

    // Of the last view, in seconds and ECEF.
    double _time = kNever;
    glm::dvec3 _eye{0.0};

    double _lastLook = kNever;
    bool _isNearLook = false;  // the last look was half a second ahead
    // When each was last found, in seconds.
    std::unordered_map<const AnalyticBinCullCallback*, double> _tiles;
};

}  // namespace osgAnalyticBin
