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

osg::ref_ptr<const osg::EllipsoidModel> copyOf(const osg::EllipsoidModel* globe) {
    return globe ? new osg::EllipsoidModel(globe->getRadiusEquator(), globe->getRadiusPolar()) : nullptr;
}

osg::ref_ptr<const osg::EllipsoidModel> ellipsoidOf(osg::Node& graph) {
    osg::ref_ptr<const osg::EllipsoidModel> ellipsoid;
    forAllNodes(graph, [&](osg::Node& node) {
        const auto* const globe = dynamic_cast<osg::CoordinateSystemNode*>(&node);
        if (!globe || ellipsoid) return;
        ellipsoid = globe->getEllipsoidModel() ? copyOf(globe->getEllipsoidModel()) : new osg::EllipsoidModel;
    });
    return ellipsoid;
}

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
    _ellipsoid = copyOf(globe);
}

void FileWatch::treat(osg::Node& graph) {
    if (_clusters == Clusters::Remove) removeClusterCallbacks(graph);
    if (_clusters == Clusters::Fill) fill(graph);
    const double seconds = _expiry;
    if (seconds > 0.0) forAllNodes(graph, [seconds](osg::Node& node) { raiseExpiry(node, seconds); });
}

void FileWatch::fill(osg::Node& graph) {
    const osg::ref_ptr<const osg::EllipsoidModel> own = ellipsoidOf(graph);
    osg::ref_ptr<const osg::EllipsoidModel> pageOf;
    {
        const std::lock_guard lock(_mutex);
        if (own)
            _ellipsoid = own;
        else
            pageOf = _ellipsoid;
    }
    fillClusterCallbacks(graph, pageOf.get());
}

}  // namespace osgAnalyticBin::bench
