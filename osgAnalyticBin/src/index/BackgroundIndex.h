// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>

#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <chrono>
#include <condition_variable>
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
    /// Stores the complete index for the next time, and reports that.
    void keep(const BinIndex& index);

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

}  // namespace osgAnalyticBin
