// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Callbacks>

#include <atomic>
#include <cstdint>

namespace osgAnalyticBin::flight {

/// Counts the node files that are read through the Registry, and passes every call on to the callback that was there
/// before. The bins' own read callback ends at the Registry's, so that files below bins are counted too.
/// Threads: the calls come from the DatabasePager's threads.
class ReadCounter : public osgDB::ReadFileCallback {
public:
    using Result = osgDB::ReaderWriter::ReadResult;

    /// Puts a counter in front of the Registry's callback. Must not be called while files are being read.
    [[nodiscard]] static osg::ref_ptr<ReadCounter> install();

    /// Puts the earlier callback back, if the counter is still the Registry's. Must not be called while files are
    /// being read.
    void uninstall();

    /// Node files read so far.
    [[nodiscard]] std::uint64_t nodeFiles() const { return _nodeFiles; }

    /// Bytes of these files on the disk; what is not found there, such as pseudo-loaders' names, counts nothing.
    [[nodiscard]] std::uint64_t nodeBytes() const { return _nodeBytes; }

    Result openArchive(const std::string& fileName, osgDB::ReaderWriter::ArchiveStatus status,
                       unsigned int indexBlockSizeHint, const osgDB::Options* options) override;
    Result readObject(const std::string& fileName, const osgDB::Options* options) override;
    Result readImage(const std::string& fileName, const osgDB::Options* options) override;
    Result readHeightField(const std::string& fileName, const osgDB::Options* options) override;
    Result readNode(const std::string& fileName, const osgDB::Options* options) override;
    Result readShader(const std::string& fileName, const osgDB::Options* options) override;
    Result readScript(const std::string& fileName, const osgDB::Options* options) override;

protected:
    ~ReadCounter() override = default;

private:
    ReadCounter() = default;

    osg::ref_ptr<osgDB::ReadFileCallback> _next;
    std::atomic<std::uint64_t> _nodeFiles{0};
    std::atomic<std::uint64_t> _nodeBytes{0};
};

}  // namespace osgAnalyticBin::flight
