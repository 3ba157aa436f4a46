// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileBlock.h"
#include "TileEntry.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
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
class Database;
struct DatabaseView;
struct Verdict;

/// The cull callback of a group that has tiles among its children. It tests all tiles together, enters those that are
/// kept, and reads nothing of the others. The tiles' own callbacks decide where the family cannot: for children that it
/// does not know, in another frame than that of the database, with occluders, and with callbacks behind it.
/// It reports the class name of a plain osg::NodeCallback, so a saved scene holds nothing of it.
/// Guarantee: it culls the tiles that their own callbacks would cull; tests: TileFamily.*.
/// Threads: run() changes nothing in the callback.
class TileFamily final : public osg::NodeCallback {
public:
    /// The copy has no tiles.
    TileFamily(const TileFamily& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new TileFamily(*this, copyop); }

    /// Whether the node is a group that enters all its children, and does nothing else.
    [[nodiscard]] static bool isPossibleOn(const osg::Node& node);

    /// Replaces the node's family, if it has one, by a new one behind its other callbacks. Does nothing more where a
    /// family is not possible, or where no child is a tile with a bin in the group's own frame, ECEF.
    static void place(osg::Node& node);

    /// Takes it off again.
    static void remove(osg::Node& node);

    /// Makes the family of a group anew after the application has added, removed or replaced children. Not while a cull
    /// traversal runs.
    static void renew(osg::Node& node);

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

    using MeshParts = TileEntry::MeshParts;

    /// A tile as it was when the family was made.
    struct Member {
        osg::ref_ptr<const AnalyticBinCullCallback> tile;
        osg::PagedLOD* paged = nullptr;  ///< the node, if it is one
        bool isSeeThrough = false;
        MeshParts meshParts;
        TileEntry entry;
    };

    /// The results for up to TileBlock::Part::kMost children, one bit each.
    struct Verdicts {
        Verdicts() { planes.outside = planes.insideAll = 0; }  // masks of slots that are not there are not read

        core::FamilyVerdict planes;
        std::uint64_t members = 0;    ///< the family's own tiles; callbacks of other children have to be asked
        std::uint64_t tested = 0;     ///< slots with a bin that is tested so
        std::uint64_t hidden = 0;     ///< behind the horizon
        std::uint64_t separated = 0;  ///< proven outside by an edge of the frustum
        std::uint64_t occluded = 0;   ///< behind terrain
        std::uint64_t emerging = 0;   ///< of these, those that come into view soon
        bool lacksTiles = false;      ///< a tile is not where it was: the terrain may have a hole

        /// Slots whose bin is out of view.
        [[nodiscard]] std::uint64_t outOfView() const {
            return tested & (planes.outside | hidden | separated | occluded);
        }
    };

    /// Whether it culls the children of the group in this traversal.
    [[nodiscard]] bool culls(const osg::Node& group, osg::CullStack& cullStack, const DatabaseView& view) const;

    /// Tests the children from `first` on, a multiple of kMost. `eye`: null where nothing is hidden.
    void test(const osg::Group& group, unsigned int first, const core::PlaneSet& planes, core::PlaneMask undecided,
              const core::HorizonEye* eye, CullTraversal& traversal, Verdicts& verdicts) const;

    /// Has the memory fetched that entering the tiles in view reads.
    void fetchKept(unsigned int first, const Verdicts& verdicts) const;

    [[nodiscard]] const Member& member(unsigned int i) const { return _members[i]; }
    [[nodiscard]] const TileBlock& block() const { return *_block; }

    /// Whether a tile was removed from the group since bins were installed: the terrain may have a hole.
    [[nodiscard]] bool hasLostTiles() const { return _hasLostTiles; }

    /// The number of children when the family was made.
    [[nodiscard]] std::size_t size() const { return _nodes.size(); }

    /// Enters a plain group whose only cull callback is a family that culls in this traversal, as OSG does, but for the
    /// test of the group's sphere: the family's tiles have tests of their own. `notes`: takes what is read for it.
    /// Returns: false for any other node; nothing was done then.
    [[nodiscard]] static bool enterFamilyOf(osg::Node& node, osgUtil::CullVisitor& visitor, CullTraversal& traversal,
                                            Footprint::Notes& notes);

protected:
    ~TileFamily() override;

private:
    explicit TileFamily(osg::Group& group);
    [[nodiscard]] bool add(osg::Node& child, std::size_t slot);
    void lookUp(const osg::Group& group, unsigned int first, core::PlaneMask undecided, const DatabaseView& view,
                CullTraversal& traversal, Verdicts& verdicts) const;
    void findSeparated(unsigned int first, std::uint64_t candidates, const core::PlaneSet& planes,
                       CullTraversal& traversal, Verdicts& verdicts) const;
    [[nodiscard]] std::uint64_t culled(unsigned int first, const Verdicts& verdicts, const osg::NodeVisitor& nv,
                                       osg::CullStack& cullStack, const DatabaseView& view,
                                       CullTraversal& traversal) const;
    void cullChildren(osg::Group& group, osg::NodeVisitor& nv, osg::CullStack& cullStack, const DatabaseView& view,
                      CullTraversal& traversal) const;
    static void enter(osg::Node& child, const Member& member, osg::NodeVisitor& nv, CullTraversal& traversal);

    const osg::Node* _group = nullptr;
    bool _hasTiles = false;
    bool _hasLostTiles = false;
    osg::ref_ptr<TileBlock> _block;
    // one for each child
    std::vector<osg::ref_ptr<osg::Node>> _nodes;  // held, so that no others are taken for them; null: no tile
    std::vector<Member> _members;
    // what all its tiles have in common
    std::optional<core::Ellipsoid> _ellipsoid;
    std::optional<TerrainShape> _shape;
    bool _testsEdges = false;
};

}  // namespace osgAnalyticBin
