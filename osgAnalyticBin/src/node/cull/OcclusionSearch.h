// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "LevelPicture.h"
#include "ShownDepth.h"

#include <osgAnalyticBin/CoveredPicture.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// What terrain hides from every eye near a place. It is kept from view to view, because finding it
/// out takes longer than all other culling.
struct FoundOcclusion {
    /// A tile, as it was then.
    struct Tile {
        const AnalyticBinCullCallback* tile;
        const osg::Node* mesh;
        bool isSure;           ///< see TilePlan::ShownTile
        std::uint64_t plates;  ///< their number
        core::GeodeticBin bin;
        double margin, low, high;
        [[nodiscard]] OSGANALYTICBIN_EXPORT bool operator==(const Tile& other) const;
    };
    enum class Finding : std::uint8_t { Beside, Seen, Hidden };

    std::vector<Tile> tiles;        ///< all that were shown
    std::vector<Tile> shown;        ///< all that this view shows; kept, because allocating takes long
    std::vector<Finding> findings;  ///< of the tiles
    core::Frame eye{};              ///< the place, and the axes of the picture
    glm::dvec3 eyes{0.0};           ///< metres that eyes may be away from the place, along each axis of the picture
    PictureSpan span{};             ///< of the picture
    double nearReach = 0.0;         ///< metres that near planes reach at most; 0: they do not count
    std::optional<core::GeodeticBin> region;
    std::shared_ptr<const CoveredPicture> covered;
    int uses = 0;  ///< views since then

    /// @{
    /// Of the last view, used or not.
    glm::dvec3 lastEye{0.0};
    core::Interval lastAcross{};  ///< along the axes of the picture; empty where the view was another
    double lastClearance = 0.0;   ///< metres from the eye to terrain in the picture, roughly
    /// @}

    /// Aims at the views of an eye that goes on with this step from view to view, from `from` on.
    void aimAlong(const core::Frame& from, const glm::dvec3& step);

    /// Leaves tiles out that are shown no more, where what was found holds without them: such as hid nothing, and such
    /// as are out of view. Source: doc/theory/occlusion.md, section 5.
    OSGANALYTICBIN_EXPORT void leaveOut(const core::PlaneSet& view, const core::Ellipsoid& ellipsoid);

    /// Whether this is one of the eyes.
    [[nodiscard]] bool holds(const glm::dvec3& place) const;

    /// Whether the eye has moved too far since the last view for a motion that goes on.
    [[nodiscard]] bool isJump(const glm::dvec3& step) const;
};

/// Looks for shown tiles behind the terrain of others.
/// Requires: a plan that has what is shown; of `found`: everything but findings, and the tiles.
/// Guarantee: every line of sight to a tile that is found hidden meets the mesh of another shown tile before, for all
/// of the eyes; source: doc/theory/occlusion.md, sections 4 and 5. Returns: false where the near plane may cut into
/// terrain, or where the place of a tile is not known. Cost: a sort of the shown tiles, and a few microseconds for each
/// that is not hidden.
[[nodiscard]] bool findOccluded(const ShownDatabase& database, FoundOcclusion& found);

}  // namespace osgAnalyticBin
