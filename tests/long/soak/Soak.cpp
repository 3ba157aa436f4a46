// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Flies at random for a long time while databases are paged, added and removed, and bins, options and threading models
// change; fails when memory grows, when a tile is lost, or when something hangs. See tests/README.md.

#include "Flight.h"

#include <osg/ArgumentParser>

#include <csignal>
#include <cstdio>
#include <execinfo.h>
#include <iomanip>
#include <malloc.h>
#include <new>
#include <support/TemporaryFolder.h>
#include <unistd.h>

namespace osgAnalyticBin::test {
namespace {

// What operator new has handed out in this process, in all libraries, and delete has not taken back.
std::atomic<long long> bytes{0};

void* allocate(std::size_t size) noexcept {
    void* const memory = std::malloc(size > 0 ? size : 1);
    if (memory) bytes.fetch_add(static_cast<long long>(malloc_usable_size(memory)), std::memory_order_relaxed);
    return memory;
}

void release(void* memory) noexcept {
    if (!memory) return;
    bytes.fetch_sub(static_cast<long long>(malloc_usable_size(memory)), std::memory_order_relaxed);
    std::free(memory);
}

constexpr unsigned int kPatience = 60;  // seconds
char last[256] = "";

// Linux sends the signal to the main thread.
void onAlarm(int) {
    (void)!write(STDERR_FILENO, last, std::strlen(last));
    void* frames[64];
    backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
    std::abort();
}

}  // namespace

void reportProgress(const std::string& what) {
    (void)std::signal(SIGALRM, onAlarm);
    std::snprintf(last, sizeof last, "hangs for %u s: %s\n", kPatience, what.c_str());
    (void)alarm(kPatience);
}

namespace {

constexpr const char* kUsage =
    "usage: osganalyticbin_soak [--frames N] [--seed N] [--bins on|off]\n"
    "  --frames N     frames to fly, half of them with one viewer, half with many (100000)\n"
    "  --seed N       of the flight (1)\n"
    "  --bins on|off  off: the same flight with OpenSceneGraph alone, to tell its growth apart (on)\n"
    "Needs a display. Exits with 1 when memory grows by more than 1 %, when the picture differs from that without\n"
    "culling, or when objects of the kit outlive their scene; aborts when a frame takes more than 60 s.\n";

struct Arguments {
    unsigned int frames = 100000, seed = 1;
    bool withBins = true;
};

// Returns: false, after a line that says why, when something is not understood.
bool parse(int count, char** texts, Arguments& arguments) {
    osg::ArgumentParser parser(&count, texts);
    std::string bins = "on";
    (void)parser.read("--frames", arguments.frames);
    (void)parser.read("--seed", arguments.seed);
    (void)parser.read("--bins", bins);
    arguments.withBins = bins == "on";
    if (!parser.errors() && parser.argc() == 1 && (bins == "on" || bins == "off")) return true;
    std::cerr << "osganalyticbin_soak: an argument is not understood; see --help\n";
    return false;
}

// Megabytes by operator new: what OpenSceneGraph and the kit hold, drivers in C left out.
struct Samples {
    std::vector<double> objects;
    const std::chrono::steady_clock::time_point _start = std::chrono::steady_clock::now();

    void add(const char* where, std::size_t frames) {
        objects.push_back(static_cast<double>(bytes.load(std::memory_order_relaxed)) / (1024.0 * 1024.0));
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - _start;
        std::cout << std::setw(7) << std::lround(elapsed.count()) << std::setw(9) << frames << "  " << std::setw(9)
                  << where << std::fixed << std::setprecision(3) << std::setw(12) << objects.back() << std::endl;
    }
};

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Growth from the median of the first tenth of samples to that of the last, in percent of `whole`, where the first
// fifth of all was left out as a warm-up; 0 for fewer than 20 samples.
double growthPercent(const std::vector<double>& samples, double whole) {
    if (samples.size() < 20) return 0.0;
    const auto warm = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 5);
    const auto tenth = static_cast<std::ptrdiff_t>(std::max<std::size_t>(samples.size() / 10, 3));
    return 100.0 * (median({samples.end() - tenth, samples.end()}) - median({warm, warm + tenth})) / whole;
}

class Soak {
public:
    explicit Soak(const Arguments& arguments) : _arguments(arguments), _random(910, arguments.seed) {}

