// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Counts the leaf tiles that each method keeps, over random cameras, against the truth: leaves whose convex hull meets
// the frustum (libccd) and of which a dense sample of points sees the eye past the occluder. A quadtree of 16 x 8 tiles
// of 22.5 degrees is refined by distance; a method that culls a tile culls its leaves. Heights are made up, or real
// from a raster of least and greatest heights:
//   gdal_translate -of ENVI -co INTERLEAVE=BSQ -ot Int16 minmax.tif heights.raw
// Such a raster has 576 x 288 cells from 180 W and 90 N on, first all least heights, then all greatest.
// Fails when a bar is missed.

#include "Heights.h"
#include "TileTraversal.h"
#include "ViewKind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <support/RandomBins.h>
#include <support/View.h>
#include <thread>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::Geodetic;

struct Row {
    paper::ViewKind view;
    double bar;  // most excess of exact with reverse and hull, percent
};

constexpr std::array<Row, 7> kRows{{{{"fov 60 down 100-10000 km", 60, 1e5, 1e7, 90, 90}, 1.5},
                                    {{"fov 60 oblique 10-500 km", 60, 1e4, 5e5, 15, 60}, 1.5},
                                    {{"fov 60 level 0.2-5 km", 60, 200, 5e3, -5, 10}, 1.5},
                                    {{"fov 60 level 5-100 km", 60, 5e3, 1e5, -5, 10}, 1.5},
                                    {{"fov 10 level 0.2-5 km", 10, 200, 5e3, -2, 5}, 4.0},
                                    {{"fov 10 down 15-30 deg", 10, 1e3, 1e5, 15, 30}, 4.0},
                                    {{"fov 10 down from orbit", 10, 2e5, 1e6, 30, 90}, 4.0}}};

struct Options {
    int cameras = 100;
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::string heights;
    double depth = 12000.0;
};

View randomView(Random& random, const paper::ViewKind& kind, const Heights& heights) {
    Geodetic position{std::asin(random.uniform(-1.0, 1.0)), random.uniform(-kPi, kPi), 0.0};
    position.altitude = heights.groundAt(position) + random.logUniform(kind.lowest, kind.highest);
    View view;
    view.eye = wgs84().toEcef(position);
    const double azimuth = random.uniform(-kPi, kPi);
    const double pitch = -random.uniform(kind.pitchFrom, kind.pitchTo) * kRadiansPerDegree;
    const paper::CameraAxes axes = paper::cameraAxes(position, azimuth, pitch);
    view.forward = axes.forward;
    view.right = axes.right;
    view.up = axes.up;
    view.halfWidth = std::tan(0.5 * kind.fovDeg * kRadiansPerDegree);
    return view;
}

Counts runRow(const Options& options, const Heights& heights, std::size_t row) {
    std::vector<Counts> counts(options.threads);
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < options.threads; ++t) {
        threads.emplace_back([&, t] {
            for (int i = static_cast<int>(t); i < options.cameras; i += static_cast<int>(options.threads)) {
                Random random(1000 * static_cast<std::uint64_t>(i) + row);
                const View view = randomView(random, kRows[row].view, heights);
                counts[t].add(countLeaves(view, heights, options.depth));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    Counts total;
    for (const Counts& c : counts) total.add(c);
    return total;
}

double percent(double part, double whole) {
    return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

// Leaves kept beyond the truth, in percent of it. What a method misses is not set against what it keeps in vain.
double excess(const Counts& counts, Method m) {
    const auto inVain = static_cast<double>(counts.kept[m] + counts.missed[m]) - static_cast<double>(counts.truth);
    return percent(inVain, static_cast<double>(counts.truth));
}

bool report(const Row& row, const Counts& counts) {
    std::printf("%-25s %8llu", row.view.name, static_cast<unsigned long long>(counts.truth));
    for (std::size_t m = 0; m < kMethods; ++m) {
        std::printf(" %+9.2f%s", excess(counts, static_cast<Method>(m)), counts.missed[m] > 0 ? "!" : " ");
    }
    const double found = percent(static_cast<double>(counts.hiddenFound), static_cast<double>(counts.hidden));
    std::printf(" %8llu %7.3f\n", static_cast<unsigned long long>(counts.hidden), found);
    bool good = counts.hidden == 0 || found >= 99.5;
    for (const Method m : {kExactReverseHull, kQuadraticReverseHull}) {
        good = good && excess(counts, m) <= row.bar && counts.missed[m] == 0;
    }
    return good;
}

int usage(int status) {
    std::printf("osganalyticbin_tightness [--cameras N] [--heights FILE.raw] [--depth METRES] [--threads T]\n");
    return status;
}

int run(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name == "--help") return usage(EXIT_SUCCESS);
        if (i + 1 == argc) return usage(EXIT_FAILURE);
        const std::string value = argv[++i];
        if (name == "--cameras") {
            options.cameras = std::max(1, std::atoi(value.c_str()));
        } else if (name == "--threads") {
            options.threads = static_cast<unsigned>(std::clamp(std::atoi(value.c_str()), 1, 1024));
        } else if (name == "--heights") {
            options.heights = value;
        } else if (name == "--depth") {
            options.depth = std::atof(value.c_str());
        } else {
            return usage(EXIT_FAILURE);
        }
    }
    const Heights heights(options.heights);
    std::printf("%d cameras a row, %s heights, occluder %.0f m deep; leaves above truth, percent\n", options.cameras,
                options.heights.empty() ? "made-up" : "real", options.depth);
    std::printf("%-25s %8s", "view", "leaves");
    for (const char* name : kMethodNames) std::printf(" %9s ", name);
    std::printf(" %8s %7s\n", "hidden", "found %");
    bool good = true;
    for (std::size_t row = 0; row < kRows.size(); ++row) {
        good = report(kRows[row], runRow(options, heights, row)) && good;
        std::fflush(stdout);
    }
    std::printf("!: culled a leaf that is seen. The bars are %s.\n", good ? "met" : "MISSED");
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace osgAnalyticBin::test

int main(int argc, char** argv) {
    return osgAnalyticBin::test::run(argc, argv);
}
