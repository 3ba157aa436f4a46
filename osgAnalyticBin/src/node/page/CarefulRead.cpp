// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CarefulRead.h"

#include <osgAnalyticBin/TileFile.h>

#include <osg/Notify>
#include <osgDB/Registry>

#include <exception>
#include <ios>

namespace osgAnalyticBin {

using ReadResult = osgDB::ReaderWriter::ReadResult;

ReadResult unreadable(const std::string& fileName, const char* why) {
    OSG_WARN << "osgAnalyticBin: \"" << fileName << "\" could not be read: " << why
             << "; its parent tile stays visible." << std::endl;
    return ReadResult(ReadResult::ERROR_IN_READING_FILE);
}

ReadResult readPlain(const std::string& fileName, const osgDB::Options* options, osgDB::ReadFileCallback* previous) {
    if (previous) return previous->readNode(fileName, options);
    osgDB::ReadFileCallback* const global = osgDB::Registry::instance()->getReadFileCallback();
    return global ? global->readNode(fileName, options) : readTileFile(fileName, options);
}

ReadResult readCarefully(const std::string& fileName, const std::function<ReadResult()>& read) {
    try {
        return read();
    } catch (const std::ios_base::failure&) {
        return unreadable(fileName, "it ends too early");
    } catch (const std::exception& error) {
        return unreadable(fileName, error.what());
    }
}

}  // namespace osgAnalyticBin
