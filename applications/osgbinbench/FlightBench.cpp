// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightBench.h"

#include "MethodViewer.h"

#include <iostream>

namespace osgAnalyticBin::bench {

namespace {

constexpr double kMillisecondsPerSecond = 1000.0;
constexpr const char* kCullTime = "Cull traversal time taken";

// The time of the frame before the last one drawn is known under every threading model.
double cullMsOf(MethodViewer& viewer, unsigned int frameNumber) {
    double seconds = 0.0;
    viewer.camera().getStats()->getAttribute(frameNumber, kCullTime, seconds);
    return seconds * kMillisecondsPerSecond;
}

FlightFigures flyOnce(const CullMethod& method, const Settings& settings, FileWatch& watch,
                      const std::vector<flight::CameraPose>& frames) {
    MethodViewer viewer(method, settings, watch);
    viewer.load();
    const std::uint64_t files = watch.reads->nodeFiles();
    const std::uint64_t bytes = watch.reads->nodeBytes();
    FlightFigures figures;
    figures.method = method.name;
    for (const flight::CameraPose& frame : frames) {
        viewer.drawFrame(frame);
        const unsigned int number = viewer.frameStamp().getFrameNumber();
        if (figures.frames++ > 0) figures.cullMs += cullMsOf(viewer, number - 1);
    }
    viewer.rest();
    figures.cullMs += cullMsOf(viewer, viewer.frameStamp().getFrameNumber());
    figures.filesRequested = watch.reads->nodeFiles() - files;
    figures.bytes = watch.reads->nodeBytes() - bytes;
    return figures;
}

}  // namespace

std::vector<FlightFigures> flyContinuously(const Settings& settings, const std::vector<CullMethod>& methods,
                                           const std::vector<flight::CameraPose>& frames) {
    FileWatch watch;
    std::vector<FlightFigures> figures;
    for (const CullMethod& method : methods) {
        std::cerr << "osgbinbench: " << frames.size() << " frames, method " << method.name << std::endl;
        figures.push_back(flyOnce(method, settings, watch, frames));
    }
    return figures;
}

}  // namespace osgAnalyticBin::bench
