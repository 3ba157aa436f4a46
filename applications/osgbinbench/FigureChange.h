// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Measurement.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// What to make of a figure that was measured twice; `Changed` is said, but not judged.
enum class Verdict { Same, Noise, Changed, Better, Worse };

/// What became of one figure of one method, as texts for a table.
struct FigureChange {
    std::string method, figure, before, after;
    std::string ratio;  ///< new / old
    std::string poses;  ///< the least and the greatest ratio at a pose; empty where that was not measured
    std::string noise;  ///< the share from which on a change counts; empty for counts
    Verdict verdict = Verdict::Same;

    [[nodiscard]] bool isCount() const;
};

/// All figures that both files have of methods that both have, judged by comparisonRule().
[[nodiscard]] std::vector<FigureChange> changesOf(const std::vector<MeasuredMethod>& before,
                                                  const std::vector<MeasuredMethod>& after);

/// The same, what is better or worse only said to have changed.
[[nodiscard]] std::vector<FigureChange> unjudged(std::vector<FigureChange> changes);

}  // namespace osgAnalyticBin::bench
