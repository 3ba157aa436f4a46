// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "AutoIndex.h"

#include "IndexStore.h"
#include "SubtreeBins.h"

#include <osgAnalyticBin/index/DatabaseWalk.h>
#include <osgAnalyticBin/index/Failure.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <set>
#include <utility>

#if defined(__linux__)
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace osgAnalyticBin {

namespace {

using indexing::DatabaseFiles;

// More take more memory in a viewer than tiles that are shown.
constexpr std::size_t kMostTiles = 2000000;
// Stamps of so many files are compared before the first frame.
constexpr std::size_t kFewFiles = 4096;

struct Stopped {};

void lowerPriority() {
#if defined(__linux__)
    constexpr int kNice = 15;
    (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::syscall(SYS_gettid)), kNice);
#endif
}

// Threads must end before OSG's registry does, also where an application never deletes its scene.
class RunningThreads {
public:
    static RunningThreads& instance() {
        (void)osgDB::Registry::instance();  // made first, deleted last
        static RunningThreads threads;
        return threads;
    }
    ~RunningThreads() {
        std::set<AutoIndex*> running;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            running = _running;
        }
        for (AutoIndex* const index : running) index->stop();
    }
    void add(AutoIndex& index) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _running.insert(&index);
    }
    void remove(AutoIndex& index) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _running.erase(&index);
    }

private:
    std::mutex _mutex;
    std::set<AutoIndex*> _running;
};

// Returns: the path of a database in a local file, outside of archives; else empty.
std::string localRoot(const std::string& databaseFileName, const osgDB::Options* options) {
    const std::string root = osgDB::findDataFile(databaseFileName, options);
    std::error_code ignored;
    const bool isLocal =
        !root.empty() && !osgDB::containsServerAddress(root) && std::filesystem::is_regular_file(root, ignored);
    const auto& archives = osgDB::Registry::instance()->getArchiveExtensions();
    const std::string extension = osgDB::getLowerCaseFileExtension(root);
    return isLocal && std::find(archives.begin(), archives.end(), extension) == archives.end() ? root : std::string();
}

// The index that was kept in the cache folder. What is broken there is made anew.
osg::ref_ptr<BinIndex> readCached(const std::string& root, std::string& error) {
    const std::string cached = indexing::cachedIndexName(root);
    std::error_code ignored;
    if (cached.empty() || !std::filesystem::exists(cached, ignored)) return nullptr;
    osg::ref_ptr<BinIndex> index = BinIndex::read(cached, error);
    const bool isOther = index && (index->source().name != osgDB::getSimpleFileName(root) || index->stamps().empty());
    return isOther ? nullptr : index;
}

}  // namespace

// What the thread does between the files.
class AutoIndex::Observer final : public indexing::WalkObserver {
public:
    explicit Observer(AutoIndex& index)
        : _index(index), _subtrees([this](const std::string& file, std::vector<BinIndex::Entry> tiles) {
              _index.publish(file, std::move(tiles));
          }) {}

    void beforeFile() override { _index.giveWay(); }
    void done(const indexing::FileRecord& record, bool, double) override {
        _tiles += record.tiles.size();
        if (_tiles > kMostTiles) {
            throw indexing::Failure("it has more than " + std::to_string(kMostTiles) +
                                    " tiles; run osgbinconv --index");
        }
        _subtrees.add(record);
    }

private:
    AutoIndex& _index;
    indexing::SubtreeBins _subtrees;
    std::size_t _tiles = 0;
};

AutoIndex::AutoIndex(const std::string& rootFile, osg::ref_ptr<BinIndex> kept)
    : _rootFile(rootFile), _kept(std::move(kept)) {}

AutoIndex::~AutoIndex() {
    stop();
}

void AutoIndex::start() {
    indexing::loadSerializers();
    RunningThreads::instance().add(*this);
    const std::lock_guard<std::mutex> lock(_threadMutex);
    _thread = std::thread([this] { run(); });
}

void AutoIndex::stop() {
    _isStopped.store(true);
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _changed.notify_all();
    }
    const std::lock_guard<std::mutex> lock(_threadMutex);
    if (!_thread.joinable()) return;
    _thread.join();
    RunningThreads::instance().remove(*this);
}

void AutoIndex::run() {
    lowerPriority();
    try {
        const DatabaseFiles files(_rootFile);
        if (_kept && indexing::isCurrent(*_kept, files, [this] { throwIfStopped(); })) {
            publishWhole(std::exchange(_kept, nullptr));
        } else {
            _kept = nullptr;
            make(files);
        }
    } catch (const Stopped&) {
        // nobody waits for it any more
    } catch (const std::exception& failure) {
        note("no index of \"" + _rootFile + "\" can be made: " + failure.what());
    }
    const std::lock_guard<std::mutex> lock(_mutex);
    _hasEnded = true;
    _changed.notify_all();
}

