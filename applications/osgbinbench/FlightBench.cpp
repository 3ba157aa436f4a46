// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Bench.h"
#include "BenchViewer.h"
#include "Failure.h"
#include "MethodScene.h"
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

using Clock = std::chrono::steady_clock;

constexpr std::size_t kFramesPerTurn = 50;
constexpr std::size_t kRounds = 3;  // of flights that are drawn

double sumOf(const std::vector<double>& times) {
    return std::accumulate(times.begin(), times.end(), 0.0);
}

/// The frames of one method that are culled only.
class Flight {
public:
    static constexpr const char* kLeftOut = " does not fly: its verdicts hold for one pose";
    [[nodiscard]] static bool leavesOut(const CullMethod& method) { return method.replaysVerdicts; }

    Flight(const CullMethod& method, const Settings& settings, FileWatch& watch)
        : _scene(method, settings, watch), _watch(watch), _period(1.0 / settings.frameRate) {
        for (const Column& column : kFlightColumns) _sums[column.name] = std::uint64_t{0};
        _scene.load();
        _scene.pause();
    }

    // Loads all that a pose shows, which does not count.
    void load(const flight::CameraPose& pose, double timeout) {
        _scene.resume();
        (void)awaitAll(pose, timeout, false);
        _scene.pause();
    }

    void takeTurn(const flight::CameraPose* begin, const flight::CameraPose* end) {
        const Turn turn(*this);
        for (const flight::CameraPose* pose = begin; pose != end; ++pose) fly(*pose);
    }

    void jumpTo(const flight::CameraPose& pose, double timeout) {
        const Turn turn(*this);
        const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(awaitAll(pose, timeout, true));
        add("complete_ms", static_cast<std::uint64_t>(passed.count()));
    }

    [[nodiscard]] MethodFigures figures() {
        const support::Quantiles times(_times);
        report::Json row{{"frames", _times.size()}};
        _sums["resident_tiles"] = flight::residentTiles(_scene.root());
        _sums[kCullColumn] = sumOf(_times);
        _sums["cull_median_ms"] = times.at(50, 100);
        _sums["cull_99th_ms"] = times.at(99, 100);
        row.update(_sums);
        return {_scene.method().name, {row}};
    }

private:
    // While a method has its turn its pager runs, and what is read counts.
    class Turn {
    public:
        explicit Turn(Flight& flight)
            : _flight(flight), _files(flight._watch.nodeFiles()), _bytes(flight._watch.nodeBytes()) {
            flight._scene.resume();
        }
        ~Turn() {
            _flight._scene.pause();
            _flight.add("files_requested", _flight._watch.nodeFiles() - _files);
            _flight.add("bytes", _flight._watch.nodeBytes() - _bytes);
        }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        Flight& _flight;
        const std::uint64_t _files, _bytes;
    };

    // Stands at a pose until nothing is missing. Returns: how long.
    [[nodiscard]] Clock::duration awaitAll(const flight::CameraPose& pose, double timeout, bool counts) {
        const auto begin = Clock::now();
        while (fly(pose, counts))
            if (Clock::now() - begin > std::chrono::duration<double>(timeout)) throw _scene.lateAt(pose);
        return Clock::now() - begin;
    }

