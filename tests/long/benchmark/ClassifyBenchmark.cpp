// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The time of one tile against the four side planes of a frustum, for every method: BM_Classify with nine tiles in ten
// outside, BM_ClassifyHalf with half of them. Before anything is timed, all answers are compared with the oracle.

#include "BoxBins.h"
#include "ComparisonBins.h"
#include "TileMix.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>
#include <osg/BoundingBox>
#include <osg/BoundingSphere>
#include <osg/CoordinateSystemNode>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::ExactGeodeticBin;
using core::GeodeticBin;
using core::PlaneMask;
using core::Side;

// What a float coordinate near the earth's surface, and OSG's distance in float, may be off by.
constexpr Real kFloatTolerance = 4.0;

constexpr double kMostlyOutside = 0.9;
constexpr double kHalfOutside = 0.5;

osg::BoundingBox axisAlignedBox(const BinOracle& tile) {
    osg::BoundingBox box;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 direction(0.0);
        direction[axis] = 1.0;
        const RealRange along = tile.range(direction);
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        box._min[axis] = std::nextafter(static_cast<float>(along.lower), -kInfinity);
        box._max[axis] = std::nextafter(static_cast<float>(along.upper), kInfinity);
    }
    return box;
}

// The tests: true when the tile is kept.

struct OsgTest {
    template <class Bound>
    [[nodiscard]] bool operator()(Frustum& frustum, const Bound& bound) const {
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

struct PlaneByPlaneTest {
    template <class Bin>
    [[nodiscard]] bool operator()(const Frustum& frustum, const Bin& bin) const {
        PlaneMask undecided = 0b1111;
        return core::classify(bin, frustum.planes, frustum.planes.size(), undecided) != Side::Outside;
    }
};

// All that the kit does to a tile of a globe.
struct FullBin {
    ExactGeodeticBin exact;
    core::HorizonBin horizon;
};

struct FullTest {
    [[nodiscard]] bool operator()(const Frustum& frustum, const FullBin& bin) const {
        PlaneMask undecided = frustum.set.all();
        const Side side = core::classify(bin.exact, frustum.set, undecided);
        if (side == Side::Outside || (frustum.horizon && frustum.horizon->hides(bin.horizon))) return false;
        return side == Side::Inside || !core::isSeparated(bin.exact, frustum.set, frustum.set.size(), undecided);
    }
};

// What must be kept: whatever no plane has outside by more than a tolerance.
struct ReachesIn {
    Real tolerance;
    [[nodiscard]] bool operator()(const Frustum& frustum, const BinOracle& tile) const {
        return reachInto(frustum, tile) >= tolerance;
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

    // Returns: false when a method culls what it must not.
    [[nodiscard]] bool add() {
        const osg::ref_ptr<osg::EllipsoidModel> model(
            new osg::EllipsoidModel(wgs84().equatorialRadius(), wgs84().polarRadius()));
        const core::GeodeticMapping mapping(wgs84());
        const auto sphere = [&](const BinOracle& tile) { return AnalyticBin(tile.bin()).boundingSphere(*model); };
        const auto corners = [&](const BinOracle& tile) {
            return rivals::CornersBin(mapping, core::parameterBox(tile.bin()));
        };
        const auto paper = [&](const BinOracle& tile) {
            return rivals::PaperBin(mapping, core::parameterBox(tile.bin()));
        };
        const auto quadratic = [&](const BinOracle& tile) { return core::quadraticOrExact(wgs84(), tile.bin()); };
        const auto exact = [&](const BinOracle& tile) { return ExactGeodeticBin(wgs84(), tile.bin()); };
        const auto box = [&](const BinOracle& tile) { return rivals::BoxBin(wgs84(), tile.bin()); };
        const auto orientedBox = [&](const BinOracle& tile) { return rivals::OrientedBoxBin(wgs84(), tile.bin()); };
        const Real never = std::numeric_limits<Real>::infinity();
        bool right = addMethod("osgSphere", madeOf(_scene.tiles, sphere), OsgTest(), ReachesIn{kFloatTolerance});
        right &= addMethod("osgBox", madeOf(_scene.tiles, axisAlignedBox), OsgTest(), ReachesIn{kFloatTolerance});
        right &= addMethod("box", madeOf(_scene.tiles, box), PlaneByPlaneTest(), ReachesIn{0});
        right &= addMethod("orientedBox", madeOf(_scene.tiles, orientedBox), PlaneByPlaneTest(), ReachesIn{0});
        right &= addMethod("corners", madeOf(_scene.tiles, corners), PlaneByPlaneTest(), ReachesIn{never});
        right &= addMethod("paper", madeOf(_scene.tiles, paper), PlaneByPlaneTest(), ReachesIn{never});
        right &= addMethod("quadratic", madeOf(_scene.tiles, quadratic), SetTest(), ReachesIn{0});
        right &= addMethod("exact", madeOf(_scene.tiles, exact), SetTest(), ReachesIn{0});
        const auto full = [&](const BinOracle& tile) {
            return FullBin{ExactGeodeticBin(wgs84(), tile.bin()), core::HorizonBin(wgs84(), tile.bin())};
        };
        right &= addMethod("exactHorizonEdges", madeOf(_scene.tiles, full), FullTest(), seesASample);
        return right;
    }

private:
    template <class Bin, class Test, class MustKeep>
    [[nodiscard]] bool addMethod(const std::string& name, std::vector<Bin> bins, Test test, const MustKeep& mustKeep) {
        const bool right =
            check(name, _mostlyOutside, bins, test, mustKeep) && check(name, _halfOutside, bins, test, mustKeep);
        const auto shared = std::make_shared<std::vector<Bin>>(std::move(bins));
        for (const auto& [prefix, mix] :
             {std::pair("BM_Classify/", &_mostlyOutside), std::pair("BM_ClassifyHalf/", &_halfOutside)}) {
            benchmark::RegisterBenchmark((prefix + name).c_str(), [this, mix = mix, shared, test](benchmark::State& s) {
                time(s, *mix, *shared, test);
            });
        }
        return right;
    }

    template <class Bin, class Test, class MustKeep>
    [[nodiscard]] bool check(const std::string& name, const TileMix& mix, const std::vector<Bin>& bins,
                             const Test& test, const MustKeep& mustKeep) {
        std::size_t kept = 0;
        std::size_t truth = 0;
        std::size_t wrong = 0;
        for (std::size_t f = 0; f < _scene.frusta.size(); ++f) {
            for (const std::uint32_t tile : mix.tilesOfFrustum[f]) {
                const bool keeps = test(_scene.frusta[f], bins[tile]);
                kept += keeps ? 1 : 0;
                truth += reachInto(_scene.frusta[f], _scene.tiles[tile]) >= 0 ? 1u : 0u;
                wrong += !keeps && mustKeep(_scene.frusta[f], _scene.tiles[tile]) ? 1u : 0u;
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
