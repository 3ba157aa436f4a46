// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdlib>
#include <functional>

namespace osgbindem {

/// The programs that mpirun has started together; a single one without mpirun. To be used by the thread that made it.
class Ranks {
public:
    Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    /// Waits until all others have come here, and ends MPI.
    virtual ~Ranks() = default;

    [[nodiscard]] virtual int count() const { return 1; }
    [[nodiscard]] virtual int rank() const { return 0; }
    [[nodiscard]] bool isFirst() const { return rank() == 0; }
    /// Of those on this machine.
    [[nodiscard]] virtual int countHere() const { return 1; }

    /// Waits until every rank has come to this call, without using the processor; `glance` is called meanwhile.
    /// Returns: whether all go on.
    virtual bool meet(bool goesOn, const std::function<void()>& /*glance*/) const { return goesOn; }
    /// Ends all ranks at once: this one has failed.
    virtual void abort(int /*code*/) const {}
};

/// The function of the module osgbindem_mpi, and its name. The program starts where MPI is not installed. Returns: null
/// where MPI does not start as threads need it.
using JoinRanks = Ranks* (*)();
constexpr const char* kJoinRanks = "osgbindemJoinRanks";

/// The rank that a launcher which speaks to MPI has given the program, as text; null without one: Open MPI's mpirun;
/// prrte and Slurm's srun --mpi=pmix; srun --mpi=pmi2 and others. SLURM_PROCID is no sign: every program of a batch
/// file has it.
[[nodiscard]] inline const char* launchedRank() {
    const char* rank = nullptr;
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
        if (!rank) rank = std::getenv(name);
    return rank;
}

}  // namespace osgbindem
