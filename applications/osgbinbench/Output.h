// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Bench.h"
#include "Settings.h"
#include "Table.h"

#include <osg/Image>

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {

/// One line for each pose and method, after a line of column names.
[[nodiscard]] std::string csvOf(const Measurement& measured);

/// An object: how it was measured; "methods", by name, with sums over the poses or the flight; of poses also "paths",
/// by name, with "methods" as above over the poses of one path. "interrupted" is there after Ctrl-C: what was measured
/// until then.
[[nodiscard]] std::string jsonOf(const Settings& settings, const Measurement& measured);

/// Sums for people, with times over those of "oracle" where that was measured, then their ratios to "sphere" and
/// "cluster" where these were flown, then the most telling sums path by path, if there are several.
[[nodiscard]] std::vector<report::TextTable> tablesOf(const Measurement& measured);

/// A diagram that the gnuplot script bars.gp draws: what it shows, comma-separated.
struct Diagram {
    std::string name;
    std::string data;
};

/// Tiles drawn, files requested and cull time by method, path by path. Requires: poses.
/// The reference method is left out where there are others: it dwarfs them all.
[[nodiscard]] std::vector<Diagram> diagramsOf(const Measurement& measured);

/// Writes NAME.csv of each diagram and bars.gp to a folder, which is made if it is missing, and has gnuplot draw
/// NAME.svg and NAME.png there. Throws: Failure when a file cannot be written, or when gnuplot is not installed or
/// fails; then the data and the script are there.
void plot(const std::string& folder, const std::vector<Diagram>& diagrams);

/// One below the other.
void print(std::ostream& output, const std::vector<report::TextTable>& tables);

/// Whether bins are worth it for a database, in three sentences: tiles drawn, files and cull time against the better of
/// spheres and cluster callbacks; and where they do not help. Empty where bins, or both of the others, were not
/// measured. Requires: poses.
[[nodiscard]] std::vector<std::string> adviceOf(const Measurement& measured);

/// What a page says of one measurement.
struct HtmlReport {
    std::string database;
    std::string partial;  ///< why it is not complete; empty: it is
    std::vector<std::string> sentences;
    std::vector<report::TextTable> tables;
    std::vector<Diagram> diagrams;
    std::vector<std::pair<std::string, osg::ref_ptr<osg::Image>>> pictures;  ///< with their names

    /// One page that needs no other file. Gnuplot draws the diagrams; where it is not installed, the page says so.
    [[nodiscard]] std::string html() const;
};

}  // namespace osgAnalyticBin::bench
