// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/CoordinateSystemNode>
#include <osgDB/Callbacks>

#include <atomic>
#include <cstddef>
#include <mutex>

namespace osgAnalyticBin::bench {

/// Takes every ClusterCullingCallback off the graph, those of nodes and those of drawables; other callbacks in the
/// same chain stay. osgTerrain's tiles are not traversed: one that is, before it has its Terrain, never finds it.
/// Returns: how many were taken off.
std::size_t removeClusterCallbacks(osg::Node& graph);

/// How many ClusterCullingCallbacks nodes and drawables of the graph have; tiles as above.
[[nodiscard]] std::size_t countClusterCallbacks(osg::Node& graph);

/// What becomes of the ClusterCullingCallbacks of a database.
enum class Clusters {
    Keep,
    Remove,
    Fill,          ///< kept; where a file has none its tiles get such as VirtualPlanetBuilder makes
    FillForRaster  ///< as Fill, and tiles are prepared for RasterCulling.h
};

/// A callback of the Registry that removes or fills the cluster callbacks of whatever is read: pages that the
/// DatabasePager loads too. Everything else goes on to the callback that was there before.
/// Threads: the calls come from the DatabasePager's threads.
class ClusterRemover : public osgDB::ReadFileCallback {
public:
    /// Puts a remover that keeps all in front of the Registry's callback. Must not be called while files are read.
    [[nodiscard]] static osg::ref_ptr<ClusterRemover> install();

    /// `globe` is that of the pages read next; with nullptr the root file has to be read next. Must not be called while
    /// files are read.
    void setTreatment(Clusters treatment, const osg::EllipsoidModel* globe = nullptr);

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ClusterRemover() override = default;

private:
    void fill(osg::Node& graph);

    osg::ref_ptr<osgDB::ReadFileCallback> _next;
    std::atomic<Clusters> _treatment{Clusters::Keep};
    std::mutex _mutex;
    osg::ref_ptr<const osg::EllipsoidModel> _ellipsoid;  // of the globe whose pages are read; null before its root file
};

}  // namespace osgAnalyticBin::bench
