// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "PoseTable.h"

#include <osg/Camera>
#include <osgUtil/CullVisitor>

#include <vector>

namespace osgAnalyticBin::flight {

/// Culls a camera's scene once more, off the record: nothing is drawn and no file is asked for, but every tile is
/// counted. Because only OSG's own calls are watched, tiles are counted alike for every culling method.
/// Tiles are the nodes with a stored bin or, in a scene without any, the PagedLODs.
/// Requires: a camera with a viewport, and no update traversal meanwhile; drawing may go on.
/// Cost: one cull traversal and one walk over the primitives that are drawn.
class TileCounter : public osgUtil::CullVisitor {
public:
    /// Counts the tiles of the camera's scene as `frameStamp`'s frame shows them.
    [[nodiscard]] static TileCounts count(osg::Camera& camera, osg::FrameStamp& frameStamp);

    using osgUtil::CullVisitor::apply;
    void apply(osg::Node& node) override;
    void apply(osg::Geode& node) override;
    void apply(osg::Group& node) override;
    void apply(osg::LOD& node) override;
    void apply(osg::Transform& node) override;
    void apply(osg::Projection& node) override;
    void apply(osg::Camera& node) override;
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Billboard& node) override;

private:
    struct Tile {
        bool kept = false;
        bool drawn = false;
    };
    class Wanted;

    explicit TileCounter(bool binsAreStored);

    template <class NodeType>
    void visit(NodeType& node);
    void cull(osg::Camera& camera, osg::FrameStamp& frameStamp);
    void noteReached();
    void noteDrawn();
    void closeTile();
    [[nodiscard]] bool isTile(const osg::Node& node) const;
    [[nodiscard]] TileCounts result() const;

    bool _binsAreStored;
    std::vector<Tile> _openTiles;
    TileCounts _counts;
    osg::ref_ptr<Wanted> _wanted;
};

}  // namespace osgAnalyticBin::flight
