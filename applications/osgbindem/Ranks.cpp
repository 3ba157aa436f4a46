// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Ranks.h"

#include "Failure.h"
#include "ModuleFolder.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <sched.h>
#include <thread>

namespace osgbindem {

using osgAnalyticBin::moduleFolder;
using osgAnalyticBin::support::Failure;

namespace {

/// Set by launchers that speak to MPI: Open MPI's mpirun; prrte and Slurm's srun --mpi=pmix; srun --mpi=pmi2 and
/// others. SLURM_PROCID is no sign: every program of a batch file has it.
const char* launchedRank() {
    const char* rank = nullptr;
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
        if (!rank) rank = std::getenv(name);
    return rank;
}

// What MPI says counts more than the environment: launcher and library may not know each other.
std::optional<int> startedRank;

}  // namespace

bool isStartedByMpi() {
    return launchedRank() != nullptr;
}

bool isSpeaker() {
    if (startedRank) return *startedRank == 0;
    return !isStartedByMpi() || std::atoi(launchedRank()) == 0;
}

int threadsPerRank(const Ranks& ranks) {
    const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    if (ranks.count() == 1) return machine;
    // mpirun binds each program to a part of the machine
    cpu_set_t mine;
    CPU_ZERO(&mine);
    const int bound = sched_getaffinity(0, sizeof mine, &mine) == 0 ? CPU_COUNT(&mine) : machine;
    return std::max(1, std::min(bound, machine / ranks.countHere()));
}

std::unique_ptr<Ranks> joinRanks() {
    if (!isStartedByMpi()) return std::make_unique<Ranks>();
    const std::string module = moduleFolder() + "osganalyticbin/osgbindem_mpi.so";
    // MPI's own modules look for its functions among those of the program.
    void* const library = dlopen(module.c_str(), RTLD_NOW | RTLD_GLOBAL);
    const auto join = library ? reinterpret_cast<JoinRanks>(dlsym(library, kJoinRanks)) : nullptr;
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
    startedRank = ranks->rank();
    return ranks;
}

}  // namespace osgbindem
