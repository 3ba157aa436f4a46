// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "IndexStore.h"

#include <osgAnalyticBin/index/DatabaseFiles.h>
#include <osgAnalyticBin/index/Failure.h>

#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

/// Makes an index in a thread of low priority, which waits while the DatabasePager reads.
/// Threads: everything may be called at any time, start() once. The destructors of derived classes, and stop(), wait
/// for the thread, which ends after the file that it reads.
class BackgroundIndex : public osg::Referenced {
public:
    void start();
    void stop();

    /// Whether the index is complete.
    [[nodiscard]] bool isWhole() const { return _isWhole.load(std::memory_order_acquire); }

    /// Waits until the index is complete or has failed. Returns: whether it is complete.
    bool waitUntilWhole(std::chrono::duration<double> most) const;

    /// Call when the DatabasePager begins (1) and ends (-1) to read a file.
    void noteRead(int change) { _reads.fetch_add(change, std::memory_order_relaxed); }

    /// Prints the thread's messages to the user, each once.
    void showNotes();

protected:
    explicit BackgroundIndex(const std::string& rootFile) : _rootFile(rootFile) {}
    /// Requires: stop() was called.
    ~BackgroundIndex() override;

    /// Does the work, in the thread. What it throws is shown as the reason why there is no index.
    virtual void make() = 0;

    [[nodiscard]] const std::string& rootFile() const { return _rootFile; }
    /// Guards what publish() changes.
    [[nodiscard]] std::unique_lock<std::mutex> lock() const { return std::unique_lock<std::mutex>(_mutex); }
    /// Runs `change` under the lock: the index is complete with it.
    void publish(const std::function<void()>& change);
    /// Stores the complete index for the next time, and reports that. `content`: what it holds, for the user.
    void keep(const indexing::IndexFile& file, const std::string& content);

    /// Ends the thread, by an exception, once stop() was called.
    void throwIfStopped() const;
    /// Waits while the pager reads, but not without limit. Throws as throwIfStopped().
    void giveWay();

private:
    void run();
    void note(const std::string& line);

    const std::string _rootFile;
    std::thread _thread;
    std::mutex _threadMutex;  // of _thread
    std::atomic<bool> _isStopped{false};
    std::atomic<bool> _isWhole{false};
    std::atomic<int> _reads{0};
    mutable std::mutex _mutex;  // guards what follows, and what publish() changes
    mutable std::condition_variable _changed;
    bool _hasEnded = false;
    std::vector<std::string> _notes;
};

/// The same for a kind of index. isCurrent() tells whether no file has changed since an index with stamps was made.
template <class Index>
class BackgroundIndexOf : public BackgroundIndex {
public:
    /// `kept`: an index with stamps, which is used if no file has changed since; null: none.
    BackgroundIndexOf(const std::string& rootFile, osg::ref_ptr<const Index> kept)
        : BackgroundIndex(rootFile), _kept(std::move(kept)) {}

    /// Returns: null until it is complete.
    [[nodiscard]] osg::ref_ptr<const Index> whole() const {
        const auto guard = lock();
        return _whole;
    }

protected:
    /// Reads all files. Returns: the index, with stamps.
    [[nodiscard]] virtual osg::ref_ptr<Index> makeFrom(const indexing::DatabaseFiles& files) = 0;
    /// Stores it for the next time.
    virtual void keepWhole(const Index& index) = 0;

private:
    void make() override {
        const indexing::DatabaseFiles files(rootFile());
        const auto isUpToDate = [&](const Index& index) {
            return isCurrent(index, files, [this] { throwIfStopped(); });
        };
        osg::ref_ptr<const Index> index = std::exchange(_kept, nullptr);
        if (index && isUpToDate(*index)) return publish([&] { _whole = index; });
        constexpr int kMostRounds = 3;
        for (int round = 0; round < kMostRounds; ++round) {
            index = makeFrom(files);
            if (!isUpToDate(*index)) continue;  // files were changed meanwhile
            publish([&] { _whole = index; });
            return keepWhole(*index);
        }
        throw indexing::Failure("its files change all the time");
    }

    osg::ref_ptr<const Index> _kept;
    osg::ref_ptr<const Index> _whole;  // guarded by lock()
};

/// Makes the thread that makes an index wait while a file is read. `index` may be null.
class BusyPager final {
public:
    explicit BusyPager(osg::ref_ptr<BackgroundIndex> index) : _index(std::move(index)) {
        if (_index) _index->noteRead(1);
    }
    ~BusyPager() {
        if (_index) _index->noteRead(-1);
    }
    BusyPager(const BusyPager&) = delete;
    BusyPager& operator=(const BusyPager&) = delete;

private:
    const osg::ref_ptr<BackgroundIndex> _index;
};

/// The index that a database is opened with.
template <class Index, class Making>
struct ChosenOf {
    osg::ref_ptr<const Index> index;  ///< null: none that can be used at once
    osg::ref_ptr<Making> making;      ///< not started; null: none is made
};

/// What is done with an index that was found. `index`: null: there is none. `root`: the local file of the database;
/// empty: it has none. `isMade`: whether one is made where this one cannot be used.
template <class Making, class Index>
[[nodiscard]] ChosenOf<Index, Making> chosenFrom(osg::ref_ptr<Index> index, const std::string& root, bool isMade) {
    // stamps of so many files are compared before the first frame
    constexpr std::size_t kFewFiles = 4096;
    if (index && index->stamps().empty()) return {index, nullptr};
    // times of files in archives and on servers are not known
    if (index && root.empty()) return {};
    const bool isSoonCompared = index && (!isMade || index->stamps().size() <= kFewFiles);
    if (isSoonCompared && isCurrent(*index, indexing::DatabaseFiles(root), [] {})) return {index, nullptr};
    if (isSoonCompared) index = nullptr;
    return {nullptr, isMade ? osg::ref_ptr<Making>(new Making(root, index)) : nullptr};
}

}  // namespace osgAnalyticBin
