// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Ranks.h"

#include "Failure.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <sched.h>
#include <thread>

#ifdef OSGBINDEM_MPI
#include <mpi.h>
#endif

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

constexpr int kInterrupted = 130;

// Set by launchers that speak to MPI: Open MPI's mpirun; prrte and Slurm's srun --mpi=pmix; srun --mpi=pmi2 and others.
// SLURM_PROCID is no sign: every program of a batch file has it.
constexpr const char* kSizeVariables[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
constexpr const char* kRankVariables[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};

// What MPI says counts more than the environment: launcher and library may not know each other.
std::optional<int> startedRank;

bool isLaunched() {
    return std::any_of(std::begin(kSizeVariables), std::end(kSizeVariables),
                       [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

bool Ranks::isStartedByMpi() {
    return isLaunched();
}

bool Ranks::isSpeaker() {
    if (startedRank) return *startedRank == 0;
    for (const char* name : kRankVariables) {
        if (const char* value = std::getenv(name)) return std::atoi(value) == 0;
    }
    return true;
}

void Ranks::leaveAfterSignal() {
    std::_Exit(kInterrupted);
}

void waitABit() {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
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

#ifdef OSGBINDEM_MPI

Ranks::Ranks() {
    if (!isLaunched()) return;
    int level = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS || level < MPI_THREAD_FUNNELED) {
        throw Failure("MPI does not start as threads need it; run osgbindem without mpirun");
    }
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &_rank);
    MPI_Comm_size(MPI_COMM_WORLD, &_count);
    startedRank = _rank;
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_size(here, &_countHere);
    MPI_Comm_free(&here);
}

Ranks::~Ranks() {
    int isInitialised = 0;
    MPI_Initialized(&isInitialised);
    if (isInitialised == 0) return;
    while (failureElsewhere()) {
    }
    MPI_Finalize();
}

void Ranks::sendFailure(const std::string& text) const {
    constexpr std::size_t kMost = 1000;  // short messages never wait for who receives them
    const int size = static_cast<int>(std::min(text.size(), kMost));
    for (int rank = 0; rank < _count; ++rank) {
        if (rank != _rank) MPI_Send(text.data(), size, MPI_CHAR, rank, 0, MPI_COMM_WORLD);
    }
}

std::optional<std::string> Ranks::failureElsewhere() const {
    if (_count == 1) return std::nullopt;
    int isThere = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &isThere, &status) != MPI_SUCCESS || isThere == 0) {
        return std::nullopt;
    }
    int size = 0;
    MPI_Get_count(&status, MPI_CHAR, &size);
    std::string text(static_cast<std::size_t>(size), '\0');
    MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return text;
}

bool Ranks::meet(bool hasFailed, const std::function<void()>& glance) const {
    constexpr std::chrono::seconds kPatience{60};
    if (_count == 1) return hasFailed;
    const int mine = hasFailed ? 1 : 0;
    int any = 0;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallreduce(&mine, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
    const auto begin = std::chrono::steady_clock::now();
    for (int isThere = 0; MPI_Test(&request, &isThere, MPI_STATUS_IGNORE) == MPI_SUCCESS && isThere == 0; waitABit()) {
        if (hasFailed && std::chrono::steady_clock::now() - begin > kPatience) MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
        if (glance) glance();
    }
    return any != 0;
}

#else

Ranks::Ranks() {
    if (isLaunched() && std::getenv(kSizeVariables[0]) != nullptr && std::atoi(std::getenv(kSizeVariables[0])) > 1) {
        throw Failure("this osgbindem was built without MPI; run it without mpirun, or build it where MPI is found");
    }
}

Ranks::~Ranks() = default;

void Ranks::sendFailure(const std::string&) const {}

std::optional<std::string> Ranks::failureElsewhere() const {
    return std::nullopt;
}

bool Ranks::meet(bool hasFailed, const std::function<void()>&) const {
    return hasFailed;
}

#endif

}  // namespace osgbindem
