// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinReadFileCallback.h"

#include "../Text.h"
#include "../tile/Carrier.h"
#include "../tile/EachNode.h"
#include "CachedContent.h"
#include "DatabaseCallbacks.h"

#include <osgAnalyticBin/TileFile.h>

#include <osg/Notify>
#include <osg/observer_ptr>
#include <osgDB/FileCache>
#include <osgDB/Registry>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <ios>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>
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

// A file that a PagedLOD requests from the DatabasePager.
struct PagedFile {
    std::string name;  // as the pager asks for it
    TileFrame frame;   // where its content stands
};

std::vector<PagedFile> filesPagedBy(const osg::PagedLOD& node, const TileFrame& frame, bool isTile) {
    std::vector<PagedFile> files;
    for (unsigned int i = 0; i < node.getNumFileNames(); ++i) {
        if (node.getFileName(i).empty()) continue;
        TileFrame inside = frame;
        inside.file = pagedFilePath(frame.file, node.getFileName(i));
        inside.isBelowTile = inside.isBelowTile || isTile;
        files.push_back({node.getDatabasePath() + node.getFileName(i), inside});
    }
    return files;
}

// Nodes that a user's read callback keeps, and so may hand out more than once, to several threads, or while they are
// being drawn: bins are installed on each only once.
// Threads: any number at once; one installs while the others wait.
class SharedTiles {
public:
    enum class Outcome {
        Usable,    // installed now or before, for the same place; or drawn already by a scene without bins
        Elsewhere  // installed before for another place: its bins would be wrong here
    };

    [[nodiscard]] static SharedTiles& instance() {
        // never destroyed: a pager that an application never deletes may still read
        static SharedTiles& tiles = *new SharedTiles;
        return tiles;
    }

    // Runs `install` unless bins are installed on the node already. `place`: the node's globe and frame. A tile's bin
    // holds for one Database alone: another may have other corrections, another shape of terrain, or a horizon that the
    // tile was never counted in. With a later Database::generation() it runs again for nodes that are not in the scene;
    // the scene's are updated with it.
    [[nodiscard]] Outcome installOnce(osg::Node& node, Database& database, const std::string& place,
                                      unsigned int generation, const std::function<void()>& install) {
        const std::lock_guard<std::mutex> lock(_mutex);
        const auto known = _installed.find(&node);
        osg::ref_ptr<const Database> owner;
        const bool isKnown =
            known != _installed.end() && known->second.node.valid() && known->second.database.lock(owner);
        // the bins of an installation that is over are replaced
        if (isKnown && !owner->isRemoved()) {
            if (owner != &database || known->second.place != place) return Outcome::Elsewhere;
            if (known->second.generation == generation) return Outcome::Usable;
        }
        // A cull traversal may be in it just now. Without bins, OSG's spheres stay in charge there.
        if (node.getNumParents() > 0) return Outcome::Usable;
        install();
        forgetDeleted();
        _installed[&node] = {&node, &database, place, generation};
        return Outcome::Usable;
    }

private:
    struct Installed {
        osg::observer_ptr<osg::Node> node;
        osg::observer_ptr<const Database> database;
        std::string place;
        unsigned int generation = 0;
    };

    void forgetDeleted() {
        if (_installed.size() < _enough) return;
        for (auto entry = _installed.begin(); entry != _installed.end();) {
            entry = entry->second.node.valid() ? std::next(entry) : _installed.erase(entry);
        }
        _enough = std::max<std::size_t>(64, 2 * _installed.size());
    }

    std::mutex _mutex;
    std::map<const osg::Node*, Installed> _installed;
    std::size_t _enough = 64;  // entries at which those of deleted nodes are looked for
};

// Where on which globe.
std::string placeText(const TileFrame& frame) {
    std::vector<double> numbers(frame.localToEcef.ptr(), frame.localToEcef.ptr() + 16);
    const osg::EllipsoidModel* ellipsoid = frame.ellipsoid.get();
    if (ellipsoid) numbers.insert(numbers.end(), {ellipsoid->getRadiusEquator(), ellipsoid->getRadiusPolar()});
    return numbersToText(numbers);
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
    ReadResult result =
        readCarefully(fileName, _failures, [&] { return readAndInstall(fileName, options, generation); });
    if (result.validNode()) _database->noteRead(*result.getNode(), generation);
    return result;
}

osgDB::ReaderWriter::ReadResult BinReadFileCallback::readAndInstall(const std::string& fileName,
                                                                    const osgDB::Options* options,
                                                                    unsigned int generation) {
    // OSG's object cache keeps the options that a file was read with
    const osg::ref_ptr<osgDB::Options> plain = options ? options->cloneOptions() : nullptr;
    if (plain) plain->setReadFileCallback(_previous.get());
    ReadResult result = readPlain(fileName, plain.get(), _previous.get());
    osg::ref_ptr<osg::Node> node = result.getNode();
    if (!node) return result;
    if (const osg::ref_ptr<osg::Node> cached = plain ? cachedNode(fileName, *plain) : nullptr) {
        const osg::ref_ptr<osg::Node> copy = copyForBins(*cached);
        if (!copy) return result;
        if (cached == node) {
            result = ReadResult(copy.get(), result.status());
            node = copy;
        } else {
            replaceBelow(*node, *cached, *copy);
        }
    }
    const Expected& known = expected(fileName, options);
    // the result and this function
    if (node->referenceCount() == 2) {
        // a tile that is a transform gets a group above it
        osg::ref_ptr<osg::Node> root = node;
        if (node->asTransform()) {
            root = new Carrier;
            root->asGroup()->addChild(node);
        }
        install(*root, known);
        return ReadResult(root.get(), result.status());
    }
    const auto outcome = SharedTiles::instance().installOnce(*node, *_database, placeText(known.frame), generation,
                                                             [&] { install(*node, known); });
    if (outcome == SharedTiles::Outcome::Usable) return result;
    return unreadable(fileName, "a read callback shares one copy between two places or installations");
}

void BinReadFileCallback::install(osg::Node& node, const Expected& expected) const {
    if (!_database->isRemoved()) _database->install(node, expected.frame, expected.parent.get());
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
        replacing.callback = new BinReadFileCallback(&database, frame, previousCallback(*replacing.options));
        replacing.callback->setReplaced(optionsWithoutBins(own.get()));
        replacing.options->setReadFileCallback(replacing.callback);
    }
    for (const PagedFile& file : files) replacing.callback->expect(file.name, file.frame, parent);
    node.setDatabaseOptions(replacing.options.get());
}

osgDB::ReadFileCallback* previousCallback(const osgDB::Options& options) {
    osgDB::ReadFileCallback* callback = options.getReadFileCallback();
    auto* ours = dynamic_cast<BinReadFileCallback*>(callback);
    return ours ? ours->previous() : callback;
}

BinReadFileCallback* readCallbackOf(osg::PagedLOD& node) {
    const auto* options = dynamic_cast<osgDB::Options*>(node.getDatabaseOptions());
    return options ? dynamic_cast<BinReadFileCallback*>(options->getReadFileCallback()) : nullptr;
}

osgDB::Options* optionsWithoutBins(osgDB::Options* options) {
    auto* const ours = options ? dynamic_cast<BinReadFileCallback*>(options->getReadFileCallback()) : nullptr;
    return ours ? ours->replaced() : options;
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
