// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BackgroundIndex.h"

#include "IndexStore.h"

#include <osgAnalyticBin/index/DatabaseFiles.h>

#include <osg/Notify>
#include <osgDB/Registry>

#include <exception>
#include <set>
#include <utility>

#if defined(__linux__)
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace osgAnalyticBin {

namespace {

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
        std::set<BackgroundIndex*> running;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            running = _running;
        }
        for (BackgroundIndex* const index : running) index->stop();
    }
    void add(BackgroundIndex& index) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _running.insert(&index);
    }
    void remove(BackgroundIndex& index) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _running.erase(&index);
    }

private:
    std::mutex _mutex;
    std::set<BackgroundIndex*> _running;
};

}  // namespace

BackgroundIndex::~BackgroundIndex() = default;

void BackgroundIndex::start() {
    indexing::loadSerializers();
    RunningThreads::instance().add(*this);
    const std::lock_guard<std::mutex> guard(_threadMutex);
    _thread = std::thread([this] { run(); });
}

void BackgroundIndex::stop() {
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

void BackgroundIndex::run() {
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

bool BackgroundIndex::waitUntilWhole(std::chrono::duration<double> most) const {
    std::unique_lock<std::mutex> guard(_mutex);
    _changed.wait_for(guard, most, [this] { return _hasEnded; });
    return isWhole();
}

void BackgroundIndex::showNotes() {
    std::vector<std::string> notes;
    {
        const std::lock_guard<std::mutex> guard(_mutex);
        notes.swap(_notes);
    }
    for (const std::string& line : notes) OSG_NOTICE << "osgAnalyticBin: " << line << std::endl;
}

void BackgroundIndex::publish(const std::function<void()>& change) {
    const std::lock_guard<std::mutex> guard(_mutex);
    change();
    _isWhole.store(true, std::memory_order_release);
}

void BackgroundIndex::keep(const BinIndex& index) {
    throwIfStopped();
    std::string error;
    const std::string path = indexing::keepIndex(index, _rootFile, error);
    note("the index of \"" + _rootFile + "\" is complete: " + std::to_string(index.tileCount()) + " tiles, " +
         (path.empty() ? "not kept (" + error + ")" : "kept in \"" + path + "\""));
}

void BackgroundIndex::note(const std::string& line) {
    const std::lock_guard<std::mutex> guard(_mutex);
    _notes.push_back(line);
}

void BackgroundIndex::throwIfStopped() const {
    if (_isStopped.load(std::memory_order_relaxed)) throw Stopped();
}

void BackgroundIndex::giveWay() {
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

}  // namespace osgAnalyticBin