    int run() {
        reportProgress("writes databases");
        // the first two stay: what is known of a false database grows with every tile that is met for the first time
        _databases = {writeSyntheticDatabase(_folder.makeFolder("one")),
                      writeSyntheticDatabase(_folder.makeFolder("two")),
                      writeFalseDatabase(_folder.makeFolder("false"))};
        std::cout << "seconds   frames      where  objects MB\n";
        flyWithOneViewer();
        flyWithManyViewers();
        return verdict();
    }

private:
    void flyWithOneViewer() {
        const std::size_t frames = _arguments.frames / 2;
        const std::size_t round = std::max<std::size_t>(frames / 100, 50);
        Flight flight({Threading::SingleThreaded, Layout::Views, 2, _arguments.withBins}, _databases, _random,
                      _findings);
        flight.halt();
        _cold.add("cold", 0);
        // shorter flights have too few stations to tell growth
        constexpr std::size_t kFewestFrames = 2000;
        if (_arguments.frames >= kFewestFrames) flight.warmUp();
        while (_findings.frames < frames) {
            flight.fly(round);
            flight.halt();
            _stations.add("station", _findings.frames);
        }
    }

    void flyWithManyViewers() {
        const std::size_t round = std::max<std::size_t>(_arguments.frames / 80, 12);
        constexpr int kCameras[] = {1, 2, 4};
        for (std::size_t life = 0; _findings.frames < _arguments.frames; ++life) {
            {
                Flight flight({kThreadingModels[life % 4], life % 8 < 4 ? Layout::Views : Layout::Slaves,
                               kCameras[life % 3], _arguments.withBins},
                              _databases, _random, _findings);
                flight.fly(round);
                if (life % 4 == 0) flight.halt();
            }
            reportProgress("after a viewer");
            _ends.add("no viewer", _findings.frames);
        }
    }

    int verdict() {
        // in percent of all that a flight holds, without the pools that the warm-up fills; without a viewer hardly any
        const double whole = median(_cold.objects);
        const double station = growthPercent(_stations.objects, whole);
        const double end = growthPercent(_ends.objects, whole);
        std::cout << "frames " << _findings.frames << ", stations " << _findings.stations << ", PagedLODs refined "
                  << _findings.tilesLoaded << " (every 16th frame)\n"
                  << "growth with one viewer " << station << " %, with many viewers " << end << " %\n"
                  << "pictures " << _findings.pictures << ", pixels covered " << _findings.coveredPixels
                  << ", pictures that differ " << _findings.differingPictures << " (pixels "
                  << _findings.differingPixels << ")\n"
                  << "objects of the kit outside of the scene " << _findings.strayObjects << ", tiles not drained "
                  << _findings.undrainedTiles << ", stations that did not come to rest " << _findings.unloaded
                  << std::endl;
        const bool grows = station > 1.0 || end > 1.0;
        const bool isWorthIt = _findings.tilesLoaded > 0 && _findings.coveredPixels > 0;
        const bool fails = grows || _findings.differingPictures > 0 || _findings.strayObjects > 0 ||
                           _findings.undrainedTiles > 0 || _findings.unloaded > 0 || !isWorthIt;
        std::cout << (fails ? "FAILED" : "passed") << std::endl;
        return fails ? 1 : 0;
    }

    const Arguments _arguments;
    Random _random;
    Findings _findings;
    const TemporaryFolder _folder;
    std::vector<std::string> _databases;
    Samples _cold, _stations, _ends;
};

}  // namespace
}  // namespace osgAnalyticBin::test

// The process's operator new and delete: malloc's, counted. Forms that are left out call these.

void* operator new(std::size_t size) {
    if (void* memory = osgAnalyticBin::test::allocate(size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    osgAnalyticBin::test::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    osgAnalyticBin::test::release(memory);
}

int main(int count, char** texts) {
    using namespace osgAnalyticBin::test;
    if (count > 1 && std::string(texts[1]) == "--help") {
        std::cout << kUsage;
        return 0;
    }
    Arguments arguments;
    if (!parse(count, texts, arguments)) return 2;
    if (!ViewerRig::canDraw()) {
        std::cerr << "osganalyticbin_soak: no graphics context; start it with xvfb-run\n";
        return 77;
    }
    return Soak(arguments).run();
}
