// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kit/tile/TileBoundsSource.h"
#include "Checksum.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/index/DatabaseWalk.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace osgAnalyticBin {

namespace {

namespace fs = std::filesystem;
using indexing::DatabaseFiles;

// An index of more files takes more memory in a viewer than the tiles that are shown.
constexpr std::size_t kMostTiles = 2000000;

// Returns: the path of a database in a local file, outside of archives; else empty.
std::string localRoot(const std::string& databaseFileName, const osgDB::Options* options) {
    const std::string root = osgDB::findDataFile(databaseFileName, options);
    std::error_code ignored;
    const bool isLocal = !root.empty() && !osgDB::containsServerAddress(root) && fs::is_regular_file(root, ignored);
    const auto& archives = osgDB::Registry::instance()->getArchiveExtensions();
    const std::string extension = osgDB::getLowerCaseFileExtension(root);
    return isLocal && std::find(archives.begin(), archives.end(), extension) == archives.end() ? root : std::string();
}

// Whether all files are those that an index with stamps was made from. `checkpoint`: called for each file; what it
// throws ends the comparison. Cost: one call of the file system a file.
bool isCurrent(const BinIndex& index, const DatabaseFiles& files, const std::function<void()>& checkpoint) {
    const BinIndex::Stamps& stamps = index.stamps();
    return std::all_of(stamps.begin(), stamps.end(), [&](const auto& stamp) {
        checkpoint();
        return files.stampOf(stamp.first) == stamp.second;
    });
}

std::string cacheFolder() {
#if defined(_WIN32)
    const char* const local = std::getenv("LOCALAPPDATA");
    return local && *local ? std::string(local) + "/osgAnalyticBin" : std::string();
#else
    const char* const xdg = std::getenv("XDG_CACHE_HOME");
    if (xdg && *xdg == '/') return std::string(xdg) + "/osgAnalyticBin";
    const char* const home = std::getenv("HOME");
    if (home && *home == '/') return std::string(home) + "/.cache/osgAnalyticBin";
    return {};
#endif
}

// The file in the user's cache folder that keeps the index of a database:
// "$XDG_CACHE_HOME/osgAnalyticBin/CHECKSUM.bins", or below "$HOME/.cache", on Windows below "%LOCALAPPDATA%", by
// a checksum of the absolute path of the root file. Returns: empty where there is no such folder.
std::string cachedIndexName(const std::string& rootFile) {
    const std::string folder = cacheFolder();
    std::error_code failure;
    const std::string path = fs::canonical(rootFile, failure).string();
    if (folder.empty() || failure) return {};
    char name[32];
    std::snprintf(name, sizeof name, "/%016llx", static_cast<unsigned long long>(indexing::crc64(path)));
    return binIndexName(folder + name);
}

// The index that was kept in the cache folder. What is broken there is made anew.
osg::ref_ptr<BinIndex> readCached(const std::string& root, std::string& error) {
    const std::string cached = cachedIndexName(root);
    std::error_code ignored;
    if (cached.empty() || !fs::exists(cached, ignored)) return nullptr;
    osg::ref_ptr<BinIndex> index = BinIndex::read(cached, error);
    const bool isOther = index && (index->source().name != osgDB::getSimpleFileName(root) || index->stamps().empty());
    return isOther ? nullptr : index;
}

// Keeps an index in the cache folder. A file is replaced when the new one is complete. Of several processes that write
// the same file, the last one keeps its own. Returns: the path; empty, with the reason in `error`, when the index
// could not be kept.
std::string keepIndex(const BinIndex& index, const std::string& rootFile, std::string& error) {
    const std::string path = cachedIndexName(rootFile);
    if (path.empty()) {
        error = "there is no cache folder";
        return {};
    }
    std::error_code failure;
    fs::create_directories(fs::path(path).parent_path(), failure);
    // others may be keeping the same index
    std::random_device random;
    const std::string own = path + "." + std::to_string(random());
    if (!index.write(own, error)) return {};
    fs::rename(own, path, failure);
    if (!failure) return path;
    error = "cannot write \"" + path + "\": " + failure.message();
    fs::remove(own, failure);
    return {};
}

void lowerPriority() {
#if defined(__linux__)
    constexpr int kNice = 15;
    (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::syscall(SYS_gettid)), kNice);
#endif
}

