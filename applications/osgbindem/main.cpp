// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"
#include "Failure.h"
#include "ModuleFolder.h"

#include <cpl_conv.h>
#include <gdal.h>
#include <osg/Notify>

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>
#include <unistd.h>
#include <utility>

namespace {

using osgAnalyticBin::support::ExitCode;
using osgAnalyticBin::support::kSucceeded;

using osgbindem::Failure;
using osgbindem::Ranks;
using osgbindem::Settings;

/// Threads for each program, so that those on one machine keep its processors busy.
int threadsPerRank(const Ranks& ranks) {
    // mpirun may bind each program to a part of the machine
    const int mine = static_cast<int>(std::thread::hardware_concurrency());
    const int machine = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
    return std::max(1, std::min(mine, machine / ranks.countHere()));
}

/// Only mpirun's environment makes MPI load and start, which takes a tenth of a second. Throws Failure.
std::unique_ptr<Ranks> joinRanks() {
    if (!osgbindem::launchedRank()) return std::make_unique<Ranks>();
    const std::string module = osgAnalyticBin::moduleFolder() + "osganalyticbin/osgbindem_mpi.so";
    // MPI's own modules look for its functions among those of the program.
    void* const library = dlopen(module.c_str(), RTLD_NOW | RTLD_GLOBAL);
    const auto join = library ? reinterpret_cast<osgbindem::JoinRanks>(dlsym(library, osgbindem::kJoinRanks)) : nullptr;
    if (!join) {
        const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
        if (size && std::atoi(size) == 1) return std::make_unique<Ranks>();  // launched alone
        throw Failure(
            "without its module for MPI osgbindem runs alone: run it without mpirun, or install the module "
            "(on Debian: osganalyticbin-mpi); " +
            std::string(dlerror()));
    }
    std::unique_ptr<Ranks> ranks(join());
    if (!ranks) throw Failure("MPI does not start as threads need it; run osgbindem without mpirun");
    return ranks;
}

// Whether this program is the one that speaks to the user.
bool isSpeaker = true;

void setSpeaker(bool is) {
    isSpeaker = is;
    for (std::ostream* stream : {&std::cout, &std::cerr}) stream->clear(is ? std::ios::goodbit : std::ios::failbit);
}

void prepareProcess(const Settings& settings) {
    GDALAllRegister();
    GDALSetCacheMax64((GIntBig{settings.memoryMib} << 20) / 2);
    // The user's environment may have them otherwise.
    for (const auto& [name, value] : {std::pair("GDAL_HTTP_MAX_RETRY", "5"), {"GDAL_HTTP_RETRY_DELAY", "1"}})
        if (CPLGetConfigOption(name, nullptr) == nullptr) CPLSetConfigOption(name, value);
    CPLSetErrorHandler(CPLQuietErrorHandler);
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::ALWAYS);
    if (settings.quiet) std::cout.setstate(std::ios::failbit);
    osgAnalyticBin::support::stopOnSignals();
}

/// `ranks`: gets those that mpirun has started.
ExitCode run(int argc, char** argv, std::unique_ptr<Ranks>& ranks) {
    std::optional<Settings> settings = osgbindem::settingsFrom(argc, argv);
    if (!settings) return kSucceeded;
    ranks = joinRanks();
    setSpeaker(ranks->isFirst());  // launcher and library may not know each other
    if (!settings->threads) settings->threads = threadsPerRank(*ranks);
    prepareProcess(*settings);
    try {
        osgbindem::buildDatabase(*settings, *ranks);
    } catch (const osgAnalyticBin::support::Interrupted&) {
        throw;
    } catch (...) {
        setSpeaker(true);  // nobody else knows
        throw;
    }
    return kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    // Until MPI has started, the environment tells which one is the first.
    const char* rank = osgbindem::launchedRank();
    setSpeaker(rank == nullptr || std::atoi(rank) == 0);
    std::unique_ptr<Ranks> ranks;
    const ExitCode code = osgAnalyticBin::support::runProgram("osgbindem", [&] { return run(argc, argv, ranks); });
    // What is finished is on the disk, whenever the others end.
    if (code != kSucceeded && ranks) ranks->abort(code);
    // Every rank finds the same faults in the command line, and the first one tells. The others end in peace: mpirun
    // would end the first before it has spoken.
    return isSpeaker ? code : kSucceeded;
}
