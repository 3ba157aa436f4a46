// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "LevelPicture.h"
#include "ShownDepth.h"

#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// How many of the shown tiles terrain hides.
struct OccludedTiles {
    std::size_t hidden = 0;
    std::size_t inView = 0;  ///< hidden ones included
    bool isAwaited = false;  ///< nothing is known yet, because tiles have no plates yet
};

/// What terrain hides from every eye within some metres of a place. It is kept from view to view, because finding it
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
        [[nodiscard]] bool operator==(const Tile& other) const;
    };
    enum class Finding : std::uint8_t { Beside, Seen, Hidden };

    std::vector<Tile> tiles;        ///< all that were shown
    std::vector<Finding> findings;  ///< of the tiles
    core::Frame eye{};              ///< the place, and the axes of the picture
    double reach = 0.0;             ///< metres from the place
    PictureSpan span{};             ///< of the picture
    double nearReach = 0.0;         ///< metres that near planes reach at most
    std::optional<core::GeodeticBin> region;
    int uses = 0;  ///< views since then

    /// @{
    /// Of the last view, used or not.
    glm::dvec3 lastEye{0.0};
    core::Interval lastAcross{};  ///< along the axes of the picture; empty where the view was another
    double lastClearance = 0.0;   ///< metres from the eye to terrain in the picture, roughly
    /// @}
};

/// Says in the database's plan which of the shown tiles lie behind the terrain of others, seen from an eye above the
/// terrain. It does nothing for orthographic cameras, for views that look so steeply that there is no horizon in front
/// of them, where the near plane is computed or may cut into terrain, and where a tile may have a hole. `kept`: what
/// was found in the last view of this visitor; it serves again where the same tiles are shown and the eye has moved
/// little.
/// Requires: a plan that has what is shown, and that found no hole in it and the eye above the ground
/// (eyeAboveWhatIsShown()).
/// Guarantee: every line of sight to a tile that is culled meets the mesh of another shown tile before; tests:
/// TerrainOcclusion.*. Source: doc/theory/occlusion.md, section 5.
/// Cost: a few ten nanoseconds for each shown tile; where `kept` does not serve, a sort of the shown tiles and a few
/// microseconds for each that is not hidden.
OccludedTiles cullBehindTerrain(const ShownDatabase& database, const Viewpoint& viewpoint,
                                std::shared_ptr<FoundOcclusion>& kept);

}  // namespace osgAnalyticBin
