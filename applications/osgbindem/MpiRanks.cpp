// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The module osgbindem_mpi, all that is linked to MPI.

#include "Ranks.h"

#include <chrono>
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

    ~MpiRanks() override { MPI_Finalize(); }

    [[nodiscard]] int rank() const override { return _rank; }
    [[nodiscard]] int count() const override { return _count; }
    [[nodiscard]] int countHere() const override { return _countHere; }

    bool meet(bool goesOn, const std::function<void()>& glance) const override {
        constexpr std::chrono::milliseconds kBetweenGlances{2};
        MPI_Request request = MPI_REQUEST_NULL;
        const int mine = goesOn ? 1 : 0;
        int all = 0;
        MPI_Iallreduce(&mine, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request);
        for (int isThere = 0; MPI_Test(&request, &isThere, MPI_STATUS_IGNORE) == MPI_SUCCESS && isThere == 0;
             std::this_thread::sleep_for(kBetweenGlances))
            glance();
        return all != 0;
    }

    void abort(int code) const override { MPI_Abort(MPI_COMM_WORLD, code); }

private:
    int _rank = 0;
    int _count = 1;
    int _countHere = 1;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) Ranks* osgbindemJoinRanks() {
    int level = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS || level < MPI_THREAD_FUNNELED)
        return nullptr;
    return new MpiRanks;
}

}  // namespace osgbindem
