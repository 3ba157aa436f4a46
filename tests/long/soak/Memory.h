// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Callback>
#include <osg/Node>
#include <osg/observer_ptr>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace osgAnalyticBin::test {

/// The callbacks that the kit has put into a scene, told apart by address and observed until they are deleted. Not the
/// options that files are read with: OSG's PagedLODs keep those of their last request.
class KitObjects {
public:
    /// Looks for those in the scene. Returns: how many there are.
    std::size_t note(osg::Node& scene);

    /// Of all that were ever noted, those that are alive.
    [[nodiscard]] std::size_t alive();

    /// The same by class, for a message.
    [[nodiscard]] std::string kinds() const;

private:
    std::map<const osg::Object*, osg::observer_ptr<osg::Object>> _known;
};

[[nodiscard]] double median(std::vector<double> values);

/// Growth from the median of the first tenth of samples to that of the last, in percent of `whole`, where the first
/// fifth of all was left out as a warm-up. Returns: 0 for fewer than 20 samples.
[[nodiscard]] double growthPercent(const std::vector<double>& samples, double whole);

}  // namespace osgAnalyticBin::test
