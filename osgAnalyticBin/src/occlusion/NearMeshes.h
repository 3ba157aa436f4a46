// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osg/observer_ptr>

#include <cstddef>
#include <memory>
#include <vector>

namespace osgAnalyticBin {

/// Keeps the meshes around an eye from frame to frame.
class NearMeshes {
public:
    /// Returns: all triangles of a tile's own mesh, ECEF; null where the mesh cannot be read, or would have to be
    /// read beyond setMostReads(). They do not change: other threads may keep them. Cost: the mesh is read when its
    /// tile was not asked for lately, when a change of it was noticed, and after 16 uses at most.
    [[nodiscard]] OSGANALYTICBIN_EXPORT std::shared_ptr<const core::EcefMesh> meshOf(
        const AnalyticBinCullCallback& tile, osg::Node& mesh);

    /// More tiles are not kept.
    static constexpr std::size_t kMostTiles = 16;

    /// Limits how many meshes are read from now on. Reading one takes as long as culling many tiles.
    void setMostReads(std::size_t meshes) { _mostReads = meshes; }

private:
    struct Known {
        osg::observer_ptr<const AnalyticBinCullCallback> tile;
        osg::observer_ptr<const osg::Node> node;
        osg::Matrixd localToEcef;
        int uses;
        std::shared_ptr<const core::EcefMesh> mesh;
    };

    std::vector<Known> _known;
    std::size_t _oldest = 0;
    std::size_t _mostReads = kMostTiles;
};

}  // namespace osgAnalyticBin
