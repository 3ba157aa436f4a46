// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/TileBlock.h"
#include "FamilyTile.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/CullStack>
#include <osg/Group>
#include <osg/NodeCallback>
#include <osg/PagedLOD>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

struct DatabaseView;

/// The cull callback of a group with tiles among its children, which are tested together, and what is known of the
/// tiles. On a group of groups with tiles it holds the union of their columns. On all groups that enter all of their
/// children, whatever class they are of, it notices where a tile, or what is above tiles, is taken away. Where OSG's
/// traversal comes to the group, the callback draws what was selected below it, or selects it now. The tiles' own
/// callbacks are used for children that it does not know, in another frame than that of the database, with occluders,
/// and with callbacks behind it. It reports the class name of a plain osg::NodeCallback, so that saved scenes do not
/// contain it.
/// Guarantee: it culls the tiles that their own callbacks would cull; tests: TileFamily.*. Threads: run() changes
/// nothing in the callback.
class TileFamily final : public osg::NodeCallback {
public:
    /// The copy has no tiles.
    TileFamily(const TileFamily& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new TileFamily(*this, copyop); }

    /// Whether a node is a group that always enters all of its children.
    [[nodiscard]] static bool isPossibleOn(const osg::Node& node);

    /// Replaces the node's family, if any, by a new one behind the node's other callbacks. Only removes it if a family
    /// is not possible, or no tile with a bin is below. Families of children have to be placed before. `isAdded`: the
    /// tiles were added by the application and are not missed, so that there need be none on groups that only are above
    /// tiles. Returns: whether there is one.
    static bool place(osg::Node& node, bool isAdded);

    /// Removes the family.
    static void remove(osg::Node& node);

    /// Call when there may be tiles below a node where there were none.
    OSGANALYTICBIN_EXPORT static void expectTilesBelow(osg::Node& node);

    /// Rebuilds the family of a group after the application has added, removed or replaced children; places one where
    /// there was none and the first tile was added. Where tiles stand as they stood, it only looks at models that have
    /// come, and reads meshes anew that have changed. Requires: no cull traversal runs.
    OSGANALYTICBIN_EXPORT static void renew(osg::Node& node);

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

    /// Draws what is kept below the group, to which OSG's traversal has come: by what was selected before, or, where
    /// that does not hold for this traversal, by a selection that is made now.
    /// Guarantee: the visitor comes to all that is kept as it would through OSG's nodes, in the same order, with the
    /// same states, node paths and culling masks, and with time stamps of the levels on the way; tests: TileFamily.*,
    /// FamilyTile.*, Scenes.*, Selection.*. Of what callbacks of an application change on nodes meanwhile, masks
    /// count at once; all else may count from the next traversal on. Requires: culls().
    void draw(osg::Group& group, const DatabaseView& view) const;

    /// The results for up to TileBlock::Part::kMost children, one bit each.
    struct Verdicts {
        Verdicts() { planes.outside = planes.insideAll = 0; }  // masks of slots without a tile are not read

        core::FamilyVerdict planes;
        std::uint64_t members = 0;    ///< the family's tiles; other children are left to their callbacks
        std::uint64_t tested = 0;     ///< slots with a bin
        std::uint64_t beyond = 0;     ///< behind the horizon
        std::uint64_t hidden = 0;     ///< of these, those that are left out
        std::uint64_t separated = 0;  ///< proven outside by an edge of the frustum
        bool lacksTiles = false;      ///< a tile was removed: the terrain may have a hole

        /// Slots whose bin is out of view.
        [[nodiscard]] std::uint64_t outOfView() const { return tested & (planes.outside | hidden | separated); }
    };

    /// Whether the family may cull the children of the group in this traversal.
    [[nodiscard]] bool culls(const osg::Node& group, const DatabaseView& view) const;

    /// What hides tiles; null: nothing.
    struct Hiding {
        const core::HorizonEye* eye = nullptr;
        osg::Vec3d at{};       ///< of the eye
        double tangent = 0.0;  ///< metres from there within which the horizon hides nothing
    };
    /// Tests the children from `first` on, a multiple of kMost. `obeyDepth`: whether they do by the states above.
    void test(const osg::Group& group, unsigned int first, const core::PlaneSet& planes, core::PlaneMask undecided,
              const Hiding& hiding, bool obeyDepth, Verdicts& verdicts) const;

