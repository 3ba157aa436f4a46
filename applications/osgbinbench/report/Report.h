// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ProgramRun.h"

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// One flight over the database, with one culling method, as binflight leaves it in a folder.
struct Flight {
    std::string folder;
    std::string label;  ///< the folder's name
    std::vector<std::string> poses, pictures;
    std::map<std::string, std::vector<double>> figures;  ///< by column of poses.csv, a number for each pose
    std::vector<double> differingPixels;                 ///< against the first flight; zeros for the first

    /// Over all poses.
    [[nodiscard]] double sum(const std::string& column) const;
};

/// A pose at which a sound method drew another picture than the reference.
struct Mismatch {
    std::string label;
    std::string pose;
    double pixels = 0.0;
};

/// Several flights along one path; the first is the reference.
class Report {
public:
    /// Reads the tables and compares the pictures. With a `differenceFolder` a picture of every difference is written
    /// there, as LABEL_POSE.png.
    /// Returns: nullopt, with one line in `error`, when a flight is missing or broken, or its poses are not the
    /// reference's.
    [[nodiscard]] static std::optional<Report> of(const std::vector<std::string>& folders,
                                                  const std::string& differenceFolder, std::string& error);

    /// One table: every pose, the sums of the groups, the sums of all, and the ratios to the flight labelled "sphere".
    /// A pose belongs to the group named by the text before the first `_` of its name, if another pose does too.
    void print(std::ostream& output) const;

    /// The pictures that should not differ: those of all methods but "paper" and "corners".
    [[nodiscard]] std::vector<Mismatch> mismatches() const;

    [[nodiscard]] const std::vector<Flight>& flights() const { return _flights; }

private:
    std::vector<Flight> _flights;
};

/// `osgbinbench report`: compares flights over a database that binflight left.
/// `argv[0]` is the name of the command. Returns: the exit code. Throws: Failure, UsageError.
[[nodiscard]] support::ExitCode run(int argc, char** argv);

}  // namespace osgAnalyticBin::report
