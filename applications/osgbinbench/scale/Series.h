// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullMethod.h"
#include "Diagram.h"
#include "ProgramRun.h"
#include "Table.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::scale {

/// What the command line asks for.
struct Settings {
    std::vector<std::string> methodNames{"sphere", bench::kDefaultMethod, bench::kOracleMethod};
    std::vector<std::string> series{"depth", "residents", "memory"};
    std::vector<int> levels{4, 8, 12, 16, 20};
    std::vector<int> residents{100, 1000, 10000, 100000};
    int memoryTiles = 10000;
    int poses = 12;
    int cells = 8;
    int rounds = 15;
    std::string csv;
    std::string json;
    std::string plot;

    /// The oracle repeats what bins keep. Throws: Failure for an unknown name.
    [[nodiscard]] std::vector<bench::CullMethod> methods() const;
};

/// A row for each method and measurement.
using Rows = std::vector<report::Json>;

/// Each method on flights down globes of several depths; sums over the poses. Throws: Failure.
[[nodiscard]] Rows measureDepth(const Settings& settings, bench::FileWatch& watch);
/// Each method with several numbers of PagedLODs in memory; also the DatabasePager's update with more PagedLODs than
/// its target, none of which may go yet. Throws: Failure.
[[nodiscard]] Rows measureResidents(const Settings& settings, bench::FileWatch& watch);
/// What tiles in memory take by what is installed on them, and the time of making and installing one, in the pager's
/// thread as a rule. Throws: Failure.
[[nodiscard]] Rows measureMemory(const Settings& settings, bench::FileWatch& watch);

/// Depth (time for each drawn tile), flight (time of the whole flight), residents and memory; of a series without rows
/// none.
[[nodiscard]] std::vector<report::Diagram> diagramsOf(const Rows& depth, const Rows& residents, const Rows& memory);

/// `osgbinbench scale`: measures how culling scales with depth and with tiles in memory.
/// `argv[0]` is the name of the command. Returns: the exit code. Throws: Failure, UsageError.
[[nodiscard]] support::ExitCode run(int argc, char** argv);

}  // namespace osgAnalyticBin::scale
