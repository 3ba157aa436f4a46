// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace osgbindem {

class RankLink;

/// The programs that mpirun has started together; a single one without mpirun. Only mpirun's environment makes MPI load
/// and start, which takes a tenth of a second. To be used by the thread that made it.
class Ranks final {
public:
    /// Throws Failure.
    Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    ~Ranks();

    /// Whether mpirun started the program; then what looks like a terminal may be none.
    [[nodiscard]] static bool isStartedByMpi();

    /// Whether this program is the one that speaks to the user: rank 0, as the environment tells before MPI has
    /// started.
    [[nodiscard]] static bool isSpeaker();

    [[nodiscard]] int count() const { return _count; }
    [[nodiscard]] int rank() const { return _rank; }
    [[nodiscard]] bool isFirst() const { return _rank == 0; }
    /// Of those on this machine.
    [[nodiscard]] int countHere() const { return _countHere; }

    /// Tells all others why this one cannot go on: a short text.
    void sendFailure(const std::string& text) const;
    /// Returns at once: what another one said by sendFailure(); nullopt when none has.
    [[nodiscard]] std::optional<std::string> failureElsewhere() const;
    /// Waits until every rank has come to this call, without using the processor; `glance` is called meanwhile. Kills
    /// all when the others of a rank that has failed do not come within a minute. Returns: whether any has failed.
    [[nodiscard]] bool meet(bool hasFailed, const std::function<void()>& glance) const;
    /// Ends the program, MPI's part left out, as mpirun wants it after a signal.
    [[noreturn]] static void leaveAfterSignal();

private:
    std::unique_ptr<RankLink> _link;  // null: without mpirun
    int _rank = 0;
    int _count = 1;
    int _countHere = 1;
};

/// Between two glances at what others say.
void waitABit();

/// Threads for each program, so that those on one machine keep its processors busy.
[[nodiscard]] int threadsPerRank(const Ranks& ranks);

}  // namespace osgbindem
