// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Claims.h"

#include <cmath>
#include <cstdio>

namespace osgAnalyticBin::paper {

namespace {

// "12.3 % fewer" or "more".
std::string change(std::uint64_t value, std::uint64_t reference) {
    if (reference == 0) return "-";
    const double percent = 100.0 * (static_cast<double>(value) / static_cast<double>(reference) - 1.0);
    char text[64];
    std::snprintf(text, sizeof text, "%.1f %% %s", std::abs(percent), percent < 0.0 ? "fewer" : "more");
    return text;
}

std::string wrongCulls(const ViewResult& sum, Method method) {
    const Counts counts = sumOf(sum.methods[indexOf(method)]);
    return std::string(kMethodNames[indexOf(method)]) + " " + std::to_string(counts.wrongCulls) + " (" +
           std::to_string(counts.holes) + " holes)";
}

std::string wrongInsides(const ViewResult& sum, Method method) {
    return std::string(kMethodNames[indexOf(method)]) + " " +
           std::to_string(sumOf(sum.methods[indexOf(method)]).wrongInsides);
}

// Of one method against another: blocks tested and drawn.
std::string against(const ViewResult& view, Method method, Method reference) {
    const Counts a = sumOf(view.methods[indexOf(method)]);
    const Counts b = sumOf(view.methods[indexOf(reference)]);
    return std::string(kMethodNames[indexOf(method)]) + " against " + kMethodNames[indexOf(reference)] + ": tested " +
           change(a.tested, b.tested) + ", drawn " + change(a.drawn, b.drawn);
}

}  // namespace

std::vector<std::string> findings(const Results& results) {
    const ViewResult sum = results.sum();
    const Counts paper = sumOf(sum.methods[indexOf(Method::Paper)]);
    const Counts quadratic = sumOf(sum.methods[indexOf(Method::Quadratic)]);
    std::vector<std::string> lines;
    lines.push_back("Claim: wrong culls at the frustum's sides vanish.");
    lines.push_back(std::string("  ") +
                    (paper.wrongCulls == 0 ? "None by the published rule here: " : "Not by the published rule: ") +
                    wrongCulls(sum, Method::Corners) + ", " + wrongCulls(sum, Method::Paper) + ".");
    lines.push_back(std::string("  ") +
                    (quadratic.wrongCulls == 0 ? "With a proven remainder they do: " : "NOR with a remainder: ") +
                    wrongCulls(sum, Method::Quadratic) + ", " + wrongCulls(sum, Method::Exact) + ".");
    lines.push_back("Claim: about 50 % fewer blocks than the test of eight corners.");
    for (const Method reference : {Method::Corners, Method::Box, Method::Sphere}) {
        for (const Method method : {Method::Paper, Method::Quadratic})
            lines.push_back("  " + against(sum, method, reference) + ".");
    }
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) {
        lines.push_back(std::string("  ") + kViewKinds[kind].name + ": " +
                        against(results.views[kind], Method::Quadratic, Method::Corners) + ".");
    }
    lines.push_back("Wrong \"inside\", which drops the tests of all tiles below: " +
                    wrongInsides(sum, Method::Corners) + ", " + wrongInsides(sum, Method::Paper) + ", " +
                    wrongInsides(sum, Method::Quadratic) + ", " + wrongInsides(sum, Method::Exact) + ".");
    return lines;
}

}  // namespace osgAnalyticBin::paper
