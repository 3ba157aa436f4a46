// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle: the closed form of the bin's range (tested itself in EllipsoidTest). Ten million more pairs of bin and plane:
// Soundness.cpp. Of the range of the polynomial: the stationary points of the cube, its faces and its edges, solved in
// long double by elimination with pivoting, and its vertices.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

// Two evaluations of the same geometry from other numbers differ by a few roundings of coordinates near 7e6 m.
constexpr double kSameGeometry = 1e-7;

QuadraticBin quadratic(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin = 0.0) {
    return QuadraticBin(GeodeticMapping(ellipsoid), core::parameterBox(bin), margin);
}

// Wide and narrow beside the axis: a remainder that loses the smallest cosines fails here first.
TEST(QuadraticBin, DistanceRangeHoldsTheTrueRangeBesideTheAxis) {
    Random random(62);
    for (int trial = 0; trial < 100000; ++trial) {
        const double distance = random.logUniform(1e-13, 1e-5);
        const Interval latitude = random.chance(0.5)
                                      ? Interval{kHalfPi - distance, kHalfPi - random.uniform() * distance}
                                      : Interval{-kHalfPi, -kHalfPi + distance};
        const double west = random.uniform(-kPi, kPi);
        const GeodeticBin bin(latitude, {west, west + random.uniform(0.0, 2.0 * kPi)}, {0.0, random.uniform()});
        const BinOracle oracle(wgs84(), bin);
        const glm::dvec3 across = glm::normalize(random.direction() * glm::dvec3(1.0, 1.0, 1e-6));
        const Plane plane{across, 0.0};
        const Interval range = quadratic(wgs84(), bin).distanceRange(plane);
        ASSERT_TRUE(holds(range, oracle.distanceRange(plane), oracle.rounding(plane))) << distance;
    }
}

TEST(QuadraticBin, DecidesWhatItsDistanceRangeDecides) {
    Random random(63);
    for (int trial = 0; trial < 100000; ++trial) {
        const PlaneCase c(random);
        const QuadraticBin bin = quadratic(c.oracle.ellipsoid(), c.oracle.bin());
        const Interval range = bin.distanceRange(c.plane);
        if (std::min(std::abs(range.lower), std::abs(range.upper)) < kSameGeometry) continue;  // a tie
        const Side expected = range.upper < 0.0 ? Side::Outside : (range.lower > 0.0 ? Side::Inside : Side::Straddling);
        ASSERT_EQ(bin.classify(c.plane), expected) << nameOf(c.kind);
    }
}

// The excess of one side over the true range, per tile size, over random directions.
double largestExcess(Random& random, int level, Interval altitude, int trials) {
    double worst = 0.0;
    for (int trial = 0; trial < trials; ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, level, altitude));
        const Plane plane{random.direction(), 0.0};
        const Interval range = quadratic(wgs84(), oracle.bin()).distanceRange(plane);
        const RealRange truth = oracle.distanceRange(plane);
        const Real excess = std::max(truth.lower - range.lower, range.upper - truth.upper);
        worst = std::max(worst, static_cast<double>(excess));
    }
    return worst / (std::ldexp(kRootTileDeg, -level) * kRadiansPerDegree * wgs84().equatorialRadius());
}

// The largest excess of either end, as a share of the tile's size along the equator, with terrain's altitudes. High
// layers are looser: their remainder has altitude times angle squared.
TEST(QuadraticBin, IsTight) {
    Random random(65);
    std::printf("excess over the true range / tile size: altitudes %.0f .. %.0f m | %.0f .. %.0f m\n",
                kTerrainAltitudes.lower, kTerrainAltitudes.upper, kAllAltitudes.lower, kAllAltitudes.upper);
    for (int level = 0; level <= 6; ++level) {
        const double excess = largestExcess(random, level, kTerrainAltitudes, 40000);
        const double high = largestExcess(random, level, kAllAltitudes, 40000);
        std::printf("  %8.4f deg: %.5f %% | %.5f %%\n", std::ldexp(kRootTileDeg, -level), 100.0 * excess, 100.0 * high);
        EXPECT_LE(excess, level < 2 ? 0.03 : 0.002) << level;
    }
}

