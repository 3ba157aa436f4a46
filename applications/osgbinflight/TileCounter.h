// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullWatcher.h"
#include "PoseTable.h"

#include <vector>

namespace osgAnalyticBin::flight {

/// Counts the tiles of a camera's scene. Tiles are the nodes with a stored bin or, in a scene without any, the
/// PagedLODs.
/// Cost: one cull traversal and one walk over the primitives that are drawn.
class TileCounter final : public CullWatcher {
public:
    /// Counts the tiles of the camera's scene as `frameStamp`'s frame shows them.
    [[nodiscard]] static TileCounts count(osg::Camera& camera, osg::FrameStamp& frameStamp);

private:
    struct Tile {
        bool kept = false;
        bool drawn = false;
    };

    explicit TileCounter(bool binsAreStored) : _binsAreStored(binsAreStored) {}

    void enter(osg::Node& node) override;
    void leave(osg::Node& node) override;
    void draw(osg::Drawable& drawable) override;
    [[nodiscard]] bool isTile(const osg::Node& node) const;
    [[nodiscard]] TileCounts result() const;

    bool _binsAreStored;
    std::vector<Tile> _openTiles;
    TileCounts _counts;
};

}  // namespace osgAnalyticBin::flight
