// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

namespace osgbindem {

/// What programs under mpirun say to each other.
enum class Word : int {
    // to rank 0
    Want,      ///< a thread has nothing to do
    Finished,  ///< text: the task
    Failed,    ///< text: the error
    Done,      ///< nothing more will be written
    // from rank 0
    Do,      ///< text: the task
    NoMore,  ///< no task is left
    Stop,    ///< another one has failed
    End,     ///< the program may end
};

struct Message {
    int rank = 0;
    Word word = Word::End;
    std::string text;
};

/// The programs that mpirun has started together; a single one without mpirun, or in a build without MPI. Only mpirun's
/// environment makes MPI start, which takes a tenth of a second. To be used by the thread that made it.
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

    [[nodiscard]] int rank() const { return _rank; }
    [[nodiscard]] int count() const { return _count; }
    [[nodiscard]] bool isFirst() const { return _rank == 0; }
    /// Of those on this machine.
    [[nodiscard]] int countHere() const { return _countHere; }

    /// Short texts only.
    void send(int rank, Word word, const std::string& text = {}) const;
    void sendToOthers(Word word) const;
    /// Returns at once: nullopt when nobody has said anything.
    [[nodiscard]] std::optional<Message> receive() const;

    /// Rank 0, before it ends: lets the others end, those first that have not said so already by Done, of which
    /// `done` came in. Kills them when they do not answer.
    void endOthers(int done) const;

    /// Ends the program, MPI's part left out, as mpirun wants it after a signal.
    [[noreturn]] static void leaveAfterSignal();

private:
    int _rank = 0;
    int _count = 1;
    int _countHere = 1;
};

/// Between two glances at what others say.
void waitABit();

/// Threads for each program, so that those on one machine keep its processors busy.
[[nodiscard]] int threadsPerRank(const Ranks& ranks);

}  // namespace osgbindem
