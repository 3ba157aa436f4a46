// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ReadCounter.h"

#include <osgDB/FileUtils>

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

ReadCounter::Result ReadCounter::readNode(const std::string& fileName, const osgDB::Options* options) {
    ++_nodeFiles;
    _nodeBytes += bytesOf(fileName, options);
    return ReadInFront::readNode(fileName, options);
}

}  // namespace osgAnalyticBin::flight
