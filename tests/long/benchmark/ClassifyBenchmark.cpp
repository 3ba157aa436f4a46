// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The time of one tile against the four side planes of a frustum, by OSG's sphere and by bins: BM_Classify with nine
// tiles in ten outside, BM_ClassifyHalf with half of them. All answers are compared with the oracle first.

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>

#include <benchmark/benchmark.h>
#include <osg/BoundingSphere>
#include <osg/CoordinateSystemNode>
#include <osg/Polytope>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <support/View.h>
#include <utility>

namespace osgAnalyticBin::test {
namespace {

using core::Geodetic;
using core::GeodeticBin;
using core::PlaneMask;
using core::Side;

// What a float coordinate near the earth's surface, and OSG's distance in float, may be off by.
constexpr Real kFloatTolerance = 4.0;

constexpr double kMostlyOutside = 0.9;
constexpr double kHalfOutside = 0.5;
constexpr std::size_t kSites = 4;
constexpr double kEarthRadius = 6.4e6;

// The four side planes of a camera, as each method wants them.
struct Frustum {
    explicit Frustum(const View& view) : planes(view.planes()) {
        for (const core::Plane& p : planes) {
            set.push_back(p);
            polytope.add(osg::Plane(p.normal.x, p.normal.y, p.normal.z, p.offset));
        }
        polytope.setupMask();
    }

    std::vector<core::Plane> planes;
    core::PlaneSet set;
    osg::Polytope polytope;
};

Geodetic near(Random& random, const Geodetic& site, double distance) {
    const double heading = random.uniform(-kPi, kPi);
    const double angle = distance / kEarthRadius;
    const double latitude = std::clamp(site.latitude + angle * std::cos(heading), -kHalfPi, kHalfPi);
    const double shrink = std::max(0.05, std::cos(latitude));
    return {latitude, site.longitude + angle * std::sin(heading) / shrink, site.altitude};
}

GeodeticBin tileAt(Random& random, int level, const Geodetic& position) {
    const double tile = std::ldexp(kRootTileDeg, -level) * kRadiansPerDegree;
    const double south = std::min(std::floor(position.latitude / tile) * tile, kHalfPi - tile);
    const double west = std::floor(position.longitude / tile) * tile;
    const double low = random.uniform(-200.0, 3000.0);
    return GeodeticBin({south, south + tile}, {west, west + tile}, {low, low + random.logUniform(10.0, 4000.0)});
}

// Tiles of all levels about a few places, and cameras there, each looking at a target, rolled anyhow. As many tiles as
// the second-level cache of a common machine holds: what is measured is the test, not the memory.
struct Scene {
    static constexpr std::size_t kTiles = 2048;
    static constexpr std::size_t kFrusta = 64;

    explicit Scene(Random& random) {
        std::vector<Geodetic> sites;
        for (std::size_t i = 0; i < kSites; ++i)
            sites.push_back({random.uniform(-1.2, 1.2), random.uniform(-kPi, kPi), 0.0});
        for (std::size_t i = 0; i < kTiles; ++i) {
            const Geodetic position = near(random, sites[i % kSites], random.logUniform(1e3, 2e6));
            tiles.emplace_back(wgs84(), tileAt(random, random.integer(0, kDeepestLevel), position));
        }
        for (std::size_t i = 0; i < kFrusta; ++i) {
            const Geodetic& site = sites[i % kSites];
            const double height = random.logUniform(5e3, 2e6);
            Geodetic eye = near(random, site, random.uniform(0.0, 1.0) * height);
            eye.altitude = height;
            View view;
            view.eye = wgs84().toEcef(eye);
            view.lookAlong(wgs84().toEcef(near(random, site, random.uniform(0.0, 1.0) * height)) - view.eye, random);
            view.halfWidth = std::tan(random.uniform(15.0, 35.0) * kRadiansPerDegree);
            frusta.emplace_back(view);
        }
    }

    std::vector<BinOracle> tiles;
    std::vector<Frustum> frusta;
};

// By how much the bin reaches into the half space of the plane that it reaches into least; negative: it is outside.
Real reachInto(const Frustum& frustum, const BinOracle& tile) {
    Real least = tile.distanceRange(frustum.planes[0]).upper;
    for (const core::Plane& plane : frustum.planes) least = std::min(least, tile.distanceRange(plane).upper);
    return least;
}

// For every frustum, a sequence of tiles, a given share of them outside of it by the oracle. Some sixty thousand pairs
// in random order: more than a branch predictor learns.
struct TileMix {
    static constexpr std::size_t kTilesPerFrustum = 1024;

    TileMix(Random& random, const Scene& scene, double outsideShare) {
        for (const Frustum& frustum : scene.frusta) {
            std::array<std::vector<std::uint32_t>, 2> byReach;  // outside, and reached into
            for (std::uint32_t i = 0; i < scene.tiles.size(); ++i)
                byReach[reachInto(frustum, scene.tiles[i]) < 0 ? 0 : 1].push_back(i);
            std::vector<std::uint32_t>& chosen = tilesOfFrustum.emplace_back();
            while (chosen.size() < kTilesPerFrustum) {
                const bool isOutside = byReach[1].empty() || (!byReach[0].empty() && random.chance(outsideShare));
                const std::vector<std::uint32_t>& from = byReach[isOutside ? 0 : 1];
                chosen.push_back(from[static_cast<std::size_t>(random.integer(0, static_cast<int>(from.size()) - 1))]);
            }
        }
    }

