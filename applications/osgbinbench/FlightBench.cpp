// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightBench.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

namespace osgAnalyticBin::bench {

namespace {

constexpr std::size_t kFramesPerTurn = 50;

class Flight {
public:
    Flight(const CullMethod& method, const Settings& settings, FileWatch& watch)
        : _scene(method, settings, watch), _watch(watch), _period(1.0 / settings.frameRate) {
        _figures.method = method.name;
        _scene.load();
        _scene.pause();
    }

    void takeTurn(const flight::CameraPose* begin, const flight::CameraPose* end) {
        const std::uint64_t files = _watch.reads->nodeFiles();
        const std::uint64_t bytes = _watch.reads->nodeBytes();
        _scene.resume();
        for (const flight::CameraPose* pose = begin; pose != end; ++pose) fly(*pose);
        _scene.pause();
        _figures.filesRequested += _watch.reads->nodeFiles() - files;
        _figures.bytes += _watch.reads->nodeBytes() - bytes;
    }

    [[nodiscard]] FlightFigures figures() {
        std::sort(_times.begin(), _times.end());
        const auto percentile = [&](std::size_t part) { return _times[(_times.size() - 1) * part / 100]; };
        if (!_times.empty()) {
            _figures.cullMedianMs = percentile(50);
            _figures.cull99thMs = percentile(99);
        }
        _figures.residentTiles = residentTiles(_scene.root());
        return _figures;
    }

private:
    void fly(const flight::CameraPose& pose) {
        const auto end = std::chrono::steady_clock::now() + _period;
        const PagedScene::Frame frame = _scene.flyFrame(pose, _period.count());
        ++_figures.frames;
        _figures.missingFrames += frame.wanted > 0 ? 1U : 0U;
        _figures.cullMs += frame.cullMs;
        _times.push_back(frame.cullMs);
        _figures.drawnTiles += _scene.census().tiles.size();
        std::this_thread::sleep_until(end);
    }

    MethodScene _scene;
    FileWatch& _watch;
    std::chrono::duration<double> _period;
    FlightFigures _figures;
    std::vector<double> _times;
};

}  // namespace

std::vector<FlightFigures> flyContinuously(const Settings& settings, const std::vector<CullMethod>& methods,
                                           const std::vector<flight::CameraPose>& frames, FileWatch& watch) {
    std::cerr << "osgbinbench: " << frames.size() << " frames with paging live" << std::endl;
    std::vector<std::unique_ptr<Flight>> flights;
    for (const CullMethod& method : methods) {
        if (method.replaysVerdicts)
            std::cerr << "osgbinbench: " << method.name << " does not fly: its verdicts hold for one pose" << std::endl;
        else
            flights.push_back(std::make_unique<Flight>(method, settings, watch));
    }
    for (std::size_t begin = 0; begin < frames.size(); begin += kFramesPerTurn) {
        const std::size_t end = std::min(begin + kFramesPerTurn, frames.size());
        for (std::size_t i = 0; i < flights.size(); ++i)
            flights[(i + begin / kFramesPerTurn) % flights.size()]->takeTurn(&frames[begin], frames.data() + end);
    }
    std::vector<FlightFigures> figures;
    for (const auto& flight : flights) figures.push_back(flight->figures());
    return figures;
}

}  // namespace osgAnalyticBin::bench
