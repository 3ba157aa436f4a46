// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Failure.h"
#include "Table.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// One flight over the database, with one culling method, as binflight leaves it in a folder.
struct Flight {
    std::string folder;
    std::vector<std::string> poses, pictures;
    MethodFigures figures;  ///< the method has the folder's name; columns as in poses.csv, and kPixelsColumn
};

/// Pixels that differ from the first flight's picture.
inline constexpr const char* kPixelsColumn = "differingPixels";

/// Reads flights along one path, of which the first is the reference, and compares the pictures. With a
/// `differenceFolder` a picture of every difference is written there, as LABEL_POSE.png.
/// Throws: Failure when a flight is missing or broken, or its poses are not the reference's.
[[nodiscard]] std::vector<Flight> readFlights(const std::vector<std::string>& folders,
                                              const std::string& differenceFolder);

/// One table: every pose, the sums of the groups, the sums of all, and the ratios to the flight labelled "sphere".
void print(std::ostream& output, const std::vector<Flight>& flights);

/// A pose at which a sound method drew another picture than the reference.
struct Mismatch {
    std::string label;
    std::string pose;
    double pixels = 0.0;
};

/// The pictures that should not differ: those of all methods but "paper" and "corners".
[[nodiscard]] std::vector<Mismatch> mismatchesOf(const std::vector<Flight>& flights);

/// `osgbinbench report`: compares flights over a database that binflight left.
/// `argv[0]` is the name of the command. Returns: the exit code. Throws: Failure, UsageError.
[[nodiscard]] support::ExitCode run(int argc, char** argv);

}  // namespace osgAnalyticBin::report
