// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <osg/Matrixd>
#include <osg/Node>
#include <osg/observer_ptr>

#include <vector>

namespace osgAnalyticBin {

/// The triangles around an eye, kept from frame to frame.
class NearMeshes {
public:
    /// The triangles of a tile's own mesh, ECEF, that come within `radius` metres of the vertical through the eye, and
    /// some more. Returns: nullptr where they are not known. Valid until the next call.
    /// Cost: one pass over the mesh when the eye has moved some times the radius; the mesh is read for tiles that were
    /// not asked for lately, for meshes that were changed, and after some seconds.
    [[nodiscard]] const core::EcefMesh* trianglesNear(const AnalyticBinCullCallback& tile, osg::Node& mesh,
                                                      const core::Frame& eye, double radius);

    /// More tiles are not kept.
    static constexpr std::size_t kMostTiles = 16;

private:
    struct Known {
        osg::observer_ptr<const AnalyticBinCullCallback> tile;
        osg::observer_ptr<const osg::Node> node;
        osg::Matrixd localToEcef;
        int uses;
        core::EcefMesh mesh;
        glm::dvec3 eye;  // that the near triangles are about
        double radius;   // of these; negative: none were looked for
        core::EcefMesh near;
    };

    [[nodiscard]] Known* meshOf(const AnalyticBinCullCallback& tile, osg::Node& mesh);

    std::vector<Known> _known;
    std::size_t _oldest = 0;
};

}  // namespace osgAnalyticBin
