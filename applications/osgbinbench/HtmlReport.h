// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Diagram.h"
#include "Table.h"

#include <osg/Image>

#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {

/// What a page says of one measurement.
struct HtmlReport {
    std::string database;
    std::string partial;  ///< why it is not complete; empty: it is
    std::vector<std::string> sentences;
    std::vector<report::TextTable> tables;
    std::vector<report::Diagram> diagrams;
    std::vector<std::pair<std::string, osg::ref_ptr<osg::Image>>> pictures;  ///< with their names

    /// One page that needs no other file. Gnuplot draws the diagrams; where it is not installed, the page says so.
    [[nodiscard]] std::string html() const;
};

}  // namespace osgAnalyticBin::bench
