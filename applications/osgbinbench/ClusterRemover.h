// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Callbacks>

#include <atomic>

namespace osg {
class Node;
}

namespace osgAnalyticBin::bench {

/// Takes every ClusterCullingCallback off the graph, those of nodes and those of drawables; other callbacks in the
/// same chain stay. osgTerrain's tiles are not traversed: one that is, before it has its Terrain, never finds it.
/// Returns: how many were taken off.
std::size_t removeClusterCallbacks(osg::Node& graph);

/// A callback of the Registry that takes the cluster callbacks off whatever is read while it is switched on: pages that
/// the DatabasePager loads too. Everything else goes on to the callback that was there before.
/// Threads: the calls come from the DatabasePager's threads.
class ClusterRemover : public osgDB::ReadFileCallback {
public:
    /// Puts a remover, switched off, in front of the Registry's callback. Must not be called while files are read.
    [[nodiscard]] static osg::ref_ptr<ClusterRemover> install();

    /// Must not be called while files are read.
    void setEnabled(bool enabled) { _enabled = enabled; }

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ClusterRemover() override = default;

private:
    osg::ref_ptr<osgDB::ReadFileCallback> _next;
    std::atomic<bool> _enabled{false};
};

}  // namespace osgAnalyticBin::bench
