// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightBench.h"

#include "MethodScene.h"

#include <chrono>
#include <iostream>
#include <thread>

namespace osgAnalyticBin::bench {

namespace {

FlightFigures flyOnce(const CullMethod& method, const Settings& settings, FileWatch& watch, BenchViewer& viewer,
                      const std::vector<flight::CameraPose>& frames) {
    MethodScene scene(method, settings, watch, viewer);
    scene.load();
    const std::uint64_t files = watch.reads->nodeFiles();
    const std::uint64_t bytes = watch.reads->nodeBytes();
    FlightFigures figures;
    figures.method = method.name;
    const auto period = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(1.0 / settings.frameRate));
    auto next = std::chrono::steady_clock::now();
    for (const flight::CameraPose& frame : frames) {
        std::this_thread::sleep_until(next);
        next = std::chrono::steady_clock::now() + period;
        scene.drawFrame(frame);
        // The time of the frame before this one is known under every threading model.
        const unsigned int number = viewer.frameStamp().getFrameNumber();
        if (figures.frames++ > 0) figures.cullMs += viewer.cullMs(number - 1);
    }
    viewer.rest();
    figures.cullMs += viewer.cullMs(viewer.frameStamp().getFrameNumber());
    figures.filesRequested = watch.reads->nodeFiles() - files;
    figures.bytes = watch.reads->nodeBytes() - bytes;
    return figures;
}

}  // namespace

std::vector<FlightFigures> flyContinuously(const Settings& settings, const std::vector<CullMethod>& methods,
                                           const std::vector<flight::CameraPose>& frames) {
    FileWatch watch;
    BenchViewer viewer(settings.width, settings.height, settings.threading);
    std::vector<FlightFigures> figures;
    for (const CullMethod& method : methods) {
        std::cerr << "osgbinbench: " << frames.size() << " frames, method " << method.name << std::endl;
        figures.push_back(flyOnce(method, settings, watch, viewer, frames));
    }
    return figures;
}

}  // namespace osgAnalyticBin::bench
