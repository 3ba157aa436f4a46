// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullRun.h"
#include "Failure.h"
#include "ProgramRun.h"

#include <osgAnalyticBin/Version.h>

#include <CLI/CLI.hpp>
#include <osgDB/WriteFile>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace {

using osgAnalyticBin::support::ExitCode;
using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::kSucceeded;

using namespace osgAnalyticBin::assembly;

struct Arguments {
    std::size_t parts = 10000;
    std::size_t cameras = 200;
    std::uint32_t seed = 1;
    std::string output;
};

void declare(CLI::App& app, Arguments& arguments) {
    app.add_option("--parts", arguments.parts, "Parts to build, at least (default: 10000)")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--cameras", arguments.cameras, "Random cameras to cull from (default: 200)")
        ->check(CLI::Range(1, 100000));
    app.add_option("--seed", arguments.seed, "Seed of the plant and of the cameras (default: 1)");
    app.add_option("--output", arguments.output, "Write the plant to this file, for example assembly.osgb");
    app.footer(
        "Per camera: visible = parts with a sample in the frustum; kept = parts that the cull traversal entered;\n"
        "drawn = parts whose geometry also passed OSG's own box test; false = parts in view that were not drawn;\n"
        "ms = one cull traversal. Sizes are metres. Use bins behind spheres, as in the last line of the table: the "
        "same\n"
        "parts are kept as by bins alone, in less time.\n"
        "Exit code: 0; 1 when a part in view was culled, when bins do not keep fewer parts than spheres, or when the\n"
        "file cannot be written; 2 when the command line is wrong.\n\n"
        "Example:\n"
        "  osgbinassembly --parts 20000 --cameras 100 --output assembly.osgb");
}

std::size_t countVisible(const Visibility& visible) {
    std::size_t count = 0;
    for (const std::vector<bool>& view : visible) {
        count += static_cast<std::size_t>(std::count(view.begin(), view.end(), true));
    }
    return count;
}

void printRow(const char* name, const CullFigures& figures, std::size_t visible, std::size_t cameras) {
    const auto mean = [&](std::size_t total) { return static_cast<double>(total) / static_cast<double>(cameras); };
    const double above = 100.0 * (static_cast<double>(figures.kept) / static_cast<double>(visible) - 1.0);
    std::printf("%-18s %10.1f %9.1f%% %10.1f %8zu %8.3f\n", name, mean(figures.kept), above, mean(figures.drawn),
                figures.falselyCulled, figures.milliseconds);
}

void compare(const Assembly& assembly, const Arguments& arguments) {
    const std::vector<Camera> cameras = randomCameras(arguments.cameras, assembly.halfExtent, arguments.seed + 1);
    const Visibility visible = visibleParts(assembly, cameras);
    const std::size_t seen = std::max<std::size_t>(countVisible(visible), 1);
    const CullFigures spheres = cullAssembly(assembly, cameras, visible, Culling::Spheres);
    const CullFigures bins = cullAssembly(assembly, cameras, visible, Culling::Bins);
    const CullFigures both = cullAssembly(assembly, cameras, visible, Culling::SpheresThenBins);

    std::printf("%zu parts, %zu cameras; visible %.1f a camera\n", assembly.parts.size(), cameras.size(),
                static_cast<double>(seen) / static_cast<double>(cameras.size()));
    std::printf("%-18s %10s %10s %10s %8s %8s\n", "method", "kept", "above", "drawn", "false", "ms");
    printRow("spheres", spheres, seen, cameras.size());
    printRow("bins", bins, seen, cameras.size());
    printRow("spheres, then bins", both, seen, cameras.size());

    if (bins.falselyCulled + both.falselyCulled > 0) throw Failure("a part in view was culled");
    if (bins.kept >= spheres.kept || both.kept >= spheres.kept) throw Failure("bins keep no fewer parts than spheres");
}

ExitCode run(int argc, char** argv) {
    CLI::App app{"Builds a plant of pipes and curved panels and culls it with spheres and with bins.",
                 "osgbinassembly"};
    app.set_version_flag("--version", std::string("osgbinassembly (osgAnalyticBin) ") + osgAnalyticBin::version());
    Arguments arguments;
    declare(app, arguments);
    if (!osgAnalyticBin::support::parseCommandLine(app, argc, argv)) return kSucceeded;
    const Assembly assembly = buildAssembly(arguments.parts, arguments.seed);
    if (!arguments.output.empty() && !osgDB::writeNodeFile(*assembly.scene, arguments.output))
        throw Failure("cannot write " + arguments.output + "; choose another folder");
    compare(assembly, arguments);
    return kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    return osgAnalyticBin::support::runProgram("osgbinassembly", [&] { return run(argc, argv); });
}
