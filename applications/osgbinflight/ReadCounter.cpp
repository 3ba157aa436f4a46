// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ReadCounter.h"

#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <filesystem>

namespace osgAnalyticBin::flight {

namespace {

std::uint64_t bytesOf(const std::string& fileName, const osgDB::Options* options) {
    const std::string path = osgDB::findDataFile(fileName, options);
    std::error_code problem;
    const std::uintmax_t bytes = path.empty() ? 0 : std::filesystem::file_size(path, problem);
    return problem ? 0 : bytes;
}

}  // namespace

void ReadCounter::install() {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    _next = registry.getReadFileCallback();
    // a plain callback does what the Registry does by itself
    if (!_next) _next = new osgDB::ReadFileCallback;
    registry.setReadFileCallback(this);
}

void ReadCounter::uninstall() {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    if (registry.getReadFileCallback() == this) registry.setReadFileCallback(_next);
}

osgDB::ReaderWriter::ReadResult ReadCounter::readNode(const std::string& fileName, const osgDB::Options* options) {
    ++_nodeFiles;
    _nodeBytes += bytesOf(fileName, options);
    osgDB::ReaderWriter::ReadResult result = _next->readNode(fileName, options);
    if (result.getNode()) treat(*result.getNode());
    return result;
}

}  // namespace osgAnalyticBin::flight
