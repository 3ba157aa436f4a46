// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FamilyBenchmark.h"

#include "TileMix.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/core/bin/BinFamily.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <benchmark/benchmark.h>
#include <osg/BoundingSphere>
#include <osg/CoordinateSystemNode>

#include <core/kernels/PlaneKernels.h>
#ifdef OSGANALYTICBIN_SIMD
#include <hwy/highway.h>
#endif

#include <algorithm>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::BinFamily;
using core::ExactGeodeticBin;
using core::FamilyVerdict;
using core::HorizonBin;

// What a float coordinate near the earth's surface, and OSG's distance in float, may be off by.
constexpr Real kFamilyFloatTolerance = 4.0;

constexpr std::uint64_t kAllSiblings = (1U << kSiblings) - 1;

// Each test gives the siblings that are kept, one bit each.

struct SpheresTest {
    std::vector<osg::BoundingSphere> spheres;

    [[nodiscard]] std::uint64_t operator()(Frustum& frustum, std::uint32_t family) const {
        std::uint64_t kept = 0;
        for (std::size_t k = 0; k < kSiblings; ++k) {
            kept |= std::uint64_t{frustum.polytope.contains(spheres[kSiblings * family + k])} << k;
        }
        return kept;
    }
};

struct PlanesTest {
    std::vector<BinFamily> families;

    [[nodiscard]] std::uint64_t operator()(const Frustum& frustum, std::uint32_t family) const {
        FamilyVerdict verdict;
        families[family].classify(frustum.set, frustum.set.all(), verdict);
        return kAllSiblings & ~verdict.outside;
    }
};

// All that the kit does to the tiles of a globe.
struct FamilyTest {
    std::vector<BinFamily> families;
    std::vector<ExactGeodeticBin> bins;

    [[nodiscard]] std::uint64_t operator()(const Frustum& frustum, std::uint32_t family) const {
        FamilyVerdict verdict;
        families[family].classify(frustum.set, frustum.set.all(), verdict);
        std::uint64_t kept = kAllSiblings & ~verdict.outside;
        if (frustum.horizon && kept != 0) kept &= ~families[family].hiddenFrom(*frustum.horizon, kept);
        for (std::uint64_t left = kept & ~verdict.insideAll; left != 0; left &= left - 1) {
            const unsigned k = firstBit(left);
            const ExactGeodeticBin& bin = bins[kSiblings * family + k];
            if (core::isSeparated(bin, frustum.set, frustum.set.size(), verdict.undecided[k])) kept &= ~(1ULL << k);
        }
        return kept;
    }
};

// The times of three methods over the same tiles, in turn: a machine that is busy with other things too slows all of
// them. Of many laps the median counts; the least would be that of the order of tiles that is easiest to predict.
class Race {
public:
    struct Lap {
        double bins;         // families
        double siblings;     // OSG's spheres, siblings one after the other: their answers are much alike
        double singleTiles;  // OSG's spheres, one tile of any family after the other
    };

    explicit Race(std::size_t frusta) : _laps(frusta) {}

    void record(std::size_t frustum, const Lap& lap) { _laps[frustum].push_back(lap); }

    [[nodiscard]] double nanosecondsPerTile(double Lap::*method) {
        double all = 0.0;
        std::size_t count = 0;
        for (std::vector<Lap>& laps : _laps) {
            if (laps.empty()) continue;
            const auto median = laps.begin() + static_cast<std::ptrdiff_t>(laps.size() / 2);
            std::nth_element(laps.begin(), median, laps.end(),
                             [&](const Lap& a, const Lap& b) { return a.*method < b.*method; });
            all += (*median).*method;
            ++count;
        }
        return 1e9 * all / static_cast<double>(count * TileMix::kTilesPerFrustum);
    }

private:
    std::vector<std::vector<Lap>> _laps;
};

class FamilySuite {
public:
    FamilySuite()
        : _random(201),
          _scene(_random),
          _mostlyOutside(_random, _scene, 0.9),
          _halfOutside(_random, _scene, 0.5),
          _spheres(std::make_shared<SpheresTest>(spheres())) {}

