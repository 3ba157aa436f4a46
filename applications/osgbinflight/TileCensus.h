// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullWatcher.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Drawable>
#include <osg/Matrixd>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// A drawable in the render bins, and where it stands in the world.
struct DrawnMesh {
    osg::ref_ptr<osg::Drawable> drawable;
    osg::Matrixd localToWorld;
};

/// A tile whose own mesh is drawn.
struct DrawnTile {
    /// Which child of which child it is, from the scene's root on, such as "0/1/2": the same for every culling method.
    std::string key;
    std::vector<DrawnMesh> meshes;
    /// The bin by which the kit culls it, as it is shown: for the Terrain's vertical scale, skirts included.
    /// Invalid where the kit has installed none.
    AnalyticBin bin;
};

/// What one cull traversal did with the tiles of a database, whatever the method.
struct TileCounts {
    std::uint64_t tested = 0;     ///< tiles that the traversal reached
    std::uint64_t kept = 0;       ///< tiles whose children it reached
    std::uint64_t drawn = 0;      ///< tiles with geometry of their own in the render bins
    std::uint64_t drawables = 0;  ///< drawables in the render bins
    std::uint64_t triangles = 0;  ///< triangles of those
    std::uint64_t wanted = 0;     ///< files that PagedLODs asked for: not loaded yet
};

/// The same, and what else one looks at.
struct Census : TileCounts {
    std::uint64_t nodes = 0;      ///< nodes and drawables that the traversal reached
    std::uint64_t pagedLods = 0;  ///< PagedLODs among the tiles kept
    std::vector<DrawnTile> tiles;

    [[nodiscard]] std::set<std::string> keys() const;
};

/// How many tiles of a scene are in memory, shown or not. Cost: one traversal of all nodes.
[[nodiscard]] std::uint64_t residentTiles(osg::Node& scene);

/// Takes the census of a camera's scene. The mesh of a PagedLOD is the child that needs no file.
/// Requires: a camera with a viewport, and no update traversal meanwhile.
class TileCensus final : public CullWatcher {
public:
    [[nodiscard]] static Census take(osg::Camera& camera, osg::FrameStamp& frameStamp);

private:
    struct OpenTile {
        const osg::Node* node = nullptr;
        bool kept = false;
        DrawnTile drawn;
    };

    void enter(osg::Node& node) override;
    void leave(osg::Node& node) override;
    void draw(osg::Drawable& drawable) override;

    [[nodiscard]] std::string keyOfPath();

    std::vector<OpenTile> _openTiles;
    Census _census;
};

}  // namespace osgAnalyticBin::flight