    // Returns: whether something was missing.
    bool fly(const flight::CameraPose& pose, bool counts = true) {
        const auto end = Clock::now() + _period;
        const MethodScene::Frame frame = _scene.flyFrame(pose, _period.count());
        if (counts) {
            add("missing_frames", frame.wanted > 0 ? 1U : 0U);
            _times.push_back(frame.cullMs);
            add("drawn_tiles", _scene.census().tiles.size());
        }
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

/// The frames of all flights of one method, each drawn when all that it shows is loaded, so that all methods draw the
/// same scene, and at the frame rate, so that caches have forgotten as much as in a viewer.
class DrawnFlight {
public:
    static constexpr const char* kLeftOut = " is not drawn in flight";
    [[nodiscard]] static bool leavesOut(const CullMethod& method) {
        return method.replaysVerdicts || method.cullsNothing;
    }

    DrawnFlight(const CullMethod& method, const Settings& settings, FileWatch& watch)
        : _scene(method, settings, watch), _period(1.0 / settings.frameRate), _timeout(settings.timeout) {}

    void fly(BenchViewer& viewer, const std::vector<flight::CameraPose>& frames) {
        _scene.load();
        viewer.show(_scene.root(), _scene.camera().getCullingMode());
        viewer.startTimes();
        for (const flight::CameraPose& pose : frames) {
            // later rounds are flown to their end, so that all methods have flown as far
            if (_times.empty()) support::throwIfStopRequested();
            _scene.setPose(pose);
            viewer.setView(_scene.camera());
            const auto next = Clock::now() + _period;
            if (!viewer.drawUntilLoaded(_timeout)) throw _scene.lateAt(pose);
            std::this_thread::sleep_until(next);
            viewer.timeFrame();
        }
        const std::vector<FrameTimes> times = viewer.takeTimes();
        _times.insert(_times.end(), times.begin(), times.end());
        viewer.rest();
        _scene.pause();
    }

    [[nodiscard]] MethodFigures figures() const {
        std::vector<double> cullMs, drawMs, workMs, frameMs;
        for (const FrameTimes& frame : _times) {
            cullMs.push_back(frame.cullMs);
            drawMs.push_back(frame.drawMs);
            workMs.push_back(frame.cullMs + frame.drawMs);
            frameMs.push_back(frame.frameMs);
        }
        const support::Quantiles work(workMs), whole(frameMs);
        const report::Json row{{"frames", _times.size()},
                               {kCullColumn, sumOf(cullMs)},
                               {"draw_ms", sumOf(drawMs)},
                               {"work_1st_ms", work.at(1, 100)},
                               {"work_median_ms", work.at(50, 100)},
                               {"work_99th_ms", work.at(99, 100)},
                               {"frame_ms", sumOf(frameMs)},
                               {"frame_1st_ms", whole.at(1, 100)},
                               {"frame_median_ms", whole.at(50, 100)},
                               {"frame_99th_ms", whole.at(99, 100)}};
        return {_scene.method().name, {row}};
    }

private:
    MethodScene _scene;
    const std::chrono::duration<double> _period;
    const double _timeout;
    std::vector<FrameTimes> _times;
};

template <class AnyFlight>
std::vector<std::unique_ptr<AnyFlight>> flightsOf(const Settings& settings, const std::vector<CullMethod>& methods,
                                                  FileWatch& watch) {
    std::vector<std::unique_ptr<AnyFlight>> flights;
    for (const CullMethod& method : methods) {
        if (AnyFlight::leavesOut(method))
            std::cerr << "osgbinbench: " << method.name << AnyFlight::kLeftOut << std::endl;
        else
            flights.push_back(std::make_unique<AnyFlight>(method, settings, watch));
    }
    return flights;
}

// Methods stop together: each has flown as far as the others.
bool isStopped(std::size_t done) {
    if (done == 0) support::throwIfStopRequested();
    return support::stopRequested;
}

template <class AnyFlight>
Measurement figuresOf(const std::vector<std::unique_ptr<AnyFlight>>& flights) {
    Measurement measured;
    for (const auto& flight : flights) measured.methods.push_back(flight->figures());
    return measured;
}

/// All methods take turns of so many steps of the way, each time starting with another one.
template <class Turn>
Measurement inTurns(const Settings& settings, const std::vector<CullMethod>& methods, FileWatch& watch,
                    std::size_t steps, std::size_t stepsPerTurn, const char* what, const Turn& turn) {
    const auto flights = flightsOf<Flight>(settings, methods, watch);
    support::ProgressLine progress(stderr);
    for (std::size_t begin = 0; begin < steps && !isStopped(begin); begin += stepsPerTurn) {
        progress.show(static_cast<double>(begin) / static_cast<double>(steps),
                      "osgbinbench: " + std::to_string(steps) + what + " with paging live, ");
        for (std::size_t i = 0; i < flights.size(); ++i)
            turn(*flights[(i + begin / stepsPerTurn) % flights.size()], begin);
    }
    return figuresOf(flights);
}

Measurement flyDrawn(const Settings& settings, const std::vector<CullMethod>& methods,
                     const std::vector<flight::CameraPose>& frames, FileWatch& watch) {
    BenchViewer viewer(settings.width, settings.height, settings.threading);
    viewer.sortByState();
    const auto flights = flightsOf<DrawnFlight>(settings, methods, watch);
    for (std::size_t round = 0; round < kRounds && (round == 0 || !support::stopRequested); ++round) {
        std::cerr << "osgbinbench: " << frames.size() << " frames drawn, round " << round + 1 << " of " << kRounds
                  << std::endl;
        for (std::size_t i = 0; i < flights.size(); ++i) flights[(i + round) % flights.size()]->fly(viewer, frames);
    }
    return figuresOf(flights);
}

std::vector<flight::CameraPose> framesOf(const Settings& settings, const std::vector<flight::CameraPose>& path,
                                         FileWatch& watch) {
    if (settings.speed == 0.0) return flight::continuousPath(path, settings.frames);
    const double radius = globeOf(settings, watch).radii().equatorialRadius();
    return flight::flightsAhead(path, std::max(1, settings.frames / static_cast<int>(path.size())),
                                settings.speed / settings.frameRate / radius);
}

}  // namespace

Measurement fly(const Settings& settings, const std::vector<CullMethod>& methods,
                const std::vector<flight::CameraPose>& path, FileWatch& watch) {
    if (settings.jumps)
        return inTurns(settings, methods, watch, path.size(), 1, " jumps",
                       [&](Flight& flight, std::size_t pose) { flight.jumpTo(path[pose], settings.timeout); });
    const std::vector<flight::CameraPose> frames = framesOf(settings, path, watch);
    if (settings.draw) return flyDrawn(settings, methods, frames, watch);
    const std::size_t perTurn = settings.speed > 0.0 ? frames.size() / path.size() : kFramesPerTurn;
    return inTurns(settings, methods, watch, frames.size(), perTurn, " frames", [&](Flight& flight, std::size_t begin) {
        if (settings.speed > 0.0) flight.load(frames[begin], settings.timeout);
        flight.takeTurn(&frames[begin], frames.data() + std::min(begin + perTurn, frames.size()));
    });
}

}  // namespace osgAnalyticBin::bench
