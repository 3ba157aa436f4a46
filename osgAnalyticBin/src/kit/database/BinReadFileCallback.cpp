// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinReadFileCallback.h"

#include "../tile/Carrier.h"
#include "../tile/EachNode.h"
#include "DatabaseCallbacks.h"

#include <osgAnalyticBin/TileFile.h>

#include <osg/Notify>
#include <osgDB/FileCache>
#include <osgDB/Registry>

#include <algorithm>
#include <exception>
#include <functional>
#include <ios>
#include <vector>

namespace osgAnalyticBin {

namespace {

using ReadResult = osgDB::ReaderWriter::ReadResult;

// A read that failed, with a line that says why.
ReadResult unreadable(const std::string& fileName, const char* why) {
    OSG_WARN << "osgAnalyticBin: \"" << fileName << "\" could not be read: " << why
             << "; its parent tile stays visible." << std::endl;
    return ReadResult(ReadResult::ERROR_IN_READING_FILE);
}

// Reads by the callback that was there before, if any, else by the Registry's, else by OSG.
ReadResult readPlain(const std::string& fileName, const osgDB::Options* options, osgDB::ReadFileCallback* previous) {
    if (previous) return previous->readNode(fileName, options);
    osgDB::ReadFileCallback* const global = osgDB::Registry::instance()->getReadFileCallback();
    return global ? global->readNode(fileName, options) : readTileFile(fileName, options);
}

// Runs `read`, unless the file failed lately. What it throws becomes unreadable(): a corrupt file may ask for absurd
// amounts of memory, and the pager's thread must outlive that.
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

BinReadFileCallback* readCallbackIn(const osgDB::Options& options) {
    return dynamic_cast<BinReadFileCallback*>(options.getReadFileCallback());
}

// A file that a PagedLOD requests from the DatabasePager.
struct PagedFile {
    std::string name;  // as the pager asks for it
    TileFrame frame;   // where its content stands
};

std::vector<PagedFile> filesPagedBy(const osg::PagedLOD& node, const TileFrame& frame, bool isTile) {
    std::vector<PagedFile> files;
    for (unsigned int i = 0; i < node.getNumFileNames(); ++i) {
        if (node.getFileName(i).empty()) continue;
        files.push_back({node.getDatabasePath() + node.getFileName(i), pagedFrame(frame, node.getFileName(i), isTile)});
    }
    return files;
}

}  // namespace

BinReadFileCallback::BinReadFileCallback(Database* database, const TileFrame& frame, osgDB::ReadFileCallback* previous)
    : _database(database), _unexpected{frame, nullptr}, _previous(previous) {}

BinReadFileCallback::~BinReadFileCallback() = default;

void BinReadFileCallback::expect(const std::string& fileName, const TileFrame& frame, InstalledTile* parent) {
    _expected[fileName] = {frame, parent};
}

bool BinReadFileCallback::expectsOtherwise(const std::string& fileName, const TileFrame& frame,
                                           InstalledTile* parent) const {
    const auto found = _expected.find(fileName);
    if (found == _expected.end()) return false;
    return found->second.parent != parent || found->second.frame.localToEcef != frame.localToEcef;
}

const BinReadFileCallback::Expected& BinReadFileCallback::expected(const std::string& fileName,
                                                                   const osgDB::Options* options) const {
    const auto found = _expected.find(fileName);
    if (found != _expected.end()) return found->second;
    // The pager asks for a file of a server by its name in OSG's file cache, if it is there.
    const osgDB::FileCache* const own = options ? options->getFileCache() : nullptr;
    const osg::ref_ptr<const osgDB::FileCache> cache = own ? own : osgDB::Registry::instance()->getFileCache();
    if (!cache) return _unexpected;
    const auto cached = std::find_if(_expected.begin(), _expected.end(), [&](const auto& entry) {
        return cache->isFileAppropriateForFileCache(entry.first) && cache->createCacheFileName(entry.first) == fileName;
    });
    return cached == _expected.end() ? _unexpected : cached->second;
}

osgDB::ReaderWriter::ReadResult BinReadFileCallback::readNode(const std::string& fileName,
                                                              const osgDB::Options* options) {
    const BusyPager busy(_database->making());
    // before anything is asked of the database: what changes meanwhile is a later one
    const unsigned int generation = _database->generation();
    bool isAdded = false;
    ReadResult result = readCarefully(fileName, _failures, [&] { return readAndInstall(fileName, options, isAdded); });
    if (result.validNode()) _database->noteOnItsWay(*result.getNode(), generation, isAdded);
    return result;
}

osgDB::ReaderWriter::ReadResult BinReadFileCallback::readAndInstall(const std::string& fileName,
                                                                    const osgDB::Options* options, bool& isAdded) {
    const osg::ref_ptr<osgDB::Options> plain = options ? options->cloneOptions() : nullptr;
    if (plain) {
        plain->setReadFileCallback(_previous.get());
        // others read what OSG's object caches keep, too
        const int hints = plain->getObjectCacheHint() & ~osgDB::Options::CACHE_NODES;
        plain->setObjectCacheHint(static_cast<osgDB::Options::CacheHintOptions>(hints));
    }
    ReadResult result = readPlain(fileName, plain.get(), _previous.get());
    osg::ref_ptr<osg::Node> node = result.getNode();
    if (!node) return result;
    // the result and this function
    constexpr int kOwn = 2;
    if (node->referenceCount() > kOwn || _database->isRemoved()) return result;
    // a tile that is a transform gets a group above it
    osg::ref_ptr<osg::Node> root = node;
    if (node->asTransform()) {
        root = new Carrier;
        root->asGroup()->addChild(node);
    }
    const Expected& known = expected(fileName, options);
    const osg::ref_ptr<InstalledTile> parent = known.parent ? known.parent->latest() : nullptr;
    const bool hasTiles = _database->install(*root, known.frame, parent.get()) > 0;
    isAdded = hasTiles && !(parent && parent->ordinal);
    return ReadResult(root.get(), result.status());
}

void PagedReads::follow(osg::PagedLOD& node, const TileFrame& frame, Database& database, InstalledTile* parent,
                        bool isTile) {
    const osg::ref_ptr<osgDB::Options> own = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
    const std::vector<PagedFile> files = filesPagedBy(node, frame, isTile);
    Replacing& replacing = _replacing[own];
    // One file may be paged in several places.
    const bool isTaken = replacing.callback && std::any_of(files.begin(), files.end(), [&](const PagedFile& file) {
                             return replacing.callback->expectsOtherwise(file.name, file.frame, parent);
                         });
    if (!replacing.callback || isTaken) {
        const osgDB::Options* base = own ? own.get() : osgDB::Registry::instance()->getOptions();
        replacing.options = base ? base->cloneOptions() : new osgDB::Options;
        // an earlier installer's
        BinReadFileCallback* const earlier = readCallbackIn(*replacing.options);
        osgDB::ReadFileCallback* const previous =
            earlier ? earlier->previous() : replacing.options->getReadFileCallback();
        replacing.callback = new BinReadFileCallback(&database, frame, previous);
        replacing.callback->setReplaced(own && earlier ? earlier->replaced() : own.get());
        replacing.options->setReadFileCallback(replacing.callback);
    }
    for (const PagedFile& file : files) replacing.callback->expect(file.name, file.frame, parent);
    node.setDatabaseOptions(replacing.options.get());
}

BinReadFileCallback* readCallbackOf(osg::PagedLOD& node) {
    const auto* options = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
    return options ? readCallbackIn(*options) : nullptr;
}

osg::ref_ptr<Database> databaseOf(osg::Node& node) {
    osg::ref_ptr<Database> found = attachedDatabase(node);
    if (found) return found;
    forEachNode(node, [&found](osg::Node& at) {
        auto* const paged = found ? nullptr : dynamic_cast<osg::PagedLOD*>(&at);
        if (BinReadFileCallback* const callback = paged ? readCallbackOf(*paged) : nullptr)
            found = callback->database();
    });
    return found;
}

}  // namespace osgAnalyticBin
