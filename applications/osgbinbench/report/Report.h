// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "PoseTable.h"

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// One flight over the database, with one culling method.
struct Flight {
    std::string label;
    std::string folder;
    std::vector<flight::PoseRecord> poses;
    std::vector<std::uint64_t> differingPixels;  ///< per pose, against the first run; zeros for the first
};

/// A pose at which a sound method drew another picture than the reference.
struct Mismatch {
    std::string label;
    std::string pose;
    std::uint64_t pixels = 0;
};

/// Several flights along one path; the first is the reference.
class Report {
public:
    /// Reads the tables and compares the pictures. Without labels the folders' names are the labels. With a
    /// `differenceFolder` a picture of every difference is written there, as LABEL_POSE.png.
    /// Returns: nullopt, with one line in `error`, when a run is missing or broken, or its poses are not the
    /// reference's.
    /// Requires: no labels, or one for each folder.
    [[nodiscard]] static std::optional<Report> of(const std::vector<std::string>& folders,
                                                  const std::vector<std::string>& labels,
                                                  const std::string& differenceFolder, std::string& error);

    /// One table: every pose, the sums of the groups, the sums of all, and the ratios to the run labelled "sphere".
    /// A pose belongs to the group named by the text before the first `_` of its name, if another pose does too.
    void print(std::ostream& output) const;

    /// The pictures that should not differ: those of all methods but "paper" and "corners".
    [[nodiscard]] std::vector<Mismatch> mismatches() const;

    [[nodiscard]] const std::vector<Flight>& runs() const { return _runs; }

private:
    std::vector<Flight> _runs;
};

}  // namespace osgAnalyticBin::report
