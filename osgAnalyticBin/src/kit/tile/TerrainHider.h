// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CoveredPicture.h>
#include <osgAnalyticBin/TerrainShape.h>
#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

#include <glm/vec3.hpp>
#include <osg/CullStack>
#include <osg/Node>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace osgAnalyticBin {

class AnalyticBinCullCallback;
class FamilyTile;

/// A tile that a camera's levels of detail show, whether in view or not.
struct ShownTile {
    const AnalyticBinCullCallback* tile;
    osg::Node* mesh;
    const FamilyTile* member;  ///< null: of no family
    bool isSure;               ///< false: it may be shown, or another level in its place
    bool isOnlyLevel;          ///< of the tile, that is shown or waited for
    bool isOutOfView;
    std::uint32_t kept, segment;  ///< where it is in the selection, see TileSelection
};

/// Bounds of the near plane that OSG computes when all is culled. Depths are distances from the plane of the eye, in
/// the unit of eye space.
class NearPlaneBound {
public:
    /// The plane's largest depth where it cuts something that is drawn. `hidden`: shown tiles that are left out, with
    /// all that is below them, by their positions among those that are shown.
    [[nodiscard]] virtual double most(const std::vector<std::size_t>& hidden) const = 0;
    /// The plane's least depth, if nothing is left out. Returns: 0 where none is known.
    [[nodiscard]] virtual double least() const = 0;

protected:
    ~NearPlaneBound() = default;
};

/// Finds the shown tiles that the terrain of others hides. One of these serves one cull visitor and one database; it
/// may keep results from view to view.
class TerrainHider : public osg::Referenced {
public:
    struct View {
        osg::CullStack& cullStack;
        const core::Ellipsoid& ellipsoid;
        const core::PlaneSet& planes;
        const TerrainShape& shape;          ///< in which the terrain is shown
        const core::CoveredRegion* region;  ///< that is covered; null: the globe
        glm::dvec3 eye;
        double nearReach;                 ///< see Viewpoint
        const NearPlaneBound* nearBound;  ///< where OSG computes the near plane; null: it does not
        bool mayWait;                     ///< hide nothing, and leave a search to the next view
    };
    /// Tiles by their positions among those that are shown.
    struct Hidden {
        std::vector<std::size_t> tiles;
        std::size_t inView = 0;     ///< number of tiles in view, hidden ones included
        bool isAwaited = false;     ///< no result yet: tiles have no plates yet, or the search is left to the next view
        bool isForOneView = false;  ///< found anew, by an eye that is moving too fast for what was found before
        std::vector<std::size_t> withoutPlates;
        std::shared_ptr<const CoveredPicture> covered;  ///< null: there was no search
        const char* missing = nullptr;                  ///< the condition for a search; stays
    };

    /// Requires: all tiles that are shown, without holes, and an eye above the ground (eyeAboveWhatIsShown()).
    /// Guarantee: every line of sight to a tile that is hidden meets the mesh of another shown tile before.
    [[nodiscard]] virtual Hidden find(const View& view, const std::vector<ShownTile>& shown) = 0;

    /// Whether terrain hides a ball in the view that find() was last called for. Metres and the frame of `eye`.
    /// `isBehindHorizon`: whether the horizon hides it, if the near plane cuts no terrain in front of it.
    /// Requires: find() returned what is covered.
    /// Guarantee: every line of sight to the ball meets the mesh of a shown tile before, which is drawn.
    [[nodiscard]] virtual bool hidesBall(const glm::dvec3& centre, double radius, bool isBehindHorizon) = 0;

protected:
    ~TerrainHider() override = default;
};

/// Defined by the part `occlusion`, not by the kit. Returns: null in programs without that part.
[[nodiscard]] osg::ref_ptr<TerrainHider> makeTerrainHider();

}  // namespace osgAnalyticBin
