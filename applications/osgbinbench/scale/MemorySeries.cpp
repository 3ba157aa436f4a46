// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "Series.h"

#include <iostream>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace osgAnalyticBin::scale {

namespace {

double allocatedBytes() {
#if defined(__GLIBC__)
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
#else
    throw support::Failure("--memory-tiles: memory can be measured with glibc alone");
#endif
}

flight::CameraPose farAway() {
    return {"far", {0.0, 0.0, 1e8}, {0.0, 0.0, 0.0}, 1.0, 1.0, 1e9};
}

MemoryRow memoryOf(const std::string& name, const ScaleMethod& method, const Settings& settings, bool storesBins) {
    std::cerr << "osgbinbench scale: memory, " << name << std::endl;
    globe::GlobeOptions options;
    options.bins = storesBins;
    ScaleScene scene(method, options);
    scene.settle(farAway());
    // What is loaded once, and the start tiles, do not count.
    const std::size_t before = scene.pagedLods();
    const double bytes = allocatedBytes();
    const Stopwatch watch;
    scene.fill(before + static_cast<std::size_t>(settings.memoryTiles));
    const double us = 1000.0 * watch.ms();
    const auto tiles = static_cast<double>(scene.pagedLods() - before);
    return {name, scene.pagedLods() - before, (allocatedBytes() - bytes) / tiles, us / tiles};
}

}  // namespace

std::vector<MemoryRow> measureMemory(const Settings& settings) {
    const ScaleMethod sphere = scaleMethodFromName("sphere");
    std::vector<MemoryRow> rows{memoryOf("no bins", sphere, settings, false),
                                memoryOf("stored bins", sphere, settings, true)};
    for (const ScaleMethod& method : settings.methods)
        if (method.name != sphere.name && !method.replaysVerdicts)
            rows.push_back(memoryOf(method.name, method, settings, true));
    return rows;
}

}  // namespace osgAnalyticBin::scale
