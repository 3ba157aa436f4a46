// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Experiment.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::paper {

/// What the published experiment claims, and what is found of it: one line each.
[[nodiscard]] std::vector<std::string> findings(const Results& results);

}  // namespace osgAnalyticBin::paper
