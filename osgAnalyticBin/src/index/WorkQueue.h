// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

/// Jobs for several threads; a finished job may add new ones. The newest job is taken first.
template <class Job>
class WorkQueue final {
public:
    /// Call before run(), or in `finish`.
    void push(Job job) { _waiting.push_back(std::move(job)); }

    /// Does all jobs in that many threads, one of which is the caller's: `work(job)` in parallel, then
    /// `finish(job, result)`, one at a time. The first exception stops the others and is thrown when all have ended.
    template <class Work, class Finish>
    void run(int threads, const Work& work, const Finish& finish) {
        const auto body = [&] {
            try {
                while (const std::optional<Job> job = next()) finishOne(*job, work(*job), finish);
            } catch (...) {
                fail(std::current_exception());
            }
        };
        std::vector<std::thread> others;
        for (int i = 1; i < threads; ++i) others.emplace_back(body);
        body();
        for (std::thread& thread : others) thread.join();
        if (_error) std::rethrow_exception(_error);
    }

private:
    std::optional<Job> next() {
        std::unique_lock<std::mutex> guard(_mutex);
        _changed.wait(guard, [&] { return _isStopped || !_waiting.empty() || _busy == 0; });
        if (_isStopped || _waiting.empty()) return std::nullopt;
        Job job = std::move(_waiting.back());
        _waiting.pop_back();
        ++_busy;
        return job;
    }

    template <class Result, class Finish>
    void finishOne(const Job& job, Result result, const Finish& finish) {
        const std::lock_guard<std::mutex> guard(_mutex);
        finish(job, std::move(result));
        --_busy;
        _changed.notify_all();
    }

    void fail(std::exception_ptr error) {
        const std::lock_guard<std::mutex> guard(_mutex);
        if (!_error) _error = std::move(error);
        _isStopped = true;
        _changed.notify_all();
    }

    std::mutex _mutex;
    std::condition_variable _changed;
    std::vector<Job> _waiting;
    int _busy = 0;
    bool _isStopped = false;
    std::exception_ptr _error;
};

}  // namespace osgAnalyticBin