struct Stopped {};

// Makes the index of a database in a thread of low priority, which waits while the
// DatabasePager reads, and keeps it for the next time.
class AutoIndex final : public TileBoundsSource {
public:
    // `kept`: indexes with stamps, of which one is used if no file has changed since.
    AutoIndex(const std::string& rootFile, std::vector<osg::ref_ptr<const BinIndex>> kept)
        : _rootFile(rootFile), _kept(std::move(kept)) {}

    void start() override {
        indexing::loadSerializers();
        RunningThreads::instance().add(*this);
        const std::lock_guard<std::mutex> guard(_threadMutex);
        _thread = std::thread([this] { run(); });
    }
    // Waits for the thread, which ends after the file that it reads.
    void stop() {
        _isStopped.store(true);
        {
            const std::lock_guard<std::mutex> guard(_mutex);
            _changed.notify_all();
        }
        const std::lock_guard<std::mutex> guard(_threadMutex);
        if (!_thread.joinable()) return;
        _thread.join();
        RunningThreads::instance().remove(*this);
    }
    [[nodiscard]] osg::ref_ptr<const BinIndex> whole() const override {
        const std::lock_guard<std::mutex> guard(_mutex);
        return _whole;
    }
    [[nodiscard]] bool hasEnded() const override {
        const std::lock_guard<std::mutex> guard(_mutex);
        return _hasEnded;
    }
    [[nodiscard]] bool hasNews() const override {
        const std::lock_guard<std::mutex> guard(_mutex);
        return _whole.valid() || !_notes.empty();
    }
    bool waitUntilWhole(std::chrono::duration<double> most) const override {
        std::unique_lock<std::mutex> guard(_mutex);
        _changed.wait_for(guard, most, [this] { return _hasEnded; });
        return _whole.valid();
    }
    void noteRead(int change) override { _reads.fetch_add(change, std::memory_order_relaxed); }
    void showNotes() override {
        std::vector<std::string> notes;
        {
            const std::lock_guard<std::mutex> guard(_mutex);
            notes.swap(_notes);
        }
        for (const std::string& line : notes) OSG_NOTICE << "osgAnalyticBin: " << line << std::endl;
    }

protected:
    ~AutoIndex() override { stop(); }

private:
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
    // What the thread does between the files.
    struct Observer final : indexing::WalkObserver {
        explicit Observer(AutoIndex& of) : index(of) {}
        void beforeFile() override { index.giveWay(); }
        void done(const indexing::FileRecord& record, bool, double) override { index.countTiles(record.tiles.size()); }
        AutoIndex& index;
    };