    std::vector<std::vector<std::uint32_t>> tilesOfFrustum;
};

// The tests: true when the tile is kept.

struct OsgTest {
    [[nodiscard]] bool operator()(Frustum& frustum, const osg::BoundingSphere& bound) const {
        return frustum.polytope.contains(bound);
    }
};

struct SetTest {
    template <class Bin>
    [[nodiscard]] bool operator()(const Frustum& frustum, const Bin& bin) const {
        PlaneMask undecided = frustum.set.all();
        return core::classify(bin, frustum.set, undecided) != Side::Outside;
    }
};

template <class Make>
[[nodiscard]] auto madeOf(const std::vector<BinOracle>& tiles, const Make& make) {
    std::vector<decltype(make(tiles[0]))> bins;
    bins.reserve(tiles.size());
    for (const BinOracle& tile : tiles) bins.push_back(make(tile));
    return bins;
}

class Suite {
public:
    Suite()
        : _random(200),
          _scene(_random),
          _mostlyOutside(_random, _scene, kMostlyOutside),
          _halfOutside(_random, _scene, kHalfOutside) {}

    // Returns: false when a method culls a tile that no plane has outside by more than a tolerance.
    [[nodiscard]] bool add() {
        const osg::ref_ptr<osg::EllipsoidModel> model(
            new osg::EllipsoidModel(wgs84().equatorialRadius(), wgs84().polarRadius()));
        const auto sphere = [&](const BinOracle& tile) { return AnalyticBin(tile.bin()).boundingSphere(*model); };
        const auto quadratic = [](const BinOracle& tile) { return core::quadraticOrExact(wgs84(), tile.bin()); };
        const auto exact = [](const BinOracle& tile) { return core::ExactGeodeticBin(wgs84(), tile.bin()); };
        bool right = addMethod("osgSphere", madeOf(_scene.tiles, sphere), OsgTest(), kFloatTolerance);
        right &= addMethod("quadratic", madeOf(_scene.tiles, quadratic), SetTest(), 0);
        right &= addMethod("exact", madeOf(_scene.tiles, exact), SetTest(), 0);
        return right;
    }

private:
    template <class Bin, class Test>
    [[nodiscard]] bool addMethod(const std::string& name, std::vector<Bin> bins, Test test, Real tolerance) {
        const bool right =
            check(name, _mostlyOutside, bins, test, tolerance) && check(name, _halfOutside, bins, test, tolerance);
        const auto shared = std::make_shared<std::vector<Bin>>(std::move(bins));
        for (const auto& [prefix, mix] :
             {std::pair("BM_Classify/", &_mostlyOutside), std::pair("BM_ClassifyHalf/", &_halfOutside)}) {
            benchmark::RegisterBenchmark((prefix + name).c_str(), [this, mix = mix, shared, test](benchmark::State& s) {
                time(s, *mix, *shared, test);
            });
        }
        return right;
    }

    template <class Bin, class Test>
    [[nodiscard]] bool check(const std::string& name, const TileMix& mix, const std::vector<Bin>& bins,
                             const Test& test, Real tolerance) {
        std::size_t kept = 0;
        std::size_t truth = 0;
        std::size_t wrong = 0;
        for (std::size_t f = 0; f < _scene.frusta.size(); ++f) {
            for (const std::uint32_t tile : mix.tilesOfFrustum[f]) {
                const bool keeps = test(_scene.frusta[f], bins[tile]);
                kept += keeps ? 1 : 0;
                truth += reachInto(_scene.frusta[f], _scene.tiles[tile]) >= 0 ? 1u : 0u;
                wrong += !keeps && reachInto(_scene.frusta[f], _scene.tiles[tile]) >= tolerance ? 1u : 0u;
            }
        }
        const std::size_t pairs = mix.tilesOfFrustum.size() * TileMix::kTilesPerFrustum;
        std::fprintf(stderr, "%-12s keeps %5zu, no plane has %5zu outside, of %zu; wrongly culled: %zu\n", name.c_str(),
                     kept, truth, pairs, wrong);
        return wrong == 0;
    }

    template <class Bin, class Test>
    void time(benchmark::State& state, const TileMix& mix, const std::vector<Bin>& bins, const Test& test) {
        std::size_t f = 0;
        for (auto _ : state) {
            Frustum& frustum = _scene.frusta[f];
            std::size_t kept = 0;
            for (const std::uint32_t tile : mix.tilesOfFrustum[f]) kept += test(frustum, bins[tile]) ? 1u : 0u;
            benchmark::DoNotOptimize(kept);
            f = (f + 1) % _scene.frusta.size();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(TileMix::kTilesPerFrustum));
    }

    Random _random;
    Scene _scene;
    TileMix _mostlyOutside;
    TileMix _halfOutside;
};

}  // namespace
}  // namespace osgAnalyticBin::test

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
    osgAnalyticBin::test::Suite suite;
    if (!suite.add()) {
        std::fprintf(stderr,
                     "osganalyticbin_benchmark: a method culls what it must keep, or keeps all; nothing is timed\n");
        return EXIT_FAILURE;
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return EXIT_SUCCESS;
}