TEST(QuadraticBin, MarginWidensTheRangeByItself) {
    Random random(67);
    expectMarginToWidenTheRangeByItself(
        random, quadratic, [](const PlaneCase& c) { return 1e-15 * std::abs(c.plane.offset) + kSameGeometry; });
    for (int trial = 0; trial < 50000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const GeodeticBin bin = randomBin(random);
        const double margin = random.logUniform(1e-3, 1e5);
        const double widened = quadratic(ellipsoid, bin, margin).remainder() - quadratic(ellipsoid, bin).remainder();
        ASSERT_NEAR(widened, margin, 2e-9 * margin + kSameGeometry);
    }
}

TEST(QuadraticBin, PlaneWithoutNumbersIsUndecided) {
    expectPlanesWithoutNumbersToBeUndecided(quadratic);
}

TEST(QuadraticBin, NormalsMayBeOffByTheTolerance) {
    Random random(68);
    for (int trial = 0; trial < 50000; ++trial) {
        PlaneCase c(random);
        c.plane.normal *= 1.0 + random.sign() * 1e-9;
        // A margin of 1000 km makes the tolerance of the normal a millimetre.
        const double margin = random.chance(0.5) ? 0.0 : 1e6;
        const Interval range = quadratic(c.oracle.ellipsoid(), c.oracle.bin(), margin).distanceRange(c.plane);
        const RealRange truth = c.oracle.distanceRange(c.plane);
        const Real reach = margin * length(real(c.plane.normal));
        ASSERT_LE(range.lower, truth.lower - reach + c.oracle.rounding(c.plane)) << nameOf(c.kind);
        ASSERT_GE(range.upper, truth.upper + reach - c.oracle.rounding(c.plane)) << nameOf(c.kind);
    }
}

// Where N + h or M + h cancels, the bin is small beside the numbers that it is made of. Positions as deep have no
// closed form: the oracle is the corners of bins so small that nothing of them is farther out by more than rounding.
TEST(QuadraticBin, HoldsNearTheCentresOfCurvature) {
    constexpr double kThickness = 1e-3;
    Random random(75);
    std::array<int, 3> verdicts{};
    for (int trial = 0; trial < 200000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const double latitude = random.uniform(-kHalfPi, kHalfPi);
        const double sine = std::sin(latitude), cosine = std::cos(latitude);
        const double radius =
            random.chance(0.5) ? ellipsoid.primeVerticalRadius(sine, cosine) : ellipsoid.meridionalRadius(sine, cosine);
        const double altitude = random.sign() * random.logUniform(1e-9, 1e3) - radius;
        const double width = random.logUniform(1e-16, 1e-10);
        const double longitude = random.uniform(-kPi, kPi);
        const GeodeticBin bin({latitude, std::min(kHalfPi, latitude + width)}, {longitude, longitude + width},
                              {altitude, altitude + random.uniform() * kThickness});
        const auto corner = [&] {
            return geodeticToEcef(ellipsoid, random.chance(0.5) ? bin.latitude().lower : bin.latitude().upper,
                                  random.chance(0.5) ? bin.longitude().lower : bin.longitude().upper,
                                  random.chance(0.5) ? bin.altitude().lower : bin.altitude().upper);
        };
        Plane plane{random.direction(), 0.0};
        plane.offset =
            static_cast<double>(-exactDistance(plane, corner())) + random.sign() * random.logUniform(1e-12, 1e-6);
        const core::QuadraticOrExact either = core::quadraticOrExact(ellipsoid, bin);
        const Side eitherSide = std::visit([&](const auto& form) { return form.classify(plane); }, either);
        for (const Side side : {quadratic(ellipsoid, bin).classify(plane), eitherSide}) {
            ++verdicts[static_cast<std::size_t>(side)];
            for (int i = 0; i < 10; ++i) ASSERT_NO_FATAL_FAILURE(expectSideOf(plane, corner(), side, BinKind::Tiny));
        }
    }
    for (const int count : verdicts) EXPECT_GT(count, 1000) << "every verdict must occur, or nothing is tested";
}

using core::quadraticOrExact;

bool isExact(const core::QuadraticOrExact& bin) {
    return std::holds_alternative<core::ExactGeodeticBin>(bin);
}