    [[nodiscard]] bool add() {
        bool right = check("osgSphere", *_spheres, [](const Frustum& frustum, const BinOracle& tile) {
            return reachInto(frustum, tile) >= kFamilyFloatTolerance;
        });
        const auto reachesIn = [](const Frustum& frustum, const BinOracle& tile) {
            return reachInto(frustum, tile) >= 0;
        };
        const auto quadratic = [](const BinOracle& tile) { return core::quadraticOrExact(wgs84(), tile.bin()); };
        const auto exact = [](const BinOracle& tile) { return ExactGeodeticBin(wgs84(), tile.bin()); };
        std::vector<ExactGeodeticBin> bins;
        for (const BinOracle& tile : _scene.tiles) bins.push_back(exact(tile));
        right &= addMethod("quadratic", PlanesTest{familiesOf(quadratic)}, reachesIn);
        right &= addMethod("exact", PlanesTest{familiesOf(exact)}, reachesIn);
        right &= addMethod("exactHorizonEdges", FamilyTest{familiesOf(exact), std::move(bins)}, seesASample);
        return right;
    }

private:
    [[nodiscard]] SpheresTest spheres() const {
        const osg::ref_ptr<osg::EllipsoidModel> model(
            new osg::EllipsoidModel(wgs84().equatorialRadius(), wgs84().polarRadius()));
        SpheresTest test;
        for (const BinOracle& tile : _scene.tiles) {
            test.spheres.push_back(AnalyticBin(tile.bin()).boundingSphere(*model));
        }
        return test;
    }

    static void setIn(BinFamily& family, std::size_t i, const ExactGeodeticBin& bin) { family.set(i, bin); }
    static void setIn(BinFamily& family, std::size_t i, const core::QuadraticOrExact& bin) {
        std::visit([&](const auto& form) { family.set(i, form); }, bin);
    }

    template <class Make>
    [[nodiscard]] std::vector<BinFamily> familiesOf(const Make& make) const {
        std::vector<BinFamily> families(_scene.tiles.size() / kSiblings, BinFamily(kSiblings));
        for (std::size_t i = 0; i < _scene.tiles.size(); ++i) {
            setIn(families[i / kSiblings], i % kSiblings, make(_scene.tiles[i]));
            families[i / kSiblings].setHorizon(i % kSiblings, HorizonBin(wgs84(), _scene.tiles[i].bin()));
        }
        return families;
    }

    template <class Test, class MustKeep>
    [[nodiscard]] bool check(const char* name, const Test& test, const MustKeep& mustKeep) {
        return check(name, _mostlyOutside, test, mustKeep) && check(name, _halfOutside, test, mustKeep);
    }

    template <class Test, class MustKeep>
    [[nodiscard]] bool check(const char* name, const FamilyMix& mix, const Test& test, const MustKeep& mustKeep) {
        std::size_t kept = 0;
        std::size_t truth = 0;
        std::size_t wrong = 0;
        for (std::size_t f = 0; f < _scene.frusta.size(); ++f) {
            for (const std::uint32_t family : mix.familiesOfFrustum[f]) {
                const std::uint64_t keeps = test(_scene.frusta[f], family);
                for (std::size_t k = 0; k < kSiblings; ++k) {
                    const BinOracle& tile = _scene.tiles[kSiblings * family + k];
                    const bool isKept = (keeps >> k & 1) != 0;
                    kept += isKept ? 1u : 0u;
                    truth += reachInto(_scene.frusta[f], tile) >= 0 ? 1u : 0u;
                    wrong += !isKept && mustKeep(_scene.frusta[f], tile) ? 1u : 0u;
                }
            }
        }
        const std::size_t pairs = mix.familiesOfFrustum.size() * TileMix::kTilesPerFrustum;
        std::fprintf(stderr, "families: %-12s keeps %5zu, no plane has %5zu outside, of %zu; wrongly culled: %zu\n",
                     name, kept, truth, pairs, wrong);
        return wrong == 0;
    }

