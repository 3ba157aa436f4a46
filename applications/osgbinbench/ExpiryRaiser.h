// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Callbacks>

#include <atomic>

namespace osgAnalyticBin::bench {

/// A callback of the Registry that raises the minimum expiry time of what PagedLODs page in, as bins do by
/// CullOptions::expiry, in every node that is read: pages that the DatabasePager loads too. Longer times stay.
/// Threads: the calls come from the DatabasePager's threads.
class ExpiryRaiser : public osgDB::ReadFileCallback {
public:
    /// Puts a raiser that raises nothing in front of the Registry's callback. Must not be called while files are read.
    [[nodiscard]] static osg::ref_ptr<ExpiryRaiser> install();

    /// 0 leaves what is read as it is.
    void setSeconds(double seconds) { _seconds = seconds; }

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ExpiryRaiser() override = default;

private:
    osg::ref_ptr<osgDB::ReadFileCallback> _next;
    std::atomic<double> _seconds{0.0};
};

}  // namespace osgAnalyticBin::bench
