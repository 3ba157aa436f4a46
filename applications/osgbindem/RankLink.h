// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <optional>
#include <string>

namespace osgbindem {

/// What osgbindem asks of MPI. Only the module osgbindem_mpi has one, so that the program starts where MPI is not
/// installed. The functions are those of Ranks.
class RankLink {
public:
    RankLink() = default;
    RankLink(const RankLink&) = delete;
    RankLink& operator=(const RankLink&) = delete;
    /// Waits until all others have come here, and ends MPI.
    virtual ~RankLink() = default;

    [[nodiscard]] virtual int rank() const = 0;
    [[nodiscard]] virtual int count() const = 0;
    [[nodiscard]] virtual int countHere() const = 0;
    virtual void sendFailure(const std::string& text) const = 0;
    [[nodiscard]] virtual std::optional<std::string> failureElsewhere() const = 0;
    [[nodiscard]] virtual bool meet(bool hasFailed, const std::function<void()>& glance) const = 0;
};

/// The module's function, and its name. Returns: null where MPI does not start as threads need it.
using JoinRanks = RankLink* (*)();
constexpr const char* kJoinRanks = "osgbindemJoinRanks";

}  // namespace osgbindem
