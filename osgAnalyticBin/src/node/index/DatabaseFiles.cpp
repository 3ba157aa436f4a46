// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NestedReads.h"

#include <osgAnalyticBin/TileFile.h>
#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/Failure.h>

#include <osgDB/FileNameUtils>
#include <osgDB/ObjectWrapper>
#include <osgDB/Options>
#include <osgDB/Registry>

#include <exception>
#include <filesystem>
#include <ios>

namespace osgAnalyticBin::indexing {

namespace fs = std::filesystem;

bool leavesFolder(const std::string& file) {
    const bool climbs = file == ".." || file.rfind("../", 0) == 0;
    const bool isElsewhere = osgDB::isAbsolutePath(file) || file.find(":/") != std::string::npos;
    return climbs || isElsewhere || file.empty();
}

DatabaseFiles::DatabaseFiles(const std::string& rootFile)
    : _rootFile(rootFile), _rootName(osgDB::getSimpleFileName(rootFile)), _folder(osgDB::getFilePath(rootFile)) {
    std::error_code error;
    if (osgDB::containsServerAddress(rootFile)) {
        throw Failure("\"" + rootFile + "\" is on a server; run osgbinconv where its files are");
    }
    if (!fs::exists(rootFile, error)) throw Failure("no file \"" + rootFile + "\"; name the root file of a database");
    if (!fs::is_regular_file(rootFile, error)) {
        throw Failure("\"" + rootFile + "\" is no file; name the root file of a database");
    }
    if (_folder.empty()) _folder = ".";
}

std::string DatabaseFiles::pathOf(const std::string& file) const {
    return file.empty() ? _rootFile : _folder + "/" + file;
}

osg::ref_ptr<osg::Node> DatabaseFiles::read(const std::string& file, Images images, std::string& error) const {
    const std::string path = pathOf(file);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) {
        error = "is missing";
        return nullptr;
    }
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_NONE);
    options->getDatabasePathList().push_front(osgDB::getFilePath(path));
    options->setReadFileCallback(NestedReads::callback());
    const NestedReads nested(*this, file, images);
    osg::ref_ptr<osg::Node> node;
    try {
        osgDB::ReaderWriter::ReadResult result = osgAnalyticBin::readTileFile(path, options);
        node = result.getNode();
        error = result.message().empty() ? "cannot be read" : "cannot be read: " + result.message();
    } catch (const std::ios_base::failure&) {
        error = "ends too early";
    } catch (const std::exception& failure) {
        error = std::string("cannot be read: ") + failure.what();
    }
    if (!nested.refusal().empty()) throw Failure(nested.refusal());
    error = error.substr(0, error.find('\n'));
    return node;
}

std::string DatabaseFiles::checked(const std::string& file, const std::string& namedBy) const {
    if (leavesFolder(file)) throw Failure("\"" + pathOf(namedBy) + "\" names \"" + file + "\", " + kIsOutside);
    return file == _rootName ? std::string() : file;
}

// By a class of each: OSG locks its tables first and loads a library then, and the other order may deadlock.
void loadSerializers() {
    osgDB::ObjectWrapperManager& tables = *osgDB::Registry::instance()->getObjectWrapperManager();
    for (const char* const name : {"osg::Node", "osgTerrain::TerrainTile", "osgSim::LightPointNode",
                                   "osgAnalyticBin::AnalyticBinCullCallback", "osgFX::Effect", "osgText::Text"}) {
        (void)tables.findWrapper(name);
    }
}

void checkAllReads() {
    osgDB::Registry::instance()->setReadFileCallback(NestedReads::callback());
}

}  // namespace osgAnalyticBin::indexing
