// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/TerrainHider.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/Node>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

class TileFamily;

/// What one cull traversal draws of a database, in the order of the traversal: made by SelectionWalk, and then drawn by
/// SelectionDrawing. A segment is what is drawn below a group at which OSG's traversal hands over to a family; below
/// nodes that OSG enters by itself there may be further segments.
class TileSelection {
public:
    using Number = std::uint32_t;
    static constexpr Number kNone = ~Number{0};

    /// A node between the group of a segment and what is kept.
    struct Place {
        osg::Node* node;
        const osg::StateSet* state;
        Number above;          ///< the place that it is in; kNone: the group of the segment
        Number withState;      ///< the nearest place with a state, counted from this one; kNone: none
        Number segment;        ///< that it belongs to
        osg::PagedLOD* paged;  ///< the node, where the traversal goes through one of its levels; null: a group
        unsigned int level;
    };

    /// How a kept node is entered.
    enum class Way : std::uint8_t {
        Mesh,      ///< a tile's own mesh, drawn directly
        Untested,  ///< by OSG, but for its test of the sphere: the tile was tested
        Tile,      ///< by OSG; the tile's own callback is told that the tile was tested
        Plain      ///< by OSG
    };
    struct Kept {
        osg::Node* node;
        const FamilyTile* member;  ///< null: a node that is no tile of a family
        Number place;              ///< that it is in
        Number end;                ///< what comes before this number is below the node
        core::PlaneMask undecided;
        Way way;
        bool isSearched;  ///< what it shows is among the shown tiles
        bool isOccluded;  ///< behind terrain
        bool waits;       ///< drawn as it is: its files are asked for later
    };

    struct Segment {
        const TileFamily* family;
        core::PlaneMask undecided;  ///< where it begins
        Number firstKept, endOfKept, firstPlace, endOfPlaces;
        BinCounts counts;
        bool hides;  ///< something is left out because it is hidden
    };

    /// What a visitor goes by on its way through nodes. Callbacks of an application may change it.
    struct Conditions {
        [[nodiscard]] static Conditions of(const osg::NodeVisitor& visitor, osg::CullStack& cullStack);
        [[nodiscard]] bool operator==(const Conditions& other) const;

        osg::Node::NodeMask traversalMask = 0, maskOverride = 0;
        osg::CullingSet::Mask culling = 0;
        float lodScale = 0.0f;
    };

    /// Nothing is selected under the old conditions any more.
    void begin(const Conditions& conditions);
    [[nodiscard]] const Conditions& conditions() const { return _conditions; }
    void clear();

    /// @{
    /// For the walk.
    Number beginSegment(const TileFamily& family, core::PlaneMask undecided);
    void endSegment(Number segment);
    [[nodiscard]] Segment& segment(Number number) { return _segments[number]; }
    Number enter(osg::Node& node, Number above, Number segment, osg::PagedLOD* paged, unsigned int level);
    Number keep(const Kept& kept);
    /// Says that all that was kept since is below this node.
    void endBelow(Number kept) { _kept[kept].end = static_cast<Number>(_kept.size()); }
    void addShown(const ShownTile& tile) { _shown.push_back(tile); }
    void addFamily(const osg::Referenced& family) { _families.push_back(&family); }
    /// @}

    [[nodiscard]] const std::vector<ShownTile>& shown() const { return _shown; }
    [[nodiscard]] const std::vector<Kept>& kept() const { return _kept; }
    [[nodiscard]] const std::vector<Place>& places() const { return _places; }

    /// Whether what is drawn below a family is selected.
    [[nodiscard]] bool hasSegment(const TileFamily& family) const;

    /// Says that terrain hides one of the shown tiles.
    void addOccluded(const ShownTile& tile);
    /// Whether it hides a tile that is tested alone.
    [[nodiscard]] bool isOccluded(const AnalyticBinCullCallback& tile);

    /// Searches behind the segment that was found last. `undecided`: a segment that lacks one of these planes is not
    /// used; OSG may have found the sphere of a group inside some of the others. Returns: kNone where there is none.
    [[nodiscard]] Number find(const TileFamily& family, core::PlaneMask undecided);

    /// Holds references to all that the selection points to, until it is cleared. Call before code of an application
    /// may run: it may remove nodes.
    void hold();
    /// Whether such code may have run since the selection began.
    [[nodiscard]] bool isHeld() const { return _isHeld; }

    /// Whether all that is selected is below the group of this family.
    [[nodiscard]] bool isAllBelow(const TileFamily& family) const {
        return !_segments.empty() && _segments.front().family == &family;
    }

private:
    Conditions _conditions;
    std::vector<Segment> _segments;
    std::vector<Place> _places;
    std::vector<Kept> _kept;
    std::vector<ShownTile> _shown;
    std::vector<const osg::Referenced*> _families;
    std::vector<osg::ref_ptr<const osg::Referenced>> _held;
    std::size_t _heldFamilies = 0, _heldPlaces = 0, _heldKept = 0;  // how many they are for
    bool _isHeld = false;
    // Sorted when the first tile is asked for: few are tested alone.
    std::vector<const AnalyticBinCullCallback*> _occluded;
    bool _isSorted = true;
    std::size_t _next = 0;
};

}  // namespace osgAnalyticBin
