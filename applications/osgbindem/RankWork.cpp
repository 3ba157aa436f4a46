// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RankWork.h"

#include "DatabaseFolder.h"
#include "DiskFile.h"
#include "Failure.h"
#include "Interruption.h"
#include "NodeFile.h"
#include "WorkPlan.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <mutex>
#include <new>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::Interrupted;
using osgAnalyticBin::support::stopRequested;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

std::string textOf(const Task& task) {
    char text[96];
    std::snprintf(text, sizeof text, "%d %d %d %a", task.tile.level, task.tile.x, task.tile.y, task.weight);
    return text;
}

Task taskFrom(const std::string& text) {
    Task task;
    (void)std::sscanf(text.c_str(), "%d %d %d %la", &task.tile.level, &task.tile.x, &task.tile.y, &task.weight);
    return task;
}

std::string messageOf(const std::exception_ptr& error) {
    constexpr std::size_t kMost = 1000;  // short messages never wait for who receives them
    try {
        std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        return "out of memory; use fewer ranks or --threads on a machine";
    } catch (const std::exception& failure) {
        return std::string(failure.what()).substr(0, kMost);
    }
}

/// The tasks that rank 0 hands out, for the threads of this rank. They use next(), finish() and fail(); the rest is for
/// the thread that talks to rank 0.
class HandedTasks final : public TaskSource {
public:
    std::optional<Task> next() override {
        constexpr std::chrono::milliseconds kGlance{50};
        std::unique_lock<std::mutex> guard(_mutex);
        ++_wanted;
        while (_given.empty() && !_isOver && !_error) {
            throwIfStopRequested();
            _changed.wait_for(guard, kGlance);
        }
        if (_given.empty() || _error) return std::nullopt;
        const Task task = _given.back();
        _given.pop_back();
        return task;
    }
    void finish(const Task& task) override {
        const std::lock_guard<std::mutex> guard(_mutex);
        _finished.push_back(task);
    }
    void fail(std::exception_ptr error) override {
        const std::lock_guard<std::mutex> guard(_mutex);
        if (!_error) _error = std::move(error);
        stopRequested.store(true);
        _changed.notify_all();
    }

    /// Says to rank 0 what has happened here.
    void tell(const Ranks& ranks) {
        const std::lock_guard<std::mutex> guard(_mutex);
        for (const Task& task : _finished) ranks.send(0, Word::Finished, textOf(task));
        _finished.clear();
        for (; _wanted > 0 && !_isOver; --_wanted) ranks.send(0, Word::Want);
    }
    void give(const Task& task) {
        const std::lock_guard<std::mutex> guard(_mutex);
        _given.push_back(task);
        _changed.notify_all();
    }
    void close() {
        const std::lock_guard<std::mutex> guard(_mutex);
        _isOver = true;
        _changed.notify_all();
    }
    [[nodiscard]] std::exception_ptr error() const {
        const std::lock_guard<std::mutex> guard(_mutex);
        return _error;
    }

private:
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    std::vector<Task> _given;
    std::vector<Task> _finished;
    int _wanted = 0;
    bool _isOver = false;
    std::exception_ptr _error;
};

/// Returns: false when rank 0 wants this one to stop.
bool listen(const Ranks& ranks, HandedTasks& tasks) {
    const auto message = ranks.receive();
    if (!message) {
        waitABit();
        return true;
    }
    if (message->word == Word::Do) tasks.give(taskFrom(message->text));
    if (message->word == Word::NoMore) tasks.close();
    return message->word != Word::Stop;
}

void work(const Settings& settings, const Ranks& ranks) {
    prepareNodeFiles();
    const TileLayout layout = layoutFor(settings, DemMosaic(settings));
    const DatabaseFolder folder(settings.output);
    const TileFiles files = folder.files(layout);
    const BuildState state(folder.stateFolder());
    Progress progress(false, 1.0);
    const Site site{settings, layout, files, state, progress};
    HandedTasks tasks;
    Threads threads(settings.threads, tasks, [&] {
        TileBuilder builder(settings, layout, files);
        doTasks(site, tasks, builder);
    });
    while (threads.areRunning()) {
        if (stopRequested && !tasks.error()) Ranks::leaveAfterSignal();
        tasks.tell(ranks);
        if (!listen(ranks, tasks)) tasks.fail(std::make_exception_ptr(Interrupted()));
    }
    threads.join();
    if (const std::exception_ptr error = tasks.error()) std::rethrow_exception(error);
    tasks.tell(ranks);
    osgAnalyticBin::support::flushToDisk(folder.partial());  // what this machine holds back of it
}

/// Nothing is written any more when this returns.
void waitForEnd(const Ranks& ranks) {
    while (true) {
        const auto message = ranks.receive();
        if (message && message->word == Word::End) return;
        if (!message) waitABit();
    }
}

}  // namespace

int serveRanks(const Ranks& ranks, const Threads& threads, TaskBoard& board, Progress& progress,
               const std::function<void()>& interrupted) {
    int done = 0;
    bool isStopping = false;
    while (threads.areRunning() || done < ranks.count() - 1) {
        if (stopRequested && !board.hasFailed()) interrupted();
        if (board.hasFailed() && !isStopping) {
            ranks.sendToOthers(Word::Stop);
            isStopping = true;
        }
        const auto message = ranks.receive();
        if (!message) {
            waitABit();
            continue;
        }
        if (message->word == Word::Want) {
            const auto task = board.take();
            ranks.send(message->rank, task ? Word::Do : Word::NoMore, task ? textOf(*task) : std::string());
        } else if (message->word == Word::Finished) {
            const Task task = taskFrom(message->text);
            progress.add(task.weight);
            board.finish(task);
        } else if (message->word == Word::Failed) {
            board.fail(std::make_exception_ptr(Failure(message->text)));
        } else if (message->word == Word::Done) {
            ++done;
        }
    }
    return done;
}

void workForFirstRank(const Settings& settings, const Ranks& ranks) {
    try {
        work(settings, ranks);
    } catch (const Interrupted&) {
        // rank 0 knows why
    } catch (...) {
        ranks.send(0, Word::Failed, messageOf(std::current_exception()));
    }
    ranks.send(0, Word::Done);
    waitForEnd(ranks);
}

}  // namespace osgbindem
