// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "GnuplotRun.h"
#include "TextFile.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace osgAnalyticBin::paper {

using support::withDecimals;
using Polyline = std::vector<glm::dvec3>;

/// Text of a gnuplot script: what a figure says, without terminal and output.
class PlotScript final {
public:
    /// Adds a line of gnuplot.
    PlotScript& operator<<(const std::string& line);

    /// Adds a data block, named with a leading $: each line's points, with an empty line between lines.
    void addBlock(const std::string& name, const std::vector<Polyline>& lines);
    /// Adds a data block of rows of words.
    void addRows(const std::string& name, const std::vector<std::string>& rows);
    /// Adds the key of a multiplot across its foot, that part of its height: an entry is a style and a title.
    void addKey(double part, const std::vector<std::string>& entries);

    [[nodiscard]] const std::string& text() const noexcept { return _text; }

private:
    std::string _text;
};

/// Draws into a folder, which is made.
class Gnuplot final {
public:
    static constexpr int kWidth = 1000;

    /// Throws: Failure when the folder cannot be made or gnuplot cannot be run.
    explicit Gnuplot(const std::string& folder);

    /// Draws NAME.svg and NAME.png, `height` pixels high; both appear under their names when they are complete.
    /// Throws: Failure with gnuplot's own words.
    void draw(const std::string& name, int height, const PlotScript& script) const;

    /// The name of a file of the folder.
    [[nodiscard]] std::string file(const std::string& name) const { return _folder + "/" + name; }

private:
    std::string _folder;
};

/// Colours that colour-blind readers tell apart (Okabe and Ito).
namespace colour {
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kSky = "#56B4E9";
inline constexpr const char* kOrange = "#E69F00";
inline constexpr const char* kRed = "#D55E00";
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kGrey = "#B8B8B8";
inline constexpr const char* kDark = "#404040";
}  // namespace colour

}  // namespace osgAnalyticBin::paper
