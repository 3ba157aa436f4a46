// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The module osgbindem_mpi, all that is linked to MPI.

#include "Ranks.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mpi.h>
#include <thread>

namespace osgbindem {
namespace {

class MpiRanks final : public Ranks {
public:
    MpiRanks() {
        MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
        MPI_Comm_rank(MPI_COMM_WORLD, &_rank);
        MPI_Comm_size(MPI_COMM_WORLD, &_count);
        MPI_Comm here = MPI_COMM_NULL;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
        MPI_Comm_size(here, &_countHere);
        MPI_Comm_free(&here);
    }

    ~MpiRanks() override {
        while (failureElsewhere()) {
        }
        MPI_Finalize();
    }

    [[nodiscard]] int rank() const override { return _rank; }
    [[nodiscard]] int count() const override { return _count; }
    [[nodiscard]] int countHere() const override { return _countHere; }

    void sendFailure(const std::string& text) const override {
        constexpr std::size_t kMost = 1000;  // short messages never wait for who receives them
        const int size = static_cast<int>(std::min(text.size(), kMost));
        for (int rank = 0; rank < _count; ++rank) {
            if (rank != _rank) MPI_Send(text.data(), size, MPI_CHAR, rank, 0, MPI_COMM_WORLD);
        }
    }

    [[nodiscard]] std::optional<std::string> failureElsewhere() const override {
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

    [[nodiscard]] bool meet(bool hasFailed, const std::function<void()>& glance) const override {
        constexpr std::chrono::seconds kPatience{60};
        constexpr std::chrono::milliseconds kBetweenGlances{2};
        const int mine = hasFailed ? 1 : 0;
        int any = 0;
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Iallreduce(&mine, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
        const auto begin = std::chrono::steady_clock::now();
        for (int isThere = 0; MPI_Test(&request, &isThere, MPI_STATUS_IGNORE) == MPI_SUCCESS && isThere == 0;
             std::this_thread::sleep_for(kBetweenGlances)) {
            if (hasFailed && std::chrono::steady_clock::now() - begin > kPatience) {
                MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
            }
            if (glance) glance();
        }
        return any != 0;
    }

private:
    int _rank = 0;
    int _count = 1;
    int _countHere = 1;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) Ranks* osgbindemJoinRanks() {
    int level = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS || level < MPI_THREAD_FUNNELED) {
        return nullptr;
    }
    return new MpiRanks;
}

}  // namespace osgbindem
