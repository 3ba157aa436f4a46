// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Counts wrong verdicts of every method over millions of random pairs of bin and plane, a third of them nearly
// tangent. The truth is the closed form in long double, which shares no code with the core. Fails when the quadratic or
// the exact bin has a single wrong verdict, or a distance range that does not hold the true one.

#include "ComparisonBins.h"
#include "LongRun.h"

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {
using core::ExactGeodeticBin;
using core::GeodeticBin;
using core::GeodeticMapping;
using core::Interval;
using core::ParameterBox;
using core::Plane;
using core::QuadraticBin;
using core::Side;
using rivals::CornersBin;
using rivals::PaperBin;

constexpr std::uint64_t kTrialsPerChunk = 20000;
constexpr std::size_t kPlanesPerBin = 4;
// The comparison rules are blamed for more than rounding only, in metres.
constexpr Real kComparisonTolerance = 1e-6L;

struct Verdicts {
    std::uint64_t falseOutside = 0;
    std::uint64_t falseInside = 0;
    std::uint64_t undecided = 0;  // straddling, though the bin is on one side

    // Outside claims that all distances are negative, Inside that none is; the truth is known to `tolerance`.
    void note(Side side, const RealRange& truth, Real tolerance) {
        if (side == Side::Outside && truth.upper >= tolerance) ++falseOutside;
        if (side == Side::Inside && truth.lower < -tolerance) ++falseInside;
        if (side == Side::Straddling && (truth.upper < -tolerance || truth.lower > tolerance)) ++undecided;
    }

    [[nodiscard]] std::uint64_t wrong() const { return falseOutside + falseInside; }

    void add(const Verdicts& other) {
        falseOutside += other.falseOutside;
        falseInside += other.falseInside;
        undecided += other.undecided;
    }
};

// A method whose verdicts are proofs.
struct SoundMethod {
    Verdicts verdicts;
    std::uint64_t openRanges = 0;                                // distance ranges that do not hold the true range
    Real smallestSlack = std::numeric_limits<Real>::infinity();  // by which they do, in metres

    // Returns: false when something is wrong.
    bool note(Side side, const Interval& range, const RealRange& truth, Real rounding) {
        const std::uint64_t before = verdicts.wrong();
        verdicts.note(side, truth, rounding);
        const Real slack = std::min(truth.lower - range.lower, range.upper - truth.upper);
        const bool open = slack < -rounding;
        openRanges += open ? 1 : 0;
        smallestSlack = std::min(smallestSlack, slack);
        return !open && verdicts.wrong() == before;
    }

    void add(const SoundMethod& other) {
        verdicts.add(other.verdicts);
        openRanges += other.openRanges;
        smallestSlack = std::min(smallestSlack, other.smallestSlack);
    }

    [[nodiscard]] bool isSound() const { return verdicts.wrong() == 0 && openRanges == 0; }
};

struct Sums {
    std::uint64_t trials = 0;
    std::uint64_t decided = 0;  // planes that the bin truly does not cross
    SoundMethod quadratic, exact;
    Verdicts paper, corners;

    void add(const Sums& other) {
        trials += other.trials;
        decided += other.decided;
        quadratic.add(other.quadratic);
        exact.add(other.exact);
        paper.add(other.paper);
        corners.add(other.corners);
    }
};

// Tiles of every level first, then the kinds of bin that are no tiles.
constexpr std::size_t kLevels = kDeepestLevel + 1;
constexpr std::size_t kKinds = kLevels + kBinKinds.size() - 1;

GeodeticBin binOfKind(Random& random, std::size_t kind) {
    if (kind >= kLevels) return randomBin(random, kBinKinds[kind - kLevels + 1]);
    return randomTile(random, static_cast<int>(kind), randomAltitude(random));
}

void report(const char* what, const BinOracle& oracle, const Plane& plane) {
    const GeodeticBin& bin = oracle.bin();
    std::printf(
        "%s: a %.17g b %.17g lat %.17g %.17g lon %.17g %.17g alt %.17g %.17g normal %.17g %.17g %.17g offset %.17g\n",
        what, oracle.ellipsoid().equatorialRadius(), oracle.ellipsoid().polarRadius(), bin.latitude().lower,
        bin.latitude().upper, bin.longitude().lower, bin.longitude().upper, bin.altitude().lower, bin.altitude().upper,
        plane.normal.x, plane.normal.y, plane.normal.z, plane.offset);
}

void tryOneBin(Random& random, std::size_t kind, Sums& sums) {
    const BinOracle oracle(randomEllipsoid(random), binOfKind(random, kind));
    const GeodeticMapping mapping(oracle.ellipsoid());
    const ParameterBox box = core::parameterBox(oracle.bin());
    const QuadraticBin quadratic(mapping, box);
    const ExactGeodeticBin exact(oracle.ellipsoid(), oracle.bin());
    const PaperBin paper(mapping, box);
    const CornersBin corners(mapping, box);
    for (std::size_t i = 0; i < kPlanesPerBin; ++i) {
        const Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const RealRange truth = oracle.distanceRange(plane);
        const Real rounding = oracle.rounding(plane);
        const bool quadraticHolds =
            sums.quadratic.note(quadratic.classify(plane), quadratic.distanceRange(plane), truth, rounding);
        const bool exactHolds = sums.exact.note(exact.classify(plane), exact.distanceRange(plane), truth, rounding);
        if (!quadraticHolds) report("quadratic", oracle, plane);
        if (!exactHolds) report("exact", oracle, plane);
        sums.paper.note(paper.classify(plane), truth, kComparisonTolerance);
        sums.corners.note(corners.classify(plane), truth, kComparisonTolerance);
        ++sums.trials;
        sums.decided += truth.upper < 0 || truth.lower >= 0 ? 1 : 0;
    }
}

void check(Random& random, std::uint64_t trials, Sums& sums) {
    for (std::uint64_t i = 0; i < trials; i += kPlanesPerBin) tryOneBin(random, (i / kPlanesPerBin) % kKinds, sums);
}

// False verdicts; undecided planes among those that miss the bin; the least by which distance ranges hold the true one.
bool printSound(const char* name, const SoundMethod& method, std::uint64_t decided) {
    const double loose = 100.0 * static_cast<double>(method.verdicts.undecided) / static_cast<double>(decided);
    std::printf("%-9s false outside %" PRIu64 ", false inside %" PRIu64
                ", undecided %.2f %%, slack %.2Lg m; distance "
                "ranges that do not hold the truth: %" PRIu64 ": %s\n",
                name, method.verdicts.falseOutside, method.verdicts.falseInside, loose, method.smallestSlack,
                method.openRanges, method.isSound() ? "sound" : "UNSOUND");
    return method.isSound();
}

int run(int argc, char** argv) {
    const auto run = longRunOf(argc, argv);
    if (!run) return EXIT_FAILURE;
    const Stopwatch watch;
    const Sums sums = runChunks<Sums>(*run, kTrialsPerChunk, check);
    const bool isQuadraticSound = printSound("quadratic", sums.quadratic, sums.decided);
    const bool isExactSound = printSound("exact", sums.exact, sums.decided);
    for (const auto& [name, rule] : {std::pair("paper", &sums.paper), {"corners", &sums.corners}})
        std::printf("%-9s false outside %" PRIu64 ", false inside %" PRIu64 "\n", name, rule->falseOutside,
                    rule->falseInside);
    std::printf("%" PRIu64 " trials, seed %" PRIu64 ", %u threads, %.1f s\n", run->trials, run->seedValue, run->threads,
                watch.seconds());
    return isQuadraticSound && isExactSound ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace osgAnalyticBin::test

int main(int argc, char** argv) {
    return osgAnalyticBin::test::run(argc, argv);
}