void AutoIndex::make(const DatabaseFiles& files) {
    constexpr int kMostRounds = 3;
    std::vector<indexing::FileRecord> known;
    for (int round = 0; round < kMostRounds; ++round) {
        Observer observer(*this);
        indexing::FileRecords records = indexing::walkDatabase(files, std::move(known), observer, 1);
        indexing::MadeIndex made = indexing::indexFrom(files, std::move(records));
        BinIndex::Stamps stamps;
        for (const auto& [file, record] : made.records) stamps[file] = record.stamp;
        made.index->setStamps(std::move(stamps));
        if (!indexing::isCurrent(*made.index, files, [this] { throwIfStopped(); })) {
            // files were changed meanwhile
            forgetSubtrees();
            known.clear();
            for (auto& [file, record] : made.records) known.push_back(std::move(record));
            continue;
        }
        const std::size_t tiles = made.index->tileCount();
        publishWhole(made.index);
        throwIfStopped();
        std::string error;
        const std::string path = indexing::keepIndex(*made.index, _rootFile, error);
        note("the index of \"" + _rootFile + "\" is complete: " + std::to_string(tiles) + " tiles, " +
             (path.empty() ? "not kept (" + error + ")" : "kept in \"" + path + "\""));
        return;
    }
    throw indexing::Failure("its files change all the time");
}

std::optional<BinIndex::Entry> AutoIndex::find(const std::string& file, std::size_t ordinal) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_whole) {
        const BinIndex::Entry* const entry = _whole->find(file, ordinal);
        return entry ? std::optional(*entry) : std::nullopt;
    }
    const auto found = _subtrees.find(file);
    if (found == _subtrees.end() || ordinal >= found->second.size()) return std::nullopt;
    return found->second[ordinal];
}

bool AutoIndex::waitUntilWhole(std::chrono::duration<double> most) const {
    std::unique_lock<std::mutex> lock(_mutex);
    _changed.wait_for(lock, most, [this] { return _hasEnded; });
    return _whole.valid();
}

std::vector<std::string> AutoIndex::takeNotes() {
    const std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_notes, {});
}

void AutoIndex::publish(const std::string& file, std::vector<BinIndex::Entry> tiles) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _subtrees[file] = std::move(tiles);
    ++_generation;
}

void AutoIndex::publishWhole(osg::ref_ptr<const BinIndex> index) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _whole = std::move(index);
    _subtrees.clear();
    _isWhole.store(true, std::memory_order_release);
    ++_generation;
}

void AutoIndex::forgetSubtrees() {
    const std::lock_guard<std::mutex> lock(_mutex);
    _subtrees.clear();
}

void AutoIndex::note(const std::string& line) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _notes.push_back(line);
}

void AutoIndex::throwIfStopped() const {
    if (_isStopped.load(std::memory_order_relaxed)) throw Stopped();
}

// The pager goes first, but does not stop the thread for ever.
void AutoIndex::giveWay() {
    using namespace std::chrono_literals;
    constexpr auto kStep = 2ms;
    constexpr auto kLongest = 100ms;
    std::unique_lock<std::mutex> lock(_mutex);
    for (auto waited = 0ms; waited < kLongest; waited += kStep) {
        throwIfStopped();
        if (_reads.load(std::memory_order_relaxed) <= 0) return;
        _changed.wait_for(lock, kStep);
    }
    throwIfStopped();
}

ChosenIndex chooseIndex(const std::string& databaseFileName, const osgDB::Options* readOptions, IndexUse use) {
    if (use == IndexUse::Off || databaseFileName.empty()) return {};
    const std::string root = localRoot(databaseFileName, readOptions);
    std::string error;
    osg::ref_ptr<BinIndex> index = readBinIndex(databaseFileName, readOptions, error);
    const bool isMade = use == IndexUse::Auto && !root.empty();
    std::string cacheError;
    if (!index && isMade) index = readCached(root, cacheError);
    if (error.empty()) error = cacheError;
    if (!error.empty()) {
        OSG_WARN << "osgAnalyticBin: " << error << (isMade ? "; that is done in the background now" : "") << std::endl;
    }
    if (index && index->stamps().empty()) return {index, nullptr};
    // times of files in archives and on servers are not known
    if (index && root.empty()) return {};
    const bool isSoonCompared = index && (!isMade || index->stamps().size() <= kFewFiles);
    if (isSoonCompared && indexing::isCurrent(*index, DatabaseFiles(root), [] {})) return {index, nullptr};
    if (isSoonCompared) index = nullptr;
    return {nullptr, isMade ? osg::ref_ptr<AutoIndex>(new AutoIndex(root, index)) : nullptr};
}

}  // namespace osgAnalyticBin
