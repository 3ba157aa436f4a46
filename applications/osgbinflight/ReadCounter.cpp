// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ReadCounter.h"

#include "ReadInFront.h"

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

osg::ref_ptr<ReadCounter> ReadCounter::install() {
    const osg::ref_ptr<ReadCounter> counter = new ReadCounter;
    counter->_next = readInFront(*counter);
    return counter;
}

void ReadCounter::uninstall() {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    if (registry.getReadFileCallback() == this) registry.setReadFileCallback(_next);
}

ReadCounter::Result ReadCounter::openArchive(const std::string& fileName, osgDB::ReaderWriter::ArchiveStatus status,
                                             unsigned int indexBlockSizeHint, const osgDB::Options* options) {
    return _next->openArchive(fileName, status, indexBlockSizeHint, options);
}

ReadCounter::Result ReadCounter::readObject(const std::string& fileName, const osgDB::Options* options) {
    return _next->readObject(fileName, options);
}

ReadCounter::Result ReadCounter::readImage(const std::string& fileName, const osgDB::Options* options) {
    return _next->readImage(fileName, options);
}

ReadCounter::Result ReadCounter::readHeightField(const std::string& fileName, const osgDB::Options* options) {
    return _next->readHeightField(fileName, options);
}

ReadCounter::Result ReadCounter::readNode(const std::string& fileName, const osgDB::Options* options) {
    ++_nodeFiles;
    _nodeBytes += bytesOf(fileName, options);
    return _next->readNode(fileName, options);
}

ReadCounter::Result ReadCounter::readShader(const std::string& fileName, const osgDB::Options* options) {
    return _next->readShader(fileName, options);
}

ReadCounter::Result ReadCounter::readScript(const std::string& fileName, const osgDB::Options* options) {
    return _next->readScript(fileName, options);
}

}  // namespace osgAnalyticBin::flight