TEST(QuadraticOrExact, WideTilesAreExactAndSmallOnesAreNot) {
    Random random(130);
    for (int trial = 0; trial < 2000; ++trial) {
        for (int level = 0; level <= kDeepestLevel; ++level) {
            const GeodeticBin bin = randomTile(random, level, kTerrainAltitudes);
            ASSERT_EQ(isExact(quadraticOrExact(wgs84(), bin)), level < 2) << level;
        }
    }
    EXPECT_TRUE(isExact(quadraticOrExact(wgs84(), GeodeticBin::wholeGlobe(kTerrainAltitudes))));
    // below the centres of curvature only the model holds
    EXPECT_FALSE(isExact(quadraticOrExact(wgs84(), GeodeticBin::wholeGlobe({-6.37e6, 0.0}))));
}

TEST(QuadraticOrExact, RangeExceedsTheTruthByTheStatedPartOfTheExtent) {
    Random random(131);
    double largest = 0.0;
    for (int trial = 0; trial < 200000; ++trial) {
        const BinOracle oracle(randomEllipsoid(random), randomBin(random));
        const Plane plane{random.direction(), 0.0};
        const Interval range = std::visit([&](const auto& form) { return form.distanceRange(plane); },
                                          quadraticOrExact(oracle.ellipsoid(), oracle.bin()));
        const RealRange truth = oracle.distanceRange(plane);
        ASSERT_TRUE(holds(range, truth, oracle.rounding(plane)));
        const double extent = sizeOf(oracle.ellipsoid(), oracle.bin()) * 1.1;
        const auto excess = static_cast<double>(std::max(truth.lower - range.lower, range.upper - truth.upper));
        ASSERT_LE(excess, 2.0 * core::kLargestRelativeRemainder * extent + 1e-6);
        if (extent > 1.0) largest = std::max(largest, (excess - 1e-6) / extent);
    }
    std::printf("largest excess: %.3f %% of the extent (promised %.3f %%)\n", 100.0 * largest,
                200.0 * core::kLargestRelativeRemainder);
}

using core::exactRange;
using core::Quadratic;

using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;

constexpr double kRangePromised = 64.0 * std::numeric_limits<double>::epsilon();  // by exactRange

Matrix matrixOf(const Quadratic& q) {
    const auto& h = q.hessian;
    return {{{h[0], h[3], h[4]}, {h[3], h[1], h[5]}, {h[4], h[5], h[2]}}};
}

Real valueAt(const Quadratic& q, const Vector& x) {
    const Matrix h = matrixOf(q);
    Real value = q.value;
    for (std::size_t i = 0; i < 3; ++i) {
        value += q.gradient[i] * x[i];
        for (std::size_t j = 0; j < 3; ++j) value += h[i][j] * x[i] * x[j] / 2;
    }
    return value;
}

double magnitudeOf(const Quadratic& q) {
    double sum = std::abs(q.value);
    for (const double g : q.gradient) sum += std::abs(g);
    for (const double h : q.hessian) sum += std::abs(h);
    return sum;
}

// Solves for the free coordinates of a stationary point, the others being fixed. False when singular.
bool stationary(const Quadratic& q, const std::array<bool, 3>& isFree, Vector& x) {
    const Matrix h = matrixOf(q);
    std::array<std::array<Real, 4>, 3> rows{};
    std::array<std::size_t, 3> unknown{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (isFree[i]) unknown[n++] = i;
    for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t c = 0; c < n; ++c) rows[r][c] = h[unknown[r]][unknown[c]];
        rows[r][n] = -static_cast<Real>(q.gradient[unknown[r]]);
        for (std::size_t j = 0; j < 3; ++j)
            if (!isFree[j]) rows[r][n] -= h[unknown[r]][j] * x[j];
    }
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < n; ++r)
            if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
        if (rows[pivot][c] == 0) return false;
        std::swap(rows[c], rows[pivot]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == c) continue;
            const Real factor = rows[r][c] / rows[c][c];
            for (std::size_t k = c; k <= n; ++k) rows[r][k] -= factor * rows[c][k];
        }
    }
    for (std::size_t r = 0; r < n; ++r) {
        x[unknown[r]] = rows[r][n] / rows[r][r];
        if (!(std::abs(x[unknown[r]]) <= 1 + 1e-6L)) return false;
        x[unknown[r]] = std::clamp<Real>(x[unknown[r]], -1, 1);
    }
    return true;
}

