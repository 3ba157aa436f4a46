// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ReadInFront.h"

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>
#include <osg/ClusterCullingCallback>
#include <osg/CoordinateSystemNode>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace osgAnalyticBin::bench {

/// The first ClusterCullingCallback among a node's cull callbacks; nullptr: it has none.
[[nodiscard]] osg::ClusterCullingCallback* clusterCallbackOf(osg::Node& node);

/// Takes every ClusterCullingCallback off the graph, those of nodes and those of drawables; other callbacks in the
/// same chain stay. osgTerrain's tiles are not traversed: one that is, before it has its Terrain, never finds it.
/// Returns: how many were taken off.
std::size_t removeClusterCallbacks(osg::Node& graph);

/// How many ClusterCullingCallbacks nodes and drawables of the graph have; tiles as above.
[[nodiscard]] std::size_t countClusterCallbacks(osg::Node& graph);

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

/// What becomes of the ClusterCullingCallbacks of a database.
enum class Clusters {
    Keep,
    Remove,
    Fill  ///< kept; where a file has none its tiles get such as VirtualPlanetBuilder makes
};

/// A callback of the Registry that removes or fills the cluster callbacks of whatever is read: pages that the
/// DatabasePager loads too. At first it keeps all.
class ClusterRemover : public flight::ReadInFront<ClusterRemover> {
public:
    /// `globe` is that of the pages read next; with nullptr the root file has to be read next. Must not be called while
    /// files are read.
    void setTreatment(Clusters treatment, const osg::EllipsoidModel* globe = nullptr);

    Result readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ClusterRemover() override = default;

private:
    void fill(osg::Node& graph);

    std::atomic<Clusters> _treatment{Clusters::Keep};
    std::mutex _mutex;
    osg::ref_ptr<const osg::EllipsoidModel> _ellipsoid;  // of the globe whose pages are read; null before its root file
};

/// A callback of the Registry that raises the minimum expiry time of what PagedLODs page in, as bins do by
/// CullOptions::expiry, in every node that is read: pages that the DatabasePager loads too. Longer times stay.
class ExpiryRaiser : public flight::ReadInFront<ExpiryRaiser> {
public:
    /// 0, as at first, leaves what is read as it is.
    void setSeconds(double seconds) { _seconds = seconds; }

    Result readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ExpiryRaiser() override = default;

private:
    std::atomic<double> _seconds{0.0};
};

}  // namespace osgAnalyticBin::bench
