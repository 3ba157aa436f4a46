// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "Commands.h"
#include "Failure.h"
#include "ModuleFolder.h"

#include <osg/Notify>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <pthread.h>
#include <string>
#include <thread>

namespace {

using namespace osgAnalyticBin::support;

using osgbinconv::DatabaseFiles;

constexpr const char* kDescription =
    "Computes the bins of all tiles of a paged globe or map, made by any program.\n"
    "Altitudes are metres above the ellipsoid, or map units; skirts are included.";

constexpr const char* kExamples =
    "Examples:\n"
    "  osgbinconv --index earth.ive             writes earth.ive.bins beside the database, which stays as it is\n"
    "  osgbinconv --print earth.ive.bins        prints what is in an index\n"
    "  osgbinconv --check earth.ive             compares earth.ive.bins with its database\n"
    "An interrupted index is kept in earth.ive.bins.part; the same command resumes it.\n"
    "Exit codes: 0 done, 1 an error or an index that does not fit, 2 a wrong command line, 130 interrupted.";

/// The command line as it was typed.
struct Arguments {
    bool isIndex = false;
    bool isPrint = false;
    bool isCheck = false;
    bool keepsRecords = false;
    std::string file;
    osgbinconv::WalkOptions walk;
};

void declare(CLI::App& app, Arguments& arguments) {
    auto* index = app.add_flag("--index", arguments.isIndex, "write DATABASE.bins, the bins of all tiles");
    app.add_flag("--print", arguments.isPrint, "print what is in DATABASE.bins");
    app.add_flag("--check", arguments.isCheck, "compare DATABASE.bins with the database");
    app.add_flag(
           "--keep-records", arguments.keepsRecords,
           "with --index: keep DATABASE.bins.part, so that the next --index reads\nonly the files that have changed "
           "since")
        ->needs(index);
    app.add_option("FILE", arguments.file, "the root file of a database; with --print also an index")->required();
    app.add_option("--threads", arguments.walk.threads, "number of threads (default: one per core)")
        ->check(CLI::Range(1, 256));
    app.add_flag("--quiet", arguments.walk.isQuiet, "show no progress");
}

void prepareProcess() {
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::ALWAYS);
    osgAnalyticBin::support::stopOnSignals();
    osgAnalyticBin::addModuleFolder();
    osgAnalyticBin::indexing::loadSerializers();
    osgAnalyticBin::indexing::checkAllReads();
}

ExitCode run(int argc, char** argv) {
    Arguments arguments;
    arguments.walk.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 256U));
    CLI::App app{kDescription, "osgbinconv"};
    app.footer(kExamples);
    declare(app, arguments);
    if (!osgAnalyticBin::support::parseCommandLine(app, argc, argv)) return kSucceeded;
    if (arguments.isIndex + arguments.isPrint + arguments.isCheck != 1)
        throw UsageError("what to do with \"" + arguments.file + "\"? Give one of --index, --print and --check");
    prepareProcess();
    const std::string& file = arguments.file;
    if (arguments.isPrint) {
        osgbinconv::printIndex(file);
        return kSucceeded;
    }
    const DatabaseFiles files(file);
    if (arguments.isIndex) osgbinconv::writeIndex(files, arguments.walk, arguments.keepsRecords);
    if (arguments.isCheck) osgbinconv::checkIndex(files, arguments.walk);
    return kSucceeded;
}

/// Says what to do after what every program reports.
ExitCode runWithAdvice(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Interrupted&) {
        throw Interrupted("interrupted; run the same command again: an index goes on where it ended");
    }
}

// OSG reads, walks and deletes scenes recursively: files that are nested thousands deep need more stack than threads
// have by default. What is not used takes no memory.
void enlargeStacks() {
#if defined(__GLIBC__)
    constexpr std::size_t kStackBytes = std::size_t{256} << 20;
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) return;
    if (pthread_attr_setstacksize(&attributes, kStackBytes) == 0) (void)pthread_setattr_default_np(&attributes);
    (void)pthread_attr_destroy(&attributes);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    enlargeStacks();
    ExitCode code = kSucceeded;
    std::thread([&] {
        code = osgAnalyticBin::support::runProgram("osgbinconv", [&] { return runWithAdvice(argc, argv); });
    }).join();
    return code;
}
