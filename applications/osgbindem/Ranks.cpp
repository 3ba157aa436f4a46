// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Ranks.h"

#include "Failure.h"
#include "ModuleFolder.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <iterator>
#include <sched.h>
#include <thread>

namespace osgbindem {

using osgAnalyticBin::moduleFolder;
using osgAnalyticBin::support::Failure;

namespace {

// Set by launchers that speak to MPI: Open MPI's mpirun; prrte and Slurm's srun --mpi=pmix; srun --mpi=pmi2 and others.
// SLURM_PROCID is no sign: every program of a batch file has it.
constexpr const char* kSizeVariables[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
constexpr const char* kRankVariables[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};

// What MPI says counts more than the environment: launcher and library may not know each other.
std::optional<int> startedRank;

}  // namespace

bool isStartedByMpi() {
    return std::any_of(std::begin(kSizeVariables), std::end(kSizeVariables),
                       [](const char* name) { return std::getenv(name) != nullptr; });
}

bool isSpeaker() {
    if (startedRank) return *startedRank == 0;
    for (const char* name : kRankVariables) {
        if (const char* value = std::getenv(name)) return std::atoi(value) == 0;
    }
    return true;
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
        const char* size = std::getenv(kSizeVariables[0]);
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
