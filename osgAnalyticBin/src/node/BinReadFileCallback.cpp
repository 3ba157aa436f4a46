// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinReadFileCallback.h"

#include "TileFile.h"

#include <osgAnalyticBin/BinInstaller.h>

#include <osg/Notify>
#include <osgDB/Registry>

#include <exception>
#include <ios>

namespace osgAnalyticBin {

namespace {

osgDB::ReaderWriter::ReadResult unreadable(const std::string& fileName, const char* why) {
    OSG_WARN << "osgAnalyticBin: \"" << fileName << "\" could not be read: " << why
             << "; its parent tile stays visible." << std::endl;
    return osgDB::ReaderWriter::ReadResult(osgDB::ReaderWriter::ReadResult::ERROR_IN_READING_FILE);
}

}  // namespace

BinReadFileCallback::BinReadFileCallback(const CullOptions& options, const osg::EllipsoidModel* ellipsoid,
                                         const osg::Matrixd& localToEcef, osgDB::ReadFileCallback* previous)
    : _options(options), _ellipsoid(ellipsoid), _localToEcef(localToEcef), _previous(previous) {}

BinReadFileCallback::~BinReadFileCallback() = default;

osgDB::ReaderWriter::ReadResult BinReadFileCallback::readUntreated(const std::string& fileName,
                                                                   const osgDB::Options* options) {
    if (_previous) return _previous->readNode(fileName, options);
    osgDB::ReadFileCallback* global = osgDB::Registry::instance()->getReadFileCallback();
    return global ? global->readNode(fileName, options) : readTileFile(fileName, options);
}

osgDB::ReaderWriter::ReadResult BinReadFileCallback::readNode(const std::string& fileName,
                                                              const osgDB::Options* options) {
    try {
        osgDB::ReaderWriter::ReadResult result = readUntreated(fileName, options);
        if (osg::Node* node = result.getNode()) {
            BinInstaller installer(_options);
            installer.setFrame(_ellipsoid.get(), _localToEcef);
            node->accept(installer);
        }
        return result;
    } catch (const std::ios_base::failure&) {
        return unreadable(fileName, "it ends too early");
    } catch (const std::exception& error) {
        // A corrupt file may ask for absurd amounts of memory; the pager's thread must outlive that.
        return unreadable(fileName, error.what());
    }
}

}  // namespace osgAnalyticBin
