// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FileWatch.h"

#include "ClusterCallbacks.h"
#include "Nodes.h"

#include <osg/PagedLOD>

#include <algorithm>

namespace osgAnalyticBin::bench {

namespace {

using support::forAllNodes;

void raiseExpiry(osg::Node& node, double seconds) {
    auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
    for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i)
        if (!paged->getFileName(i).empty())
            paged->setMinimumExpiryTime(i, std::max(seconds, paged->getMinimumExpiryTime(i)));
}

}  // namespace

void FileWatch::setTreatment(Clusters clusters, double expiry, const osg::EllipsoidModel* globe) {
    _clusters = clusters;
    _expiry = expiry;
    _globe = globe ? new osg::EllipsoidModel(globe->getRadiusEquator(), globe->getRadiusPolar()) : nullptr;
}

void FileWatch::treat(osg::Node& graph) {
    if (_clusters == Clusters::Remove) removeClusterCallbacks(graph);
    if (_clusters == Clusters::Fill) fillClusterCallbacks(graph, _globe);
    const double seconds = _expiry;
    if (seconds > 0.0) forAllNodes(graph, [seconds](osg::Node& node) { raiseExpiry(node, seconds); });
}

}  // namespace osgAnalyticBin::bench
