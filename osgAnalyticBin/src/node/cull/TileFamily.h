// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/TileBlock.h"
#include "TileEntry.h"
#include "TilePlan.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/CullStack>
#include <osg/Group>
#include <osg/NodeCallback>
#include <osg/PagedLOD>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

class CullTraversal;
struct DatabaseView;
struct Verdict;

/// The cull callback of a group with tiles among its children. It tests all tiles together, enters those that it keeps,
/// and does not access the others. On a group of groups with tiles it tests nothing, and holds the union of their
/// columns. The tiles' own callbacks are used for children that it does not know, in another frame than that of the
/// database, with occluders, and with callbacks behind it. It reports the class name of a plain osg::NodeCallback, so
/// that saved scenes do not contain it. Guarantee: it culls the tiles that their own callbacks would cull; tests:
/// TileFamily.*. Threads: run() changes nothing in the callback.
class TileFamily final : public osg::NodeCallback {
public:
    /// The copy has no tiles.
    TileFamily(const TileFamily& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new TileFamily(*this, copyop); }

    /// Whether the node is a plain group, which enters all of its children and does nothing else.
    [[nodiscard]] static bool isPossibleOn(const osg::Node& node);

    /// Replaces the node's family, if any, by a new one behind the node's other callbacks. Only removes it if a family
    /// is not possible, or no child is a tile with a bin in the group's own frame, ECEF, and not all are groups with
    /// families. Families of children have to be placed before. Returns: whether there is one.
    static bool place(osg::Node& node);

    /// Removes the family.
    static void remove(osg::Node& node);

    /// Rebuilds the family of a group after the application has added, removed or replaced children. Requires: no cull
    /// traversal runs.
    OSGANALYTICBIN_EXPORT static void renew(osg::Node& node);

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

    using MeshParts = TileEntry::MeshParts;

    /// A tile at the time when the family was made.
    struct Member {
        osg::ref_ptr<const AnalyticBinCullCallback> tile;
        osg::PagedLOD* paged = nullptr;  ///< the node, if it is one
        MeshParts meshParts;
        bool hasTerrain = false;  ///< a part is a tile of osgTerrain
        TileEntry entry;
    };

    using Verdicts = TilePlan::Verdicts;

    /// Whether the family may cull the children of the group in this traversal.
    [[nodiscard]] bool culls(const osg::Node& group, osg::CullStack& cullStack, const DatabaseView& view) const;

    /// Tests the children from `first` on, a multiple of kMost. `eye`: null where nothing is hidden.
    void test(const osg::Group& group, unsigned int first, const core::PlaneSet& planes, core::PlaneMask undecided,
              const core::HorizonEye* eye, Verdicts& verdicts) const;

    /// Prefetches the memory that entering the tiles in view reads.
    void fetchKept(unsigned int first, const Verdicts& verdicts) const;

    [[nodiscard]] const Member& member(unsigned int i) const { return _members[i]; }
    [[nodiscard]] const TileBlock& block() const { return *_block; }

    /// Call when a group's bound is computed: notices children that were added, removed or replaced.
    static void look(const osg::Node& node);

    /// In a tree of groups: holds the columns of all tiles below the group. Returns: nullptr where there may be others.
    [[nodiscard]] const ColumnUnion* columnUnion(const osg::Group& group) const;
    /// The same for the family of any group. Returns: nullptr also where the group has no family.
    [[nodiscard]] OSGANALYTICBIN_EXPORT static const ColumnUnion* columnUnionOf(osg::Group& group);

    /// Whether a tile has no cull callbacks other than that of its bin, and a suspended one for clusters.
    [[nodiscard]] static bool isAlone(const osg::Node& tile, const Member& member);

    /// Whether a tile, or a group of tiles, was removed from the group since bins were installed: the terrain may have
    /// a hole.
    [[nodiscard]] bool hasLost(const osg::Group& group) const;

    /// The number of children when the family was made.
    [[nodiscard]] std::size_t size() const { return _nodes.size(); }

    /// Enters a plain group whose only cull callback is a family that may cull in this traversal. As OSG, but without
    /// the test of the group's sphere, because the tiles are tested. `notes`: records the memory that is read. Returns:
    /// false for any other node, without doing anything.
    [[nodiscard]] static bool enterFamilyOf(osg::Node& node, osgUtil::CullVisitor& visitor, CullTraversal& traversal,
                                            Footprint::Notes& notes);

protected:
    ~TileFamily() override;

private:
    explicit TileFamily(osg::Group& group);
    [[nodiscard]] bool add(osg::Node& child, std::size_t slot);
    [[nodiscard]] bool addFamilyOf(osg::Node& child, std::size_t slot);
    [[nodiscard]] bool hasSameChildren(const osg::Group& group) const;
    void lookUp(const osg::Group& group, unsigned int first, core::PlaneMask undecided, const DatabaseView& view,
                Verdicts& verdicts) const;
    // Of these tiles, those that may be hidden now.
    [[nodiscard]] std::uint64_t hideable(unsigned int first, std::uint64_t tiles) const;
    void findSeparated(unsigned int first, std::uint64_t candidates, const core::PlaneSet& planes,
                       Verdicts& verdicts) const;
    [[nodiscard]] std::uint64_t culled(unsigned int first, const Verdicts& verdicts, const osg::NodeVisitor& nv,
                                       osg::CullStack& cullStack, CullTraversal& traversal) const;
    void cullChildren(osg::Group& group, osg::NodeVisitor& nv, osg::CullStack& cullStack, const DatabaseView& view,
                      CullTraversal& traversal) const;
    static void enterAlone(osg::Node& tile, const TileEntry& entry, osgUtil::CullVisitor& visitor,
                           CullTraversal& traversal);
    static void enter(osg::Node& child, const Member& member, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                      CullTraversal& traversal);

    const osg::Node* _group = nullptr;
    bool _hasTiles = false;
    bool _hasGroups = false;
    bool _hasLostTiles = false;
    osg::ref_ptr<TileBlock> _block;
    // one for each child
    // references, so that no address is used again; null: neither a tile nor a group with a family
    std::vector<osg::ref_ptr<osg::Node>> _nodes;
    std::vector<Member> _members;
    // the same for all tiles
    std::optional<core::Ellipsoid> _ellipsoid;
    std::optional<TerrainShape> _shape;
    bool _testsEdges = false;
    bool _trustsShaders = false;
};

}  // namespace osgAnalyticBin
