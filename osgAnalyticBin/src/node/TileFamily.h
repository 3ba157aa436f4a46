// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileBlock.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/CullStack>
#include <osg/Group>
#include <osg/NodeCallback>

#include <cstddef>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

class CullTraversal;
class Database;
struct DatabaseView;
struct Verdict;

/// The cull callback of a group with tiles among its children: tests all of them in one go, enters those that are
/// kept, and touches nothing of the others. Wherever it is not sure (a child that it was not made for, another frame
/// than that of the database, occluders, callbacks behind it), the tiles' own callbacks decide, as they would without
/// it. It says of itself that it is a plain osg::NodeCallback: a scene that is saved holds nothing of it.
/// Guarantee: culls as the tiles' own callbacks; tests: TileFamily.*.
/// Threads: run() changes nothing in the callback.
class TileFamily final : public osg::NodeCallback {
public:
    /// A copy knows no tiles.
    TileFamily(const TileFamily& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new TileFamily(*this, copyop); }

    /// Whether the node is a group that enters all its children, and does nothing else.
    [[nodiscard]] static bool isPossibleOn(const osg::Node& node);

    /// Puts a family behind the callbacks of the node, in place of one that is there, where it is possible there and
    /// tiles with bins in the group's own frame, ECEF, are among its children.
    static void place(osg::Node& node);

    /// Takes it off again.
    static void remove(osg::Node& node);

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

    /// A tile as it was when the family was made.
    struct Member {
        osg::ref_ptr<osg::Node> node;  ///< held, so that no other is taken for it; null: no tile
        osg::ref_ptr<const AnalyticBinCullCallback> tile;
        bool isSeeThrough = false;
        /// The nodes that have to be entered for the tile's own mesh, if that is all of them; empty: not known.
        std::vector<osg::ref_ptr<const osg::Node>> meshParts;
    };

    /// Whether it culls the children of the group in this traversal.
    [[nodiscard]] bool culls(const osg::Node& group, osg::CullStack& cullStack, const DatabaseView& view) const;

    /// The tile that is this child. Returns: nullptr where the child's own callbacks have to be asked.
    [[nodiscard]] const Member* member(std::size_t slot, const osg::Node& child) const {
        const bool isKnown = slot < _members.size() && _members[slot].node == &child && _block->isBelieved(slot);
        return isKnown ? &_members[slot] : nullptr;
    }
    [[nodiscard]] const TileBlock& block() const { return *_block; }

protected:
    ~TileFamily() override;

private:
    TileFamily() = default;
    [[nodiscard]] bool add(osg::Node& child, std::size_t slot);
    [[nodiscard]] Verdict verdict(std::size_t slot, const DatabaseView& view, CullTraversal& traversal,
                                  core::PlaneMask& undecided) const;
    void cullChildren(osg::Group& group, osg::NodeVisitor& nv, osg::CullStack& cullStack, const DatabaseView& view,
                      CullTraversal& traversal) const;

    const osg::Node* _group = nullptr;
    std::vector<Member> _members;  // by the number of the child
    osg::ref_ptr<TileBlock> _block;
    // what all its tiles have in common
    std::optional<core::Ellipsoid> _ellipsoid;
    std::optional<TerrainShape> _shape;
};

}  // namespace osgAnalyticBin
