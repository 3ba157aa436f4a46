// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BenchViewer.h"
#include "FlightBench.h"
#include "Interruption.h"
#include "Quantiles.h"

#include <iostream>
#include <memory>
#include <numeric>

namespace osgAnalyticBin::bench {

namespace {

constexpr int kRounds = 3;

/// The frames of all flights of one method.
class DrawnFlight {
public:
    DrawnFlight(const CullMethod& method, const Settings& settings, FileWatch& watch)
        : _scene(method, settings, watch) {}

    void fly(BenchViewer& viewer, const std::vector<flight::CameraPose>& frames) {
        _scene.load();
        viewer.show(_scene.root(), _scene.camera().getCullingMode());
        viewer.startTimes();
        for (const flight::CameraPose& pose : frames) {
            // later rounds are flown to their end, so that all methods have flown as far
            if (_times.empty()) support::throwIfStopRequested();
            _scene.setPose(pose);
            viewer.setView(_scene.camera());
            viewer.timeFrame();
        }
        const std::vector<FrameTimes> times = viewer.takeTimes();
        _times.insert(_times.end(), times.begin(), times.end());
        viewer.rest();
        _scene.pause();
    }

    [[nodiscard]] FlightFigures figures() const {
        std::vector<double> cullMs, drawMs, workMs, frameMs;
        for (const FrameTimes& frame : _times) {
            cullMs.push_back(frame.cullMs);
            drawMs.push_back(frame.drawMs);
            workMs.push_back(frame.cullMs + frame.drawMs);
            frameMs.push_back(frame.frameMs);
        }
        const auto sum = [](const std::vector<double>& times) {
            return std::accumulate(times.begin(), times.end(), 0.0);
        };
        const support::Quantiles work(workMs), whole(frameMs);
        return {_scene.method().name,
                {{"frames", _times.size()},
                 {kCullColumn, sum(cullMs)},
                 {"draw_ms", sum(drawMs)},
                 {"work_1st_ms", work.at(1, 100)},
                 {"work_median_ms", work.at(50, 100)},
                 {"work_99th_ms", work.at(99, 100)},
                 {"frame_ms", sum(frameMs)},
                 {"frame_1st_ms", whole.at(1, 100)},
                 {"frame_median_ms", whole.at(50, 100)},
                 {"frame_99th_ms", whole.at(99, 100)}}};
    }

private:
    MethodScene _scene;
    std::vector<FrameTimes> _times;
};

std::vector<std::unique_ptr<DrawnFlight>> flightsThatDraw(const Settings& settings,
                                                          const std::vector<CullMethod>& methods, FileWatch& watch) {
    std::vector<std::unique_ptr<DrawnFlight>> flights;
    for (const CullMethod& method : methods) {
        if (method.replaysVerdicts || method.cullsNothing)
            std::cerr << "osgbinbench: " << method.name << " is not drawn in flight" << std::endl;
        else
            flights.push_back(std::make_unique<DrawnFlight>(method, settings, watch));
    }
    return flights;
}

}  // namespace

std::vector<FlightFigures> flyDrawn(const Settings& settings, const std::vector<CullMethod>& methods,
                                    const std::vector<flight::CameraPose>& frames, FileWatch& watch) {
    BenchViewer viewer(settings.width, settings.height, settings.threading);
    viewer.sortByState();
    const auto flights = flightsThatDraw(settings, methods, watch);
    for (std::size_t round = 0; round < kRounds && (round == 0 || !support::stopRequested); ++round) {
        std::cerr << "osgbinbench: " << frames.size() << " frames drawn with paging live, round " << round + 1 << " of "
                  << kRounds << std::endl;
        for (std::size_t i = 0; i < flights.size(); ++i) flights[(i + round) % flights.size()]->fly(viewer, frames);
    }
    std::vector<FlightFigures> figures;
    for (const auto& flight : flights) figures.push_back(flight->figures());
    return figures;
}

}  // namespace osgAnalyticBin::bench
