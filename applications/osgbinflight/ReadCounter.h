// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Callbacks>

#include <atomic>
#include <cstdint>

namespace osgAnalyticBin::flight {

/// A callback of the Registry that counts the node files that are read, and hands them on to the callback that was
/// there before. The bins' own read callback ends at the Registry's, so that files below bins are counted too. Threads:
/// the calls come from the DatabasePager's threads.
class ReadCounter : public osgDB::ReadFileCallback {
public:
    /// Puts it in front of the Registry's callback. Must not be called while files are read.
    void install();

    /// Puts the earlier callback back, if this one is still the Registry's. Must not be called while files are read.
    void uninstall();

    /// Node files read so far.
    [[nodiscard]] std::uint64_t nodeFiles() const { return _nodeFiles; }

    /// Bytes of these files on the disk; what is not found there, such as pseudo-loaders' names, counts nothing.
    [[nodiscard]] std::uint64_t nodeBytes() const { return _nodeBytes; }

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ReadCounter() override = default;

    /// Changes what was read.
    virtual void treat(osg::Node&) {}

private:
    osg::ref_ptr<osgDB::ReadFileCallback> _next;
    std::atomic<std::uint64_t> _nodeFiles{0};
    std::atomic<std::uint64_t> _nodeBytes{0};
};

}  // namespace osgAnalyticBin::flight
