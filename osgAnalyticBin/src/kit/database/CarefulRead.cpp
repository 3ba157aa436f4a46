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

ReadResult readCarefully(const std::string& fileName, FailedReads& failures, const std::function<ReadResult()>& read) {
    // No node and no error: the pager prints nothing, and requests the file again in the next frame.
    if (!failures.mayRead(fileName, FailedReads::Clock::now())) return ReadResult::FILE_LOADED;
    ReadResult result;
    try {
        result = read();
    } catch (const std::ios_base::failure&) {
        result = unreadable(fileName, "it ends too early");
    } catch (const std::exception& error) {
        result = unreadable(fileName, error.what());
    }
    failures.note(fileName, result.validNode(), FailedReads::Clock::now());
    return result;
}

}  // namespace osgAnalyticBin