    [[nodiscard]] const FamilyTile& tile(unsigned int i) const { return _tiles[i]; }
    /// Requires: a member.
    [[nodiscard]] const osg::Node& node(unsigned int i) const { return *_nodes[i]; }
    [[nodiscard]] const TileBlock& block() const { return *_block; }

    /// Whether a group has a family that has to notice changes among the children. Others are only above groups,
    /// perhaps deep in each other, where watches would need much stack.
    [[nodiscard]] static bool needsWatch(const osg::Node& group);
    /// The family that was made for a group. Returns: nullptr where there is none.
    [[nodiscard]] static const TileFamily* of(const osg::Node& group);
    /// Whether it holds a child, as a tile or as a node above tiles.
    [[nodiscard]] bool holds(unsigned int slot, const osg::Node& child) const {
        return slot < _nodes.size() && _nodes[slot] == &child;
    }

    /// Call when a group's bound is computed: notices children that were added, removed or replaced.
    static void look(const osg::Node& node);

    /// In a tree of groups: holds the columns of all tiles below the group, and of no models. Returns: nullptr where
    /// there may be other tiles.
    [[nodiscard]] const ColumnUnion* columnUnion(const osg::Group& group) const;
    /// The same for the family of any group. Returns: nullptr also where the group has no family.
    [[nodiscard]] OSGANALYTICBIN_EXPORT static const ColumnUnion* columnUnionOf(osg::Group& group);

    /// Whether a tile, or a node above tiles, was removed from the group since bins were installed: the terrain may
    /// have a hole. `areTilesTested`: test() looks for the tiles of the family.
    [[nodiscard]] bool hasLost(const osg::Group& group, bool areTilesTested) const;
    /// Whether children were added, taken away or moved since the family was made.
    [[nodiscard]] bool hasChanged(const osg::Group& group) const;
    /// Whether a child stood there when the family was made.
    [[nodiscard]] bool isKnown(std::size_t slot, const osg::Node& child) const {
        return slot < _children.size() && _children[slot] == &child;
    }

    /// Whether a child is no tile and has none below it, as models have none: walks skip it. False in doubt. A tile
    /// that the application puts there without addTile() or installBins() is skipped, too: it hides nothing, and
    /// terrain does not hide it. `moved`: by how many slots children have moved, for one child after the other; 0 for
    /// the first.
    [[nodiscard]] bool isWithoutTiles(unsigned int slot, const osg::Node& child, int& moved) const;

    /// Notes what a walk reads on its way from a tile to the family of the tile's finer level, the group `level`.
    void noteMemory(Footprint::Notes& notes, const osg::Group& level) const;

    /// The number of children when the family was made.
    [[nodiscard]] std::size_t size() const { return _nodes.size(); }

protected:
    ~TileFamily() override;

private:
    // `old`: the family in whose place this one comes; null: none.
    TileFamily(osg::Group& group, const TileFamily* old);
    [[nodiscard]] bool add(osg::Node& child, std::size_t slot);
    // Returns: false, and does nothing, unless the group has the same tiles in the same places.
    [[nodiscard]] bool renewInPlace(osg::Group& group);
    [[nodiscard]] bool addFamilyOf(osg::Node& child, std::size_t slot);
    void addOthers(osg::Group& group, const TileFamily* old);
    // Of these tiles, those that may be hidden now.
    [[nodiscard]] std::uint64_t hideable(unsigned int first, std::uint64_t tiles) const;
    void findSeparated(unsigned int first, std::uint64_t candidates, const core::PlaneSet& planes,
                       Verdicts& verdicts) const;

    const osg::Node* _group = nullptr;
    bool _hasTiles = false;
    bool _hasGroups = false;
    bool _hasOthers = false;  // above tiles that are not tested here
    bool _hasLostTiles = false;
    mutable std::atomic<bool> _isDoubted{false};  // its columns, because children have changed
    osg::ref_ptr<TileBlock> _block;
    // one for each child
    // null: the child is no tile and has none below it; references, so that no address is used again
    std::vector<osg::ref_ptr<osg::Node>> _nodes;
    std::vector<FamilyTile> _tiles;
    std::vector<const osg::Node*> _children;
    std::vector<bool> _isWithoutTiles;  // false: there may be tiles
    // the same for all tiles
    std::optional<core::Ellipsoid> _ellipsoid;
    std::optional<TerrainShape> _shape;
    bool _testsEdges = false;
    bool _trustsShaders = false;
};

}  // namespace osgAnalyticBin
