// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osg/observer_ptr>

#include <vector>

namespace osgAnalyticBin {

/// The triangles of the shown tiles around an eye, kept from frame to frame.
class NearMeshes {
public:
    /// The triangles of a tile's own mesh, ECEF. Returns: nullptr where they are not known. Valid until the next call.
    /// Cost: one pass over the mesh in every sixteenth call for the same tile, for tiles that were not asked for
    /// lately, and for meshes that were changed.
    [[nodiscard]] const core::EcefMesh* trianglesOf(const AnalyticBinCullCallback& tile, osg::Node& mesh);

    /// More tiles are not kept.
    static constexpr std::size_t kMostTiles = 16;

private:
    struct Known {
        osg::observer_ptr<const AnalyticBinCullCallback> tile;
        osg::observer_ptr<const osg::Node> node;
        osg::Matrixd localToEcef;
        int uses;
        core::EcefMesh mesh;
    };

    std::vector<Known> _known;
    std::size_t _oldest = 0;
};

}  // namespace osgAnalyticBin
