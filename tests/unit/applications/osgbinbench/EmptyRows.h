// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Figures.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

// The figures of a number of poses, all of them 0.
inline std::vector<report::Json> emptyRows(std::size_t poses) {
    report::Json row;
    for (const Column& column : kPoseColumns) {
        const std::string name = column.name;
        row[name] = name.substr(name.size() - 3) == "_ms" ? report::Json(0.0) : report::Json(0U);
    }
    return std::vector<report::Json>(poses, row);
}

}  // namespace osgAnalyticBin::bench
