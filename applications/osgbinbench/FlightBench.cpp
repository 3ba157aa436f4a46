// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightBench.h"

#include "Interruption.h"
#include "ProgressLine.h"
#include "Quantiles.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <numeric>
#include <thread>

namespace osgAnalyticBin::bench {

namespace {

constexpr std::size_t kFramesPerTurn = 50;

class Flight {
public:
    Flight(const CullMethod& method, const Settings& settings, FileWatch& watch)
        : _scene(method, settings, watch), _watch(watch), _period(1.0 / settings.frameRate) {
        for (const FlightColumn& column : kFlightColumns) _sums[column.name] = std::uint64_t{0};
        _scene.load();
        _scene.pause();
    }

    void takeTurn(const flight::CameraPose* begin, const flight::CameraPose* end) {
        const Turn turn(*this);
        for (const flight::CameraPose* pose = begin; pose != end; ++pose) fly(*pose);
    }

    void jumpTo(const flight::CameraPose& pose, double timeout) {
        const Turn turn(*this);
        const auto begin = Clock::now();
        while (fly(pose)) {
            if (Clock::now() - begin > std::chrono::duration<double>(timeout)) throw _scene.lateAt(pose);
        }
        const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin);
        add("complete_ms", static_cast<std::uint64_t>(passed.count()));
    }

    [[nodiscard]] FlightFigures figures() {
        const support::Quantiles times(_times);
        FlightFigures figures{_scene.method().name, {{"frames", _times.size()}}};
        _sums["resident_tiles"] = flight::residentTiles(_scene.root());
        _sums[kCullColumn] = std::accumulate(_times.begin(), _times.end(), 0.0);
        _sums["cull_median_ms"] = times.at(50, 100);
        _sums["cull_99th_ms"] = times.at(99, 100);
        figures.sums.update(_sums);
        return figures;
    }

private:
    using Clock = std::chrono::steady_clock;

    // While a method has its turn its pager runs, and what is read counts.
    class Turn {
    public:
        explicit Turn(Flight& flight)
            : _flight(flight), _files(flight._watch.reads->nodeFiles()), _bytes(flight._watch.reads->nodeBytes()) {
            flight._scene.resume();
        }
        ~Turn() {
            _flight._scene.pause();
            _flight.add("files_requested", _flight._watch.reads->nodeFiles() - _files);
            _flight.add("bytes", _flight._watch.reads->nodeBytes() - _bytes);
        }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        Flight& _flight;
        const std::uint64_t _files, _bytes;
    };

    // Returns: whether something was missing.
    bool fly(const flight::CameraPose& pose) {
        const auto end = Clock::now() + _period;
        const PagedScene::Frame frame = _scene.flyFrame(pose, _period.count());
        add("missing_frames", frame.wanted > 0 ? 1U : 0U);
        add("asked_again", frame.askedAgain);
        _times.push_back(frame.cullMs);
        add("drawn_tiles", _scene.census().tiles.size());
        std::this_thread::sleep_until(end);
        return frame.wanted > 0;
    }

    void add(const char* column, std::uint64_t count) { _sums[column] = _sums[column].get<std::uint64_t>() + count; }

    MethodScene _scene;
    FileWatch& _watch;
    std::chrono::duration<double> _period;
    report::Json _sums;
    std::vector<double> _times;
};

std::vector<std::unique_ptr<Flight>> flightsOf(const Settings& settings, const std::vector<CullMethod>& methods,
                                               FileWatch& watch) {
    std::vector<std::unique_ptr<Flight>> flights;
    for (const CullMethod& method : methods) {
        if (method.replaysVerdicts)
            std::cerr << "osgbinbench: " << method.name << " does not fly: its verdicts hold for one pose" << std::endl;
        else
            flights.push_back(std::make_unique<Flight>(method, settings, watch));
    }
    return flights;
}

// Methods stop together: each has flown as far as the others.
bool isStopped(std::size_t done) {
    if (done == 0) support::throwIfStopRequested();
    return support::stopRequested;
}

std::vector<FlightFigures> figuresOf(const std::vector<std::unique_ptr<Flight>>& flights) {
    std::vector<FlightFigures> figures;
    for (const auto& flight : flights) figures.push_back(flight->figures());
    return figures;
}

}  // namespace

std::vector<FlightFigures> flyContinuously(const Settings& settings, const std::vector<CullMethod>& methods,
                                           const std::vector<flight::CameraPose>& frames, FileWatch& watch) {
    const auto flights = flightsOf(settings, methods, watch);
    support::ProgressLine progress(stderr);
    for (std::size_t begin = 0; begin < frames.size() && !isStopped(begin); begin += kFramesPerTurn) {
        progress.show(static_cast<double>(begin) / static_cast<double>(frames.size()),
                      "osgbinbench: " + std::to_string(frames.size()) + " frames with paging live, ");
        const std::size_t end = std::min(begin + kFramesPerTurn, frames.size());
        for (std::size_t i = 0; i < flights.size(); ++i)
            flights[(i + begin / kFramesPerTurn) % flights.size()]->takeTurn(&frames[begin], frames.data() + end);
    }
    return figuresOf(flights);
}

std::vector<FlightFigures> jump(const Settings& settings, const std::vector<CullMethod>& methods,
                                const std::vector<flight::CameraPose>& poses, FileWatch& watch) {
    const auto flights = flightsOf(settings, methods, watch);
    support::ProgressLine progress(stderr);
    for (std::size_t i = 0; i < poses.size() && !isStopped(i); ++i) {
        progress.show(static_cast<double>(i) / static_cast<double>(poses.size()),
                      "osgbinbench: " + std::to_string(poses.size()) + " jumps with paging live, ");
        for (std::size_t k = 0; k < flights.size(); ++k)
            flights[(k + i) % flights.size()]->jumpTo(poses[i], settings.timeout);
    }
    return figuresOf(flights);
}

}  // namespace osgAnalyticBin::bench
