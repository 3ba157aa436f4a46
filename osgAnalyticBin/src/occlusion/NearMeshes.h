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

/// Keeps the triangles around an eye from frame to frame.
class NearMeshes {
public:
    /// Returns: all triangles of a tile's own mesh that come within `radius` metres of the vertical through the eye,
    /// and some others, ECEF; nullptr where the mesh cannot be read. The result is valid until the next call. Cost: one
    /// pass over the mesh when the eye has moved some times the radius. The mesh is read when its tile was not asked
    /// for lately, when a change of it was noticed, and after 16 uses at most.
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
        glm::dvec3 eye;  // where it was when the near triangles were selected
        double radius;   // of these; negative: none were looked for
        core::EcefMesh close;
    };

    [[nodiscard]] Known* meshOf(const AnalyticBinCullCallback& tile, osg::Node& mesh);

    std::vector<Known> _known;
    std::size_t _oldest = 0;
};

}  // namespace osgAnalyticBin
