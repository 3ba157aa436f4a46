// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// For programs that try random cases on all cores: few of them in ctest, any number by hand.

#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <support/Random.h>
#include <thread>
#include <vector>

namespace osgAnalyticBin::test {

struct LongRun {
    std::uint64_t trials = 10000000;
    std::uint64_t seedValue = seed();
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    bool hasFlag = false;  ///< the program's own option was given
};

/// Reads "--trials N", "--seed S", and an option of the program such as "--ties". For any other argument it prints the
/// usage and returns nullopt.
[[nodiscard]] inline std::optional<LongRun> longRunOf(int argc, char** argv, const std::string& flag) {
    LongRun run;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name == flag) {
            run.hasFlag = true;
            continue;
        }
        const std::uint64_t value = i + 1 < argc ? std::strtoull(argv[++i], nullptr, 0) : 0;
        if (name == "--trials" && value > 0) {
            run.trials = value;
        } else if (name == "--seed") {
            run.seedValue = value;
        } else {
            std::printf("%s [%s] [--trials N] [--seed S]\n", argv[0], flag.c_str());
            return std::nullopt;
        }
    }
    return run;
}

/// Calls `check(random, trials, counts)` for chunks of trials. Chunks have streams of their own: the sum does not
/// depend on the number of threads. `Counts` has add().
template <class Counts, class Check>
[[nodiscard]] Counts runChunks(const LongRun& run, std::uint64_t trialsPerChunk, const Check& check) {
    const std::uint64_t chunks = (run.trials + trialsPerChunk - 1) / trialsPerChunk;
    std::vector<Counts> counts(run.threads);
    std::atomic<std::uint64_t> nextChunk{0};
    std::vector<std::thread> threads;
    for (Counts& own : counts) {
        threads.emplace_back([&] {
            for (std::uint64_t chunk = nextChunk++; chunk < chunks; chunk = nextChunk++) {
                Random random(chunk + 1, run.seedValue);
                check(random, std::min(trialsPerChunk, run.trials - chunk * trialsPerChunk), own);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 1; i < counts.size(); ++i) counts[0].add(counts[i]);
    return counts[0];
}

/// Seconds since it was made.
class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - _start).count();
    }

private:
    std::chrono::steady_clock::time_point _start = std::chrono::steady_clock::now();
};

}  // namespace osgAnalyticBin::test
