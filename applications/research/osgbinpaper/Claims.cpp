// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Claims.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace osgAnalyticBin::paper {

namespace {

Counts countsOf(const ViewResult& view, Method method) {
    return sumOf(view.methods[indexOf(method)]);
}

// "12.3 % fewer" or "more".
std::string change(std::uint64_t value, std::uint64_t reference) {
    if (reference == 0) return "-";
    const double percent = 100.0 * (static_cast<double>(value) / static_cast<double>(reference) - 1.0);
    char text[64];
    std::snprintf(text, sizeof text, "%.1f %% %s", std::abs(percent), percent < 0.0 ? "fewer" : "more");
    return text;
}

std::string wrongCulls(const ViewResult& sum, Method method) {
    const Counts counts = countsOf(sum, method);
    return std::string(kMethodNames[indexOf(method)]) + " " + std::to_string(counts.wrongCulls) + " (" +
           std::to_string(counts.holes) + " holes)";
}

std::string wrongInsides(const ViewResult& sum, Method method) {
    return std::string(kMethodNames[indexOf(method)]) + " " + std::to_string(countsOf(sum, method).wrongInsides);
}

// Of one method against another: blocks tested and drawn.
std::string against(const ViewResult& view, Method method, Method reference) {
    const Counts a = countsOf(view, method);
    const Counts b = countsOf(view, reference);
    return std::string(kMethodNames[indexOf(method)]) + " against " + kMethodNames[indexOf(reference)] + ": tested " +
           change(a.tested, b.tested) + ", drawn " + change(a.drawn, b.drawn);
}

// The claims' own numbers.
constexpr double kClaimedShare = 0.5;
constexpr double kClaimTolerance = 0.1;

void addWrongCulls(const ViewResult& sum, std::vector<std::string>& lines) {
    const bool isPaperSound = countsOf(sum, Method::Paper).wrongCulls == 0;
    const bool isQuadraticSound = countsOf(sum, Method::Quadratic).wrongCulls == 0;
    lines.emplace_back("Claim: wrong culls at the frustum's sides vanish.");
    lines.push_back(std::string("  ") +
                    (isPaperSound ? "None met by the published rule: " : "Not by the published rule: ") +
                    wrongCulls(sum, Method::Corners) + ", " + wrongCulls(sum, Method::Paper) + ".");
    lines.push_back(std::string("  ") +
                    (isQuadraticSound ? "With a proven remainder they do: " : "NOR with a remainder: ") +
                    wrongCulls(sum, Method::Quadratic) + ", " + wrongCulls(sum, Method::Exact) + ".");
}

bool isHalf(std::uint64_t value, std::uint64_t reference) {
    const double share = static_cast<double>(value) / static_cast<double>(std::max<std::uint64_t>(reference, 1));
    return std::abs(share - kClaimedShare) <= kClaimTolerance;
}

void addBlocks(const ViewResult& sum, Method reference, const char* what, std::vector<std::string>& lines) {
    const Counts paper = countsOf(sum, Method::Paper);
    const Counts other = countsOf(sum, reference);
    const bool isFound = isHalf(paper.tested, other.tested) || isHalf(paper.drawn, other.drawn);
    lines.push_back(std::string(isFound ? "  Found" : "  Not found") + " against " + what + ":");
    for (const Method method : {Method::Paper, Method::Quadratic})
        lines.push_back("    " + against(sum, method, reference) + ".");
}

void addBlocks(const Results& results, const ViewResult& sum, std::vector<std::string>& lines) {
    lines.emplace_back("Claim: about 50 % fewer blocks than the test of eight corners.");
    addBlocks(sum, Method::Corners, "the corners of the bin", lines);
    addBlocks(sum, Method::Box, "the corners of a box along the axes that holds the bin", lines);
    addBlocks(sum, Method::Sphere, "a sphere that holds the bin", lines);
    lines.push_back("  Few blocks are no merit by themselves: of " + std::to_string(sum.seen()) +
                    " leaves with a point in the frustum, corners loses " +
                    std::to_string(countsOf(sum, Method::Corners).lostLeaves) + ", paper " +
                    std::to_string(countsOf(sum, Method::Paper).lostLeaves) + ", quadratic " +
                    std::to_string(countsOf(sum, Method::Quadratic).lostLeaves) + ".");
    lines.emplace_back("  By kind of view:");
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) {
        for (const Method reference : {Method::Corners, Method::Box}) {
            lines.push_back(std::string("    ") + kViewKinds[kind].name + ": " +
                            against(results.views[kind], Method::Paper, reference) + ".");
        }
    }
}

}  // namespace

std::vector<std::string> findings(const Results& results) {
    const ViewResult sum = results.sum();
    std::vector<std::string> lines;
    addWrongCulls(sum, lines);
    addBlocks(results, sum, lines);
    lines.push_back("Wrong \"inside\", which drops the tests of all tiles below: " +
                    wrongInsides(sum, Method::Corners) + ", " + wrongInsides(sum, Method::Paper) + ", " +
                    wrongInsides(sum, Method::Quadratic) + ", " + wrongInsides(sum, Method::Exact) + ".");
    return lines;
}

}  // namespace osgAnalyticBin::paper
