// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ReadCounter.h"

#include <osg/CoordinateSystemNode>

#include <atomic>

namespace osgAnalyticBin::bench {

/// What becomes of the ClusterCullingCallbacks of a database.
enum class Clusters {
    Keep,
    Remove,
    Fill  ///< kept; where a file has none its tiles get such as VirtualPlanetBuilder makes
};

/// Counts the files that are read, also those that the DatabasePager loads, and changes what is read: it removes or
/// fills cluster callbacks, and raises the minimum expiry time of what PagedLODs page in, as bins do by
/// CullOptions::expiry; longer times stay. At first it changes nothing. One in a program, installed before the first
/// file is read.
class FileWatch : public flight::ReadCounter {
public:
    /// `expiry`: seconds; 0 leaves times as they are. `globe`: of the pages read next; nullptr: the root file has to be
    /// read next. Must not be called while files are read.
    void setTreatment(Clusters clusters, double expiry, const osg::EllipsoidModel* globe = nullptr);

protected:
    ~FileWatch() override = default;
    void treat(osg::Node& graph) override;

private:
    std::atomic<Clusters> _clusters{Clusters::Keep};
    std::atomic<double> _expiry{0.0};
    /// Whose pages are read. A copy: the globe may come from a plugin, which the Registry unloads before its callbacks
    /// are gone.
    osg::ref_ptr<const osg::EllipsoidModel> _globe;
};

}  // namespace osgAnalyticBin::bench
