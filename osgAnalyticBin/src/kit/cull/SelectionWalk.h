// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullCallbacks.h"
#include "CullTraversal.h"
#include "TileFamily.h"
#include "TileSelection.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/CullStack>
#include <osg/Group>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Polytope>
#include <osg/Vec3d>

#include <limits>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// The walk over the tiles that a camera's levels of detail show, which makes the selection of a view. It tests
/// siblings together, chooses levels as osg::PagedLOD does, and keeps what is in view and not hidden. On the way it
/// collects the evidence that what hides is drawn: it also goes to tiles out of view where lines of sight pass above
/// their surface. Cost: reads only the numbers of tiles that are out of view; a few hundred instructions for each that
/// is kept. Source: doc/theory/horizon.md, section 8.
class SelectionWalk {
public:
    /// What evidence is collected for.
    struct Search {
        std::optional<core::Geodetic> place;  ///< of the eye, where it has one
        osg::Vec3d eye{};                     ///< the same in ECEF
        double occluder = 0.0;                ///< metres below the ellipsoid of the occluder; minus infinity: none
        double deepest = 0.0;                 ///< the same: nothing is drawn below
        bool isEager = false;                 ///< a tile that is not drawn whole ends the walk at once
    };
    /// `eye` null: nothing is hidden. `search` null: no evidence is collected. Otherwise a hole ends the walk, and what
    /// was selected is of no use then.
    SelectionWalk(const DatabaseView& view, const core::HorizonEye* eye, const Search* search);

    /// Walks over the database.
    void select(osg::Group& root);

    /// Walks below the group of a family that culls in this traversal. Returns: the segment. It adds to the selection.
    [[nodiscard]] TileSelection::Number selectBelow(osg::Group& group, const TileFamily& family);

    /// @{
    /// For evidence, after select().
    /// Metres below the ellipsoid of the lowest surface that is shown; negative above it.
    [[nodiscard]] double depth() const { return _depth; }
    /// Whether the terrain in view may be left out somewhere, or be seen through, by what is known of tiles as wholes.
    [[nodiscard]] bool hasHole() const { return _hasHole; }
    /// Whether the own meshes of all tiles that are shown are drawn whole.
    [[nodiscard]] bool areMeshesDrawn() const;
    /// A surface that is shown about the place of the eye, no lower than the eye by its bounds.
    struct NearGround {
        const AnalyticBinCullCallback* tile;
        osg::Node* mesh;
        bool isFinerAwaited;  ///< it stands in for a finer level
    };
    [[nodiscard]] const std::vector<NearGround>& nearGround() const { return _nearGround; }
    /// @}

private:
    using Number = TileSelection::Number;
    using Way = TileSelection::Way;
    // A tile that the walk has come to.
    struct Tile {
        const AnalyticBinCullCallback& callback;
        const TileBlock::Slot& numbers;
        bool isFitted;             // to the shape in which the terrain is shown
        const FamilyTile* member;  // null: of no family
        bool isEnteredByOsg;       // which tests spheres within the tile
        bool isAboutEye;
        bool isOutOfView = false;
        bool isCertain = false;  // see InstalledTile; in doubt that has to be asked
        Number kept = TileSelection::kNone;
    };

    // What is known of siblings together; bits as in the verdicts.
    struct Siblings {
        const TileFamily& family;
        TileFamily::Verdicts verdicts{};
        std::uint64_t kept = 0, certain = 0;
        // for evidence
        std::uint64_t searched = 0, inView = 0;
        std::uint64_t withColumns = 0;  // those whose column has to be asked
        bool mayHoldEye = false;
    };

    void selectChildren(osg::Group& group, const TileFamily* family);
    void selectFamily(osg::Group& group, const TileFamily& family);
    [[nodiscard]] std::uint64_t keptOf(const TileFamily& family, unsigned int first,
                                       const TileFamily::Verdicts& verdicts);
    void countGain(const TileFamily& family, unsigned int first, std::uint64_t members, std::uint64_t culled);
    void describe(Siblings& siblings, const TileBlock::Part& part) const;
    void selectMember(osg::Node& node, const Siblings& siblings, unsigned int slot);
    void selectNode(osg::Node& node);
    void selectGroup(osg::Node& node, const TileFamily* family);
    void selectInside(osg::Group& group, const TileFamily* family);
    static void noteFootprint(const osg::PagedLOD& node, const FamilyTile& member, const osg::Node& level,
                              const TileFamily* family);
    void searchNode(osg::Node& node);
    void searchTileWithoutFamily(osg::Node& node, const AnalyticBinCullCallback& bin, bool leavesOut);
    void searchTile(osg::Node& node, osg::PagedLOD* paged, const Tile& tile);
    void searchPaged(osg::PagedLOD& node, const Tile& tile);
    void searchChild(osg::PagedLOD& node, unsigned int i, const Tile& tile, bool isOnlyLevel);
    void doubtLevelsOf(const Tile& tile);
    [[nodiscard]] static bool hasGapBelow(const Tile& tile);
    [[nodiscard]] bool selectShownLevel(osg::PagedLOD& node, const Tile& tile);
    [[nodiscard]] static core::Interval surfaceOf(const Tile& tile);
    void show(const Tile& tile, osg::Node& mesh, bool isOnlyLevel);

