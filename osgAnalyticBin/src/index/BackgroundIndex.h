// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../kit/tile/TileBoundsSource.h"

#include <osgAnalyticBin/BinIndex.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace osgAnalyticBin {

/// Makes an index in a thread of low priority, which waits while the DatabasePager reads.
/// Threads: everything may be called at any time, start() once. The destructors of derived classes, and stop(), wait
/// for the thread, which ends after the file that it reads.
class BackgroundIndex : public TileBoundsSource {
public:
    void start() override;
    void stop();
    [[nodiscard]] bool isWhole() const override { return _isWhole.load(std::memory_order_acquire); }
    bool waitUntilWhole(std::chrono::duration<double> most) const override;
    void noteRead(int change) override { _reads.fetch_add(change, std::memory_order_relaxed); }
    void showNotes() override;

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

}  // namespace osgAnalyticBin
