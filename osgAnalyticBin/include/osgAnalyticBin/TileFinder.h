// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/TileFrame.h>

#include <osg/CoordinateSystemNode>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Transform>

#include <cstddef>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// Visits the tiles of a scene graph in preorder, always in the same order. It changes nothing and does not traverse
/// osgTerrain tiles. It does not go below transforms that may move.
class OSGANALYTICBIN_EXPORT TileFinder : public osg::NodeVisitor {
public:
    /// Starts in this frame. Use it for a file that is paged below a known database. `ground`: CullOptions::ground
    explicit TileFinder(const TileFrame& frame = {}, const std::string& ground = {});

    /// Visits a node; called by OSG's traversal.
    void apply(osg::Node& node) override;
    /// Enters a globe or a map.
    void apply(osg::CoordinateSystemNode& node) override;
    /// Enters another frame, unless it may move.
    void apply(osg::Transform& node) override;
    /// Tells whether it is a tile, and numbers the files paged below it.
    void apply(osg::PagedLOD& node) override;

protected:
    /// Called for each tile. The default visits the nodes below it.
    virtual void visitTile(FoundTile& tile) { traverseBelow(*tile.node); }

    /// Called for every other node. The default visits the nodes below it.
    virtual void visitOther(osg::Node& node) { traverseBelow(node); }

    /// Called for a node below too many nested tiles and PagedLODs (a paged tile counts twice). The node and all below
    /// it are skipped, so that the recursion ends before the stack overflows; real databases are not nested so deep.
    virtual void visitTooDeep(osg::Node&) {}
    /// The depth of nesting at which the search ends, counted in tiles and PagedLODs on one path.
    static constexpr int kDeepest = 400;

    /// Called for a transform that may move. It is skipped, with all below it.
    virtual void visitMoving(osg::Transform&) {}

    /// Visits the children. Paged children are visited as content of their own files.
    void traverseBelow(osg::Node& node);

    /// The frame of the node that is being visited.
    [[nodiscard]] const TileFrame& frame() const { return _frame; }
    /// The frame of a CoordinateSystemNode's children, where that is visited.
    [[nodiscard]] TileFrame frameInside(const osg::CoordinateSystemNode& node) const;
    /// Changes the frame for all nodes that are visited from then on.
    void setFrame(const TileFrame& frame) { _frame = frame; }

private:
    void visit(osg::Node& node, bool isTile);
    void traverseTransform(osg::Transform& node);
    void traversePaged(osg::PagedLOD& node);
    [[nodiscard]] bool isTile(osg::Node& node) const;

    TileFrame _frame;
    const std::string _ground;
    std::size_t _ordinal = 0;
    const osg::Node* _tile = nullptr;  // the tile being visited
    int _depth = 0;                    // of tiles and PagedLODs
};

/// The tiles below a node.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::vector<FoundTile> findTiles(osg::Node& node, const TileFrame& frame = {});

}  // namespace osgAnalyticBin