    template <class Test, class MustKeep>
    [[nodiscard]] bool addMethod(const std::string& name, Test test, const MustKeep& mustKeep) {
        const auto shared = std::make_shared<Test>(std::move(test));
        for (const auto& [prefix, mix] :
             {std::pair("BM_Family/", &_mostlyOutside), std::pair("BM_FamilyHalf/", &_halfOutside)}) {
#ifdef OSGANALYTICBIN_SIMD
            for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
                benchmark::RegisterBenchmark((prefix + name + "/" + hwy::TargetName(target)).c_str(),
                                             [this, mix = mix, shared, target](benchmark::State& state) {
                                                 hwy::SetSupportedTargetsForTest(target);
                                                 core::kernels::chooseKernels();
                                                 time(state, *mix, *shared);
                                                 hwy::SetSupportedTargetsForTest(0);
                                                 core::kernels::chooseKernels();
                                             })
                    ->UseManualTime();
            }
#else
            benchmark::RegisterBenchmark((prefix + name).c_str(), [this, mix = mix, shared](benchmark::State& state) {
                time(state, *mix, *shared);
            })->UseManualTime();
#endif
        }
        return check(name.c_str(), *shared, mustKeep);
    }

    template <class Test>
    void time(benchmark::State& state, const FamilyMix& mix, const Test& test) {
        Race race(_scene.frusta.size());
        std::size_t f = 0;
        for (auto _ : state) {
            const std::uint64_t order = _random.bits();
            const Race::Lap lap{seconds(f, mix, order, test), seconds(f, mix, order, *_spheres),
                                secondsOfSingleTiles(f, mix, order)};
            race.record(f, lap);
            state.SetIterationTime(lap.bins);
            f = (f + 1) % _scene.frusta.size();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(TileMix::kTilesPerFrustum));
        const double bins = race.nanosecondsPerTile(&Race::Lap::bins);
        state.counters["ns_a_tile"] = bins;
        state.counters["osg_ns"] = race.nanosecondsPerTile(&Race::Lap::singleTiles);
        state.counters["of_osgSphere"] = bins / race.nanosecondsPerTile(&Race::Lap::singleTiles);
        state.counters["of_osgSphere_siblings"] = bins / race.nanosecondsPerTile(&Race::Lap::siblings);
    }

    // All families of the mix, in another order every time: a branch predictor cannot learn it.
    template <class Test>
    [[nodiscard]] double seconds(std::size_t f, const FamilyMix& mix, std::uint64_t order, const Test& test) {
        static_assert((FamilyMix::kFamiliesPerFrustum & (FamilyMix::kFamiliesPerFrustum - 1)) == 0);
        Frustum& frustum = _scene.frusta[f];
        const std::uint32_t* families = mix.familiesOfFrustum[f].data();
        const std::size_t step = (order >> 32) | 1;
        std::size_t next = order;
        const auto start = std::chrono::steady_clock::now();
        std::uint64_t kept = 0;
        for (std::size_t i = 0; i < FamilyMix::kFamiliesPerFrustum; ++i, next += step) {
            kept += test(frustum, families[next % FamilyMix::kFamiliesPerFrustum]);
        }
        benchmark::DoNotOptimize(kept);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    [[nodiscard]] double secondsOfSingleTiles(std::size_t f, const FamilyMix& mix, std::uint64_t order) {
        static_assert((TileMix::kTilesPerFrustum & (TileMix::kTilesPerFrustum - 1)) == 0);
        Frustum& frustum = _scene.frusta[f];
        const std::uint32_t* families = mix.familiesOfFrustum[f].data();
        const std::size_t step = (order >> 32) | 1;
        std::size_t next = order;
        const auto start = std::chrono::steady_clock::now();
        std::size_t kept = 0;
        for (std::size_t i = 0; i < TileMix::kTilesPerFrustum; ++i, next += step) {
            const std::size_t tile = next % TileMix::kTilesPerFrustum;
            const osg::BoundingSphere& sphere =
                _spheres->spheres[kSiblings * families[tile / kSiblings] + tile % kSiblings];
            kept += frustum.polytope.contains(sphere) ? 1u : 0u;
        }
        benchmark::DoNotOptimize(kept);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    Random _random;
    FamilyScene _scene;
    FamilyMix _mostlyOutside;
    FamilyMix _halfOutside;
    std::shared_ptr<SpheresTest> _spheres;
};

}  // namespace

bool addFamilyBenchmarks() {
    static FamilySuite suite;
    return suite.add();
}

}  // namespace osgAnalyticBin::test
