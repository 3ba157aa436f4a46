// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../kit/tile/TerrainHider.h"
#include "LevelPicture.h"
#include "NearMeshes.h"

#include <osgAnalyticBin/CoveredPicture.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/occlusion/BinBody.h>
#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// The tiles that terrain hides from all eyes near a place. Kept from view to view, because the search takes longer
/// than all other culling.
struct FoundOcclusion {
    /// A tile at the time of the search.
    struct Tile {
        const AnalyticBinCullCallback* tile;
        const osg::Node* mesh;
        bool isSure;           ///< see ShownTile
        std::uint64_t plates;  ///< see InstalledTile::numberOfPlates()
        core::GeodeticBin bin;
        double margin, low, high;
        /// What is drawn with it. Requires: isPlaced().
        [[nodiscard]] core::GeodeticBin drawn() const { return bin.withAltitude({low, high}); }
        /// Whether it is known where the tile is.
        [[nodiscard]] bool isPlaced() const;
        [[nodiscard]] OSGANALYTICBIN_EXPORT bool operator==(const Tile& other) const;
    };
    enum class Finding : std::uint8_t {
        Beside,
        Seen,
        Hidden,
        MeshHidden  ///< finer levels of the tile may be seen
    };

    /// A body that a hidden tile is in, or one of several.
    struct HiddenBody {
        std::uint32_t tile;
        core::HorizonBuffer::Outline outline;
    };
    static constexpr std::uint32_t kCame = ~std::uint32_t{0};
    static constexpr std::size_t kMostCome = 64;

    std::vector<Tile> tiles;            ///< all tiles shown in the last view that the result served
    std::vector<Tile> shown;            ///< all tiles shown in the present view; a member to avoid allocations
    std::vector<std::uint32_t> number;  ///< of each of `tiles` in the search; kCame: it has come since
    std::vector<Finding> findings;      ///< one for each number
    std::vector<HiddenBody> hidden;     ///< from front to back
    core::Frame eye{};                  ///< origin: the place; axes: those of the picture
    glm::dvec3 eyes{0.0};               ///< metres from the place to the farthest eyes, along each axis of the picture
    PictureSpan span{};                 ///< of the picture
    double nearReach = 0.0;    ///< metres ahead of the eye that the near plane may cut at most; 0: not considered
    double neededReach = 0.0;  ///< where OSG computes that plane: the same of the last view
    std::optional<core::GeodeticBin> region;
    std::shared_ptr<const CoveredPicture> covered;
    std::optional<core::HorizonBuffer> earth;  ///< all that hides; sorted once it is asked for
    int uses = 0;                              ///< views since the search
    /// @{
    /// Since the search; see follow().
    struct Left {
        std::uint32_t number;
        core::GeodeticBin bin;
        std::array<core::BinHull, 4> quarters;  ///< of what is drawn with it, ECEF
    };
    std::vector<Left> leftView;           ///< tiles that hid others, and are out of view
    std::vector<core::GeodeticBin> come;  ///< of tiles that were not shown then, kMostCome at most
    bool isOutdated = false;              ///< a new search may find more
    /// @}

    /// @{
    /// Of the last view, whether it used the result or not.
    glm::dvec3 lastEye{0.0};
    core::Interval lastAcross{};  ///< along the axes of the picture; empty after a change of view
    double lastClearance = 0.0;   ///< metres from the eye to terrain in the picture, roughly
    /// @}

    /// Sets the place and the box of eyes for an eye that moves on from `from` by `step` in each view. `first`: of the
    /// views to be served, counted from this one.
    OSGANALYTICBIN_EXPORT void aimAlong(const core::Frame& from, const glm::dvec3& step, int first);

    /// Takes over the tiles that are shown now, if the result holds with them. Tiles that hid nothing may have gone.
    /// Those that hid others may have gone out of view, as long as their place is out of view. Where one in view has
    /// gone, its earth is taken away, and hidden tiles are tested once more. Tiles that have come hide nothing, and are
    /// not hidden; `meshOf` is asked for the mesh of each, by its place in `shown`, that the near plane may cut.
    /// Source: doc/theory/occlusion.md, section 5. Returns: whether the result holds.
    using MeshOf = std::function<std::shared_ptr<const core::EcefMesh>(std::size_t)>;
    [[nodiscard]] OSGANALYTICBIN_EXPORT bool follow(const core::PlaneSet& view, const core::Ellipsoid& ellipsoid,
                                                    const MeshOf& meshOf);

    /// Whether the box of eyes contains this one.
    [[nodiscard]] OSGANALYTICBIN_EXPORT bool holds(const glm::dvec3& place) const;

    /// Of one of `tiles`.
    [[nodiscard]] Finding finding(std::size_t i) const {
        return number[i] == kCame ? Finding::Seen : findings[number[i]];
    }
    /// Whether a tile is hidden. `tile`: as it is shown in the present view. Requires: i < tiles.size().
    [[nodiscard]] bool hides(std::size_t i, const ShownTile& tile) const {
        return finding(i) == Finding::Hidden || (finding(i) == Finding::MeshHidden && tile.isOnlyLevel);
    }

    /// Whether the eye has moved too far since the last view for a continuous motion.
    [[nodiscard]] bool isJump(const glm::dvec3& step) const;

private:
    struct Change {
        std::vector<std::uint32_t> lost;                        // numbers of the tiles whose earth is to be taken away
        double top = -std::numeric_limits<double>::infinity();  // of what the near plane may cut of others
    };
    // Takes over the tiles that are shown now. Returns: nullopt where the result does not hold with them.
    [[nodiscard]] std::optional<Change> match(const core::Ellipsoid& ellipsoid, const MeshOf& meshOf);
    void forget(const std::vector<std::uint32_t>& numbers);
};

using FoundPtr = std::unique_ptr<FoundOcclusion>;

/// Prepares a search for shown tiles that are hidden behind the terrain of others: reads the meshes that the near plane
/// may cut, unless they are known, and copies all else that the search needs. So it may run in another thread, while
/// tiles come and go. Requires: all tiles that are shown; in `found` everything is set except the findings. Guarantee:
/// every line of sight to a tile that is found hidden meets the mesh of another shown tile before, for all of the eyes;
/// source: doc/theory/occlusion.md, sections 4 and 5. Returns: the search, to be called once; empty where a mesh, or
/// the place of a tile, is not known. The search returns null where the near plane may cut into terrain. Cost: of the
/// search, a sort of the shown tiles, and a few microseconds for each that is not hidden.
[[nodiscard]] std::function<FoundPtr()> prepareSearch(const TerrainHider::View& view,
                                                      const std::vector<ShownTile>& shown, NearMeshes& meshes,
                                                      FoundPtr found);

}  // namespace osgAnalyticBin
