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

void Ranks::sendToOthers(Word word) const {
    for (int rank = 1; rank < _count; ++rank) send(rank, word);
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
    if (isInitialised != 0) MPI_Finalize();
}

void Ranks::send(int rank, Word word, const std::string& text) const {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, static_cast<int>(word), MPI_COMM_WORLD);
}

std::optional<Message> Ranks::receive() const {
    if (_count == 1) return std::nullopt;
    int isThere = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &isThere, &status) != MPI_SUCCESS || isThere == 0) {
        return std::nullopt;
    }
    int size = 0;
    MPI_Get_count(&status, MPI_CHAR, &size);
    Message message{status.MPI_SOURCE, static_cast<Word>(status.MPI_TAG),
                    std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Recv(message.text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
}

void Ranks::endOthers(int done) const {
    constexpr std::chrono::seconds kPatience{60};
    if (done < _count - 1) sendToOthers(Word::Stop);
    const auto begin = std::chrono::steady_clock::now();
    while (done < _count - 1) {
        if (std::chrono::steady_clock::now() - begin > kPatience) MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
        const auto message = receive();
        if (!message) waitABit();
        if (message && message->word == Word::Done) ++done;
    }
    sendToOthers(Word::End);
}

#else

Ranks::Ranks() {
    if (isLaunched() && std::getenv(kSizeVariables[0]) != nullptr && std::atoi(std::getenv(kSizeVariables[0])) > 1) {
        throw Failure("this osgbindem was built without MPI; run it without mpirun, or build it where MPI is found");
    }
}

Ranks::~Ranks() = default;

void Ranks::send(int, Word, const std::string&) const {}

std::optional<Message> Ranks::receive() const {
    return std::nullopt;
}

void Ranks::endOthers(int) const {}

#endif

}  // namespace osgbindem