    [[nodiscard]] Number keep(osg::Node& node, const FamilyTile* member, Way way, bool waits = false);
    // Call where something that hides may not be drawn. In a level that is added to a mesh, the walk goes on: only the
    // tiles from there to the end of the scope hide nothing.
    void doubt() {
        _hasHole = _hasHole || (_searches && !_isAdded);
        _searches = _searches && !_isAdded;
    }
    [[nodiscard]] DrawnState stateOf(const osg::Node& node) const;
    [[nodiscard]] bool mayLeaveOut(const CullCallbacks& callbacks) const;
    [[nodiscard]] const TileFamily* inlineFamily(const osg::Node& node) const;
    [[nodiscard]] bool isPassedOver(const osg::Group& group, const TileFamily& family);
    [[nodiscard]] bool isOverEye(const osg::Vec3d& center, double radius);
    [[nodiscard]] bool mayBeAbout(const TileBlock::Slot& tile) const;
    [[nodiscard]] bool isColumnSeen(const TileBlock::Slot& numbers, const TileBlock& block, unsigned int slot) const;
    [[nodiscard]] osg::BoundingSphere sphereOf(const osg::Node& node) const;
    [[nodiscard]] bool isLeftOut(const osg::Node& node) const;
    [[nodiscard]] bool isSmallFeature(const osg::Node& node) const;
    [[nodiscard]] osg::Matrixd frameInside(const osg::Node& node) const;
    [[nodiscard]] bool standsAsInstalled(const osg::Node& node, const AnalyticBinCullCallback& tile) const;
    [[nodiscard]] bool isSurelyDrawn(const osg::Node& node, bool leavesOut) const;
    [[nodiscard]] bool isDrawnWhole(const osg::Node& mesh, const AnalyticBinCullCallback& tile,
                                    const FamilyTile* member) const;
    [[nodiscard]] bool isDrawnWhole(const osg::Node& part, bool isAnyTechnique, bool& hasDrawable) const;
    [[nodiscard]] bool isAbout(const AnalyticBinCullCallback& tile) const;
    [[nodiscard]] bool isBeside(const Tile& tile) const;
    [[nodiscard]] bool isBesideFrustum(const osg::Vec3d& center, double radius,
                                       core::PlaneMask planes = ~core::PlaneMask{0}) const;
    [[nodiscard]] bool isBesideFrustum(const osg::BoundingSphere& sphere) const {
        return sphere.valid() && isBesideFrustum(sphere.center(), sphere.radius());
    }
    [[nodiscard]] bool isLeftOutInView(const Tile& tile, const osg::Node& mesh) const;

    const DatabaseView& _view;
    osg::NodeVisitor& _visitor;
    TileSelection& _selection;
    const TileFamily::Hiding _hiding;
    const Search _search;
    const bool _isPlainVisitor;
    const osg::Polytope::PlaneList& _planes;
    bool _testsSmallFeatures = false;
    std::optional<osg::Vec3d> _up;  // at the eye, once it is needed

    // Of the node where the walk is:
    bool _searches = false;                  // for evidence
    bool _keeps = true;                      // what is in view is drawn
    Number _segment = TileSelection::kNone;  // kNone: OSG enters what is here by itself
    Number _in = TileSelection::kNone;       // the innermost place
    core::PlaneMask _undecided = 0;          // of the view's planes
    const osg::Matrixd* _toEcef = nullptr;   // below a transform, where OSG measures distances in another frame
    bool _ignoresDepth = false;              // by a state above: nothing is hidden
    bool _isDoubtful = false;                // below something that may not be drawn
    bool _isBelowOutOfView = false;          // below a sphere that is out of view
    bool _isChoiceUnknown = false;           // below a choice of levels that may turn out otherwise
    bool _isFinerAwaited = false;            // in a level that stands in for a finer one
    bool _isAdded = false;                   // in a level that is shown with the own mesh of a tile

    bool _hasHole = false;
    std::vector<NearGround> _nearGround;
    double _depth = -std::numeric_limits<double>::infinity();
};

}  // namespace osgAnalyticBin
