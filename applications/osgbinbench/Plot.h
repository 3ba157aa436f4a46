// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Figures.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// A diagram as files: what it shows, comma-separated, and the gnuplot script that draws NAME.svg and NAME.png from
/// that when it is run in the folder of both.
struct Diagram {
    std::string name;
    std::string data;    ///< of NAME.csv
    std::string script;  ///< of NAME.gp
};

/// Tiles drawn, files requested and cull time by method, path by path, and tiles, triangles and files pose by pose.
/// The reference method is left out where there are others: it dwarfs them all.
/// Requires: figures for each of the poses, of one method at least.
[[nodiscard]] std::vector<Diagram> diagramsOf(const std::vector<std::string>& poses,
                                              const std::vector<MethodFigures>& methods);

/// Writes the diagrams' files to a folder, which is made if it is missing, and has gnuplot draw them there.
/// Throws: Failure when a file cannot be written, gnuplot is not installed or does not succeed; the data and the
/// scripts of all diagrams are there when only the drawing failed.
void plot(const std::string& folder, const std::vector<Diagram>& diagrams);

}  // namespace osgAnalyticBin::bench
