// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgDB/Callbacks>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

namespace osgAnalyticBin::flight {

/// A callback of the Registry that counts the node files that are read, and hands them on to the callback that was
/// there before. The bins' own read callback ends at the Registry's, so that files below bins are counted too. Threads:
/// the calls come from the DatabasePager's threads.
class ReadCounter : public osgDB::ReadFileCallback {
public:
    /// Puts it in front of the Registry's callback. Must not be called while files are read.
    void install() {
        osgDB::Registry& registry = *osgDB::Registry::instance();
        _next = registry.getReadFileCallback();
        // a plain callback does what the Registry does by itself
        if (!_next) _next = new osgDB::ReadFileCallback;
        registry.setReadFileCallback(this);
    }

    /// Puts the earlier callback back, if this one is still the Registry's. Must not be called while files are read.
    void uninstall() {
        osgDB::Registry& registry = *osgDB::Registry::instance();
        if (registry.getReadFileCallback() == this) registry.setReadFileCallback(_next);
    }

    /// Node files read so far.
    [[nodiscard]] std::uint64_t nodeFiles() const { return _nodeFiles; }

    /// Bytes of these files on the disk; what is not found there, such as pseudo-loaders' names, counts nothing.
    [[nodiscard]] std::uint64_t nodeBytes() const { return _nodeBytes; }

    osgDB::ReaderWriter::ReadResult readNode(const std::string& fileName, const osgDB::Options* options) override {
        ++_nodeFiles;
        _nodeBytes += bytesOf(fileName, options);
        osgDB::ReaderWriter::ReadResult result = _next->readNode(fileName, options);
        if (result.getNode()) treat(*result.getNode());
        return result;
    }

protected:
    ~ReadCounter() override = default;

    /// Changes what was read.
    virtual void treat(osg::Node&) {}

private:
    static std::uint64_t bytesOf(const std::string& fileName, const osgDB::Options* options) {
        const std::string path = osgDB::findDataFile(fileName, options);
        std::error_code problem;
        const std::uintmax_t bytes = path.empty() ? 0 : std::filesystem::file_size(path, problem);
        return problem ? 0 : bytes;
    }

    osg::ref_ptr<osgDB::ReadFileCallback> _next;
    std::atomic<std::uint64_t> _nodeFiles{0};
    std::atomic<std::uint64_t> _nodeBytes{0};
};

}  // namespace osgAnalyticBin::flight