std::pair<Real, Real> solvedRange(const Quadratic& q) {
    Real lower = std::numeric_limits<Real>::infinity();
    Real upper = -lower;
    for (int code = 0; code < 27; ++code) {
        const std::array<int, 3> digit{code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
        Vector x{};
        std::array<bool, 3> isFree{};
        for (std::size_t i = 0; i < 3; ++i) {
            isFree[i] = digit[i] == 0;
            x[i] = static_cast<Real>(digit[i]);
        }
        if (!stationary(q, isFree, x)) continue;
        const Real value = valueAt(q, x);
        lower = std::min(lower, value);
        upper = std::max(upper, value);
    }
    return {lower, upper};
}

// H = sum of w v v', random v.
std::array<double, 6> hessianOf(Random& random, const std::array<double, 3>& weights) {
    std::array<double, 6> h{};
    for (const double weight : weights) {
        const glm::dvec3 v = random.direction();
        h[0] += weight * v.x * v.x;
        h[1] += weight * v.y * v.y;
        h[2] += weight * v.z * v.z;
        h[3] += weight * v.x * v.y;
        h[4] += weight * v.x * v.z;
        h[5] += weight * v.y * v.z;
    }
    return h;
}

// Definite; of rank one, two; nearly singular, as a whole and in a face; general; without a square of w; scaled; none.
constexpr int kShapes = 9;

std::array<double, 6> hessianOf(Random& random, int shape) {
    const double sign = random.sign();
    const auto weight = [&] { return random.logUniform(1e-3, 10.0); };
    const auto tiny = [&] { return sign * random.logUniform(1e-18, 1e-3); };
    if (shape == 0) return hessianOf(random, {sign * weight(), sign * weight(), sign * weight()});
    if (shape == 1) return hessianOf(random, {sign * weight(), 0.0, 0.0});
    if (shape == 2) return hessianOf(random, {sign * weight(), random.sign() * weight(), 0.0});
    if (shape == 3) return hessianOf(random, {sign * weight(), tiny(), tiny()});
    std::array<double, 6> h{};
    if (shape == 4) {
        h = hessianOf(random, {sign * weight(), tiny(), 0.0});
        h[2] = h[4] = h[5] = 0.0;
    }
    if (shape == 4 || shape == 8) return h;
    for (double& x : h) x = random.uniform(-1.0, 1.0) * (shape == 7 ? random.logUniform(1e-12, 1e6) : 1.0);
    if (random.chance(0.2)) h[static_cast<std::size_t>(random.integer(0, 5))] = 0.0;
    if (shape == 6) h[2] = 0.0;
    return h;
}

// Half of the polynomials have their stationary point at a chosen place: inside, on, or just beside the box.
Quadratic randomQuadratic(Random& random) {
    Quadratic q;
    q.value = random.uniform(-1.0, 1.0);
    q.hessian = hessianOf(random, random.integer(0, kShapes - 1));
    if (random.chance(0.05)) return q;
    if (random.chance(0.5)) {
        for (double& g : q.gradient) g = random.uniform(-1.0, 1.0) * random.logUniform(1e-3, 3.0);
        return q;
    }
    Vector x{};
    for (Real& c : x)
        c = random.chance(0.3) ? random.sign() * (1.0 + random.sign() * random.logUniform(1e-17, 1e-3))
                               : random.uniform(-1.2, 1.2);
    const Matrix h = matrixOf(q);
    for (std::size_t i = 0; i < 3; ++i)
        q.gradient[i] = -static_cast<double>(h[i][0] * x[0] + h[i][1] * x[1] + h[i][2] * x[2]);
    return q;
}

TEST(QuadraticRange, MatchesAllStationaryPointsInLongDouble) {
    Random random(51);
    Real worst = 0;
    for (int trial = 0; trial < 200000; ++trial) {
        const Quadratic q = randomQuadratic(random);
        const Interval range = exactRange(q);
        const auto [lower, upper] = solvedRange(q);
        const Real error = std::max(std::abs(range.lower - lower), std::abs(range.upper - upper));
        worst = std::max(worst, error / magnitudeOf(q));
        ASSERT_LE(error, kRangePromised * magnitudeOf(q))
            << "hessian " << q.hessian[0] << ' ' << q.hessian[1] << ' ' << q.hessian[2] << ' ' << q.hessian[3] << ' '
            << q.hessian[4] << ' ' << q.hessian[5];
    }
    std::printf("exact range: off by at most %.2f epsilon times the magnitude (promised 64)\n",
                static_cast<double>(worst) / std::numeric_limits<double>::epsilon());
}

}  // namespace
}  // namespace osgAnalyticBin::test
