// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// A diagram as files: what it shows, comma-separated, and the gnuplot script that draws NAME.svg and NAME.png from
/// that when it is run in the folder of both.
struct Diagram {
    std::string name;
    std::string data;    ///< of NAME.csv
    std::string script;  ///< of NAME.gp
};

/// A script that draws by `commands`, which find the diagram's name in `name`, as SVG and as PNG.
/// `settings`: of both terminals, such as "size 800,500".
[[nodiscard]] std::string drawnTwice(const std::string& name, const std::string& settings, const std::string& commands);

/// Writes the diagrams' files to a folder, which is made if it is missing, and has gnuplot draw them there.
/// Throws: Failure when a file cannot be written, gnuplot is not installed or does not succeed; the data and the
/// scripts of all diagrams are there when only the drawing failed.
void plot(const std::string& folder, const std::vector<Diagram>& diagrams);

}  // namespace osgAnalyticBin::report