    void run() {
        lowerPriority();
        try {
            make();
        } catch (const Stopped&) {
            // stop() was called
        } catch (const std::exception& failure) {
            note("no index of \"" + _rootFile + "\" can be made: " + failure.what());
        }
        const std::lock_guard<std::mutex> guard(_mutex);
        _hasEnded = true;
        _changed.notify_all();
    }
    // Does the work, in the thread. What it throws is shown as the reason why there is no index.
    void make() {
        const DatabaseFiles files(_rootFile);
        for (const osg::ref_ptr<const BinIndex>& kept : std::exchange(_kept, {})) {
            if (isUpToDate(*kept, files)) return publish(kept);
        }
        constexpr int kMostRounds = 3;
        for (int round = 0; round < kMostRounds; ++round) {
            const osg::ref_ptr<const BinIndex> index = makeFrom(files);
            if (!isUpToDate(*index, files)) continue;  // files were changed meanwhile
            publish(index);
            return keep(*index);
        }
        throw indexing::Failure("its files change all the time");
    }
    // Reads all files. Returns: the index, with stamps.
    [[nodiscard]] osg::ref_ptr<BinIndex> makeFrom(const DatabaseFiles& files) {
        _tiles = 0;
        Observer observer(*this);
        indexing::MadeIndex made = indexing::indexFrom(files, indexing::walkDatabase(files, {}, observer, 1));
        BinIndex::Stamps stamps;
        for (const auto& [file, record] : made.records) stamps[file] = record.stamp;
        made.index->setStamps(std::move(stamps));
        return made.index;
    }
    [[nodiscard]] bool isUpToDate(const BinIndex& index, const DatabaseFiles& files) const {
        return isCurrent(index, files, [this] { throwIfStopped(); });
    }
    void publish(const osg::ref_ptr<const BinIndex>& index) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _whole = index;
    }
    void keep(const BinIndex& index) {
        throwIfStopped();
        std::string error;
        const std::string path = keepIndex(index, _rootFile, error);
        note("the index of \"" + _rootFile + "\" is complete: " + std::to_string(index.tileCount()) + " tiles, " +
             (path.empty() ? "not kept (" + error + ")" : "kept in \"" + path + "\""));
    }
    void note(const std::string& line) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _notes.push_back(line);
    }
    void countTiles(std::size_t more) {
        _tiles += more;
        if (_tiles <= kMostTiles) return;
        throw indexing::Failure("it has more than " + std::to_string(kMostTiles) + " tiles; run osgbinconv --index");
    }
    void throwIfStopped() const {
        if (_isStopped.load(std::memory_order_relaxed)) throw Stopped();
    }
    // Waits while the pager reads, but not without limit.
    void giveWay() {
        using namespace std::chrono_literals;
        constexpr auto kStep = 2ms;
        constexpr auto kLongest = 100ms;
        std::unique_lock<std::mutex> guard(_mutex);
        for (auto waited = 0ms; waited < kLongest; waited += kStep) {
            throwIfStopped();
            if (_reads.load(std::memory_order_relaxed) <= 0) return;
            _changed.wait_for(guard, kStep);
        }
        throwIfStopped();
    }

    const std::string _rootFile;
    std::vector<osg::ref_ptr<const BinIndex>> _kept;
    std::size_t _tiles = 0;
    std::thread _thread;
    std::mutex _threadMutex;  // of _thread
    std::atomic<bool> _isStopped{false};
    std::atomic<int> _reads{0};
    mutable std::mutex _mutex;  // guards what follows
    mutable std::condition_variable _changed;
    bool _hasEnded = false;
    std::vector<std::string> _notes;
    osg::ref_ptr<const BinIndex> _whole;
};

}  // namespace

ChosenIndex chooseIndex(const std::string& databaseFileName, const osgDB::Options* readOptions, IndexUse use) {
    if (use == IndexUse::Off || databaseFileName.empty()) return {};
    const std::string root = localRoot(databaseFileName, readOptions);
    const bool isMade = use == IndexUse::Auto && !root.empty();
    // stamps of so many files are compared before the first frame
    constexpr std::size_t kFewFiles = 4096;
    std::vector<osg::ref_ptr<const BinIndex>> kept;
    // one beside the database may be out of date, and one in the cache folder not
    for (const bool isBeside : {true, false}) {
        if (!isBeside && !isMade) break;
        std::string error;
        const osg::ref_ptr<const BinIndex> index =
            isBeside ? readBinIndex(databaseFileName, readOptions, error) : readCached(root, error);
        if (!error.empty()) {
            OSG_WARN << "osgAnalyticBin: " << error << (isMade ? "; that is done in the background now" : "")
                     << std::endl;
        }
        if (!index) continue;
        if (index->stamps().empty()) return {index, nullptr};
        // times of files in archives and on servers are not known
        if (root.empty()) return {};
        if (isMade && index->stamps().size() > kFewFiles) {
            kept.push_back(index);
        } else if (isCurrent(*index, DatabaseFiles(root), [] {})) {
            return {index, nullptr};
        }
    }
    return {nullptr, isMade ? new AutoIndex(root, std::move(kept)) : nullptr};
}

}  // namespace osgAnalyticBin
