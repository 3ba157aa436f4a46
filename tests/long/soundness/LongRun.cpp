// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "LongRun.h"

#include <cstdio>
#include <cstdlib>

namespace osgAnalyticBin::test {

std::optional<LongRun> longRunOf(int argc, char** argv, const std::string& flag) {
    LongRun run;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name == flag) {
            run.hasFlag = true;
            continue;
        }
        const std::uint64_t value = i + 1 < argc ? std::strtoull(argv[++i], nullptr, 0) : 0;
        if (name == "--trials" && value > 0) {
            run.trials = value;
        } else if (name == "--seed") {
            run.seedValue = value;
        } else if (name == "--threads" && value > 0 && value <= 1024) {
            run.threads = static_cast<unsigned>(value);
        } else {
            std::printf("%s %s [--trials N] [--seed S] [--threads T]\n", argv[0],
                        flag.empty() ? "" : ('[' + flag + ']').c_str());
            return std::nullopt;
        }
    }
    return run;
}

}  // namespace osgAnalyticBin::test
