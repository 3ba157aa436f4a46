// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/CoordinateSystemNode>
#include <osg/Node>

#include <cstddef>
#include <optional>
#include <vector>

namespace osgAnalyticBin::bench {

/// Takes every ClusterCullingCallback off the graph, those of nodes and those of drawables; other callbacks in the same
/// chain stay. Returns: how many were taken off.
std::size_t removeClusterCallbacks(osg::Node& graph);

/// What osg::ClusterCullingCallback keeps of a mesh. ECEF, metres. Eyes nearer to the control point than the radius see
/// the mesh; others do where the cosine between the normal and the direction to the eye is the deviation or more.
struct Cluster {
    glm::dvec3 controlPoint{0.0}, normal{0.0};
    double deviation = -1.0, radius = 0.0;
};

/// The cluster of a tile as VirtualPlanetBuilder has it: about the point of the ellipsoid in the middle of the tile's
/// latitudes and longitudes, with the geocentric direction for its normal, and as if the earth were a ball of the polar
/// radius. Vertices that hang below others, those of skirts, do not count.
/// Returns: nullopt for a tile that reaches around so far that such a callback never culls it, and without vertices.
[[nodiscard]] std::optional<Cluster> clusterOf(const std::vector<glm::dvec3>& verticesEcef,
                                               const core::Ellipsoid& ellipsoid);

/// Gives every tile of a file a ClusterCullingCallback made from its own mesh, on the node that holds the finer tiles
/// too, as VirtualPlanetBuilder does. A file that has any is left as it is, and so are the tiles of osgTerrain, which
/// have no mesh yet, and those of a map.
/// `pageOf`: for a file that is paged below a globe, its ellipsoid; nullptr for a root file.
/// Returns: how many were made.
std::size_t fillClusterCallbacks(osg::Node& graph, const osg::EllipsoidModel* pageOf);

}  // namespace osgAnalyticBin::bench
