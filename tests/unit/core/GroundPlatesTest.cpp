// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CoreTest.h"
#include "OcclusionScene.h"

namespace osgAnalyticBin::test {
namespace {

constexpr std::array<std::size_t, 4> kGrids{1, 2, 4, 8};

GeodeticBin randomExtentsInMap(Random& random) {
    constexpr double kUnits = Ellipsoid::kMapUnitsInRadian;
    const double height = random.logUniform(1.0, 1e6), width = height * random.uniform(0.3, 3.0);
    const double south = random.uniform(-1e7, 1e7), west = random.uniform(-6e7, 6e7);
    const double relief = height * random.logUniform(1e-4, 0.3);
    return GeodeticBin({south / kUnits, (south + height) / kUnits}, {west / kUnits, (west + width) / kUnits},
                       {-relief, relief});
}

GeodeticBin randomExtents(Random& random, const Ellipsoid& ellipsoid) {
    if (ellipsoid.isPlane()) return randomExtentsInMap(random);
    const double size = random.logUniform(1e-6, 0.3);
    const double south = random.uniform(-1.5, 1.5 - size);
    const double west = random.chance(0.2) ? 3.14159 - 0.5 * size : random.uniform(-3.2, 3.2);
    const double relief = size * ellipsoid.equatorialRadius() * random.logUniform(1e-4, 0.3);
    const double wider = std::min(random.uniform(0.5, 2.0) / std::cos(south + 0.5 * size), 1.5 / size);
    return GeodeticBin({south, south + size}, {west, west + size * wider}, {-relief, relief});
}

RealVector randomPointOf(Random& random, const EarthColumn& column) {
    std::array<Real, 8> weights{};
    Real sum = 0;
    for (Real& weight : weights) sum += weight = random.chance(0.5) ? 0 : random.uniform();
    if (sum == 0) return real(column.top[0]);
    RealVector point{};
    for (std::size_t i = 0; i < 8; ++i)
        point = point + weights[i] / sum * real(i < 4 ? column.top[i] : column.bottom[i - 4]);
    return point;
}

// Whether the ellipsoid's normal through a point meets a triangle above it. The point may be too high by `room` metres.
bool isBelow(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const RealVector& point, Real room) {
    RealVector up{0, 0, 1};
    if (!ellipsoid.isPlane()) {
        const RealGeodetic at = ecefToGeodetic(ellipsoid, point);
        up = {std::cos(at.latitude) * std::cos(at.longitude), std::cos(at.latitude) * std::sin(at.longitude),
              std::sin(at.latitude)};
    }
    const Real high = static_cast<Real>(ellipsoid.equatorialRadius());
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
        if (meets(triangleAt(mesh, i), point + (-room) * up, point + high * up)) return true;
    return false;
}

std::vector<EarthColumn> columnsOf(const GroundPlates& plates, std::size_t cells, double depth) {
    std::vector<EarthColumn> columns;
    core::EarthColumns some;
    for (std::size_t quarter = 0; quarter < (cells == 1 ? 1 : 4); ++quarter) {
        plates.columns(cells, cells, quarter, depth, 0.0, core::Frame(), some);
        for (std::size_t i = 0; i < some.size; ++i)
            if (!std::isnan(some.error[i])) columns.push_back(columnOf(some, i));
    }
    return columns;
}

void turnOver(EcefMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i], mesh.triangles[i + 1]);
}

void expectBelow(Random& random, const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GroundPlates& plates,
                 int& known) {
    for (const std::size_t cells : kGrids) {
        const double depth = random.uniform(0.0, 0.05) * ellipsoid.equatorialRadius();
        for (const EarthColumn& column : columnsOf(plates, cells, depth)) {
            ++known;
            for (int trial = 0; trial < 4; ++trial) {
                ASSERT_TRUE(isBelow(ellipsoid, mesh, randomPointOf(random, column), 2.0 * column.error))
                    << "known cell " << known << ", in a grid of " << cells << " x " << cells;
            }
        }
    }
}

TEST(GroundPlates, ColumnsLieBelowTheMesh) {
    Random random(1701);
    for (const bool isMap : {false, true}) {
        int known = 0;
        for (int trial = 0; trial < 800; ++trial) {
            Ellipsoid ellipsoid = Ellipsoid::plane();
            if (!isMap) ellipsoid = random.chance(0.5) ? wgs84() : Ellipsoid(1e5, 1e5 * random.uniform(0.996, 1.004));
            const GeodeticBin extents = randomExtents(random, ellipsoid);
            const auto cells = static_cast<std::uint32_t>(random.integer(1, 12));
            EcefMesh mesh = gridMesh(random, ellipsoid, extents, cells);
            // nearly a grid
            const double most =
                extents.latitude().width() / cells * ellipsoid.polarRadius() * random.logUniform(1e-7, 0.1);
            for (std::size_t i = random.chance(0.5) ? 0 : mesh.size(); i < mesh.size(); ++i)
                moveVertex(mesh, i, random.uniform(0.0, most) * random.direction());
            if (random.chance(0.3)) mesh = unmerged(mesh);
            if (random.chance(0.3)) turnOver(mesh);
            expectBelow(random, ellipsoid, mesh, platesOf(ellipsoid, mesh, extents), known);
        }
        EXPECT_GT(known, 800 * 40) << isMap;
    }
}

// A fold has faces that look down between those that look up.
TEST(GroundPlates, ColumnsLieBelowTheMeshWhereItHasFolds) {
    Random random(1702);
    int known = 0, folded = 0;
    for (int trial = 0; trial < 800; ++trial) {
        const Ellipsoid ellipsoid = wgs84();
        const GeodeticBin extents = randomExtents(random, ellipsoid);
        const auto cells = static_cast<std::uint32_t>(random.integer(3, 12));
        EcefMesh mesh = gridMesh(random, ellipsoid, extents, cells);
        const double cell = extents.latitude().width() / cells * ellipsoid.polarRadius();
        for (int i = random.integer(1, 4); i > 0; --i) {
            const auto row = static_cast<std::size_t>(random.integer(1, static_cast<int>(cells) - 1));
            const auto column = static_cast<std::size_t>(random.integer(1, static_cast<int>(cells) - 1));
            moveVertex(mesh, row * (cells + 1) + column, random.uniform(0.0, 3.0) * cell * random.direction());
        }
        const GroundPlates plates = platesOf(ellipsoid, mesh, extents);
        expectBelow(random, ellipsoid, mesh, plates, known);
        folded += plates.isKnown() ? 1 : 0;
    }
    EXPECT_GT(known, 800 * 10);
    EXPECT_GT(folded, 200);
}

// A long side that ends just south of a cell bulges into it, and the triangle below is steep.
TEST(GroundPlates, ColumnsLieBelowTrianglesThatBulgeTowardsThePole) {
    Random random(1709);
    const Ellipsoid earth = wgs84();
    const double middle = 1.05, half = 0.008, rim = half / 256.0, west = 0.3, width = 0.032;
    const GeodeticBin extents({middle - half, middle + half}, {west, west + width}, {0.0, 0.0});
    EcefMesh mesh;
    // the ends of the long side, then the southern and the northern rim
    for (const double side : {0.0, 1.0}) addVertex(mesh, earth.toEcef({middle + 0.49 * rim, west + side * width, 0.0}));
    for (const double end : {-half, half}) {
        for (int i = 0; i <= 8; ++i)
            addVertex(mesh, earth.toEcef({middle + end, west + i / 8.0 * width, end < 0.0 && i == 4 ? -5e4 : 0.0}));
    }
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.triangles.insert(mesh.triangles.end(), {2 + i, 3 + i, i / 4, 12 + i, 11 + i, i / 4});
    mesh.triangles.insert(mesh.triangles.end(), {1, 0, 6, 0, 1, 15});
    int known = 0;
    for (int trial = 0; trial < 50; ++trial) expectBelow(random, earth, mesh, platesOf(earth, mesh, extents), known);
    EXPECT_GT(known, 50 * 30);
}

// A triangle that is missing, that is turned over, or that lies on another one in place of its own.
TEST(GroundPlates, AreNotKnownWhereTheMeshHasAHole) {
    Random random(1703);
    for (int trial = 0; trial < 800; ++trial) {
        const Ellipsoid ellipsoid = wgs84();
        const GeodeticBin extents = randomExtents(random, ellipsoid);
        EcefMesh mesh = gridMesh(random, ellipsoid, extents, static_cast<std::uint32_t>(random.integer(2, 12)));
        const int triangles = static_cast<int>(mesh.triangles.size() / 3);
        const int hole = random.integer(0, triangles - 1);
        const auto at = mesh.triangles.begin() + 3 * hole;
        const int kind = random.integer(0, 2);
        if (kind == 0) mesh.triangles.erase(at, at + 3);
        if (kind == 1) std::swap(at[0], at[1]);
        if (kind == 2) std::copy_n(mesh.triangles.begin() + 3 * ((hole + 1) % triangles), 3, at);
        ASSERT_FALSE(platesOf(ellipsoid, mesh, extents).isKnown()) << "kind " << kind << ", triangle " << hole;
    }
}

// A lens in the air has a mesh above its middle, closed all round, and none beside it.
TEST(GroundPlates, ClosedMeshesCoverNothing) {
    const Ellipsoid earth = wgs84();
    const GeodeticBin extents({0.5, 0.51}, {1.0, 1.01}, {0.0, 200.0});
    EcefMesh mesh;
    constexpr std::uint32_t kCorners = 6;
    addVertex(mesh, earth.toEcef({0.5051, 1.0051, 200.0}));
    addVertex(mesh, earth.toEcef({0.5051, 1.0051, 100.0}));
    for (std::uint32_t i = 0; i < kCorners; ++i) {
        const double angle = 1.04719755 * i;
        addVertex(mesh, earth.toEcef({0.5051 + 0.0004 * std::sin(angle), 1.0051 + 0.0004 * std::cos(angle), 150.0}));
        const std::uint32_t a = 2 + i, b = 2 + (i + 1) % kCorners;
        mesh.triangles.insert(mesh.triangles.end(), {0, a, b, 1, b, a});
    }
    EXPECT_FALSE(platesOf(earth, mesh, extents).isKnown());
}

// Triangles at a pole's vertex run around the axis, whatever longitudes the tile has.
TEST(GroundPlates, ColumnsLieBelowTheMeshWhereItEndsInAPole) {
    Random random(1708);
    int known = 0;
    for (const double west : {-3.14159, 0.3, 3.06, 3.3, 6.0, 31.0}) {
        for (const double off : {0.0, 4e-10, 1e-3}) {
            const Ellipsoid earth = wgs84();
            const GeodeticBin extents({1.4, 1.5707963267948966}, {west, west + 0.17}, {-100.0, 100.0});
            EcefMesh mesh = gridMesh(random, earth, GeodeticBin({1.4, 1.57}, extents.longitude(), {0.0, 0.0}), 24);
            const std::uint32_t pole = static_cast<std::uint32_t>(mesh.size());
            const glm::dvec3 away = off * random.direction();
            addVertex(mesh, glm::dvec3(away.x, away.y, earth.polarRadius() - 3000.0));
            for (std::uint32_t i = 0; i < 24; ++i)
                mesh.triangles.insert(mesh.triangles.end(), {24 * 25 + i, 24 * 25 + i + 1, pole});
            expectBelow(random, earth, mesh, platesOf(earth, mesh, extents), known);
        }
    }
    EXPECT_GT(known, 6 * 3 * 20);
}

TEST(GroundPlates, AreAsHighAsTheLowestPostOfEachCell) {
    constexpr std::uint32_t kPostsOfCell = 4;
    Random random(1703);
    const Ellipsoid earth = wgs84();
    for (int trial = 0; trial < 20; ++trial) {
        const double size = random.logUniform(1e-5, 0.02), south = random.uniform(-1.0, 1.0), relief = 1e5 * size;
        const GeodeticBin extents({south, south + size}, {1.0, 1.0 + size}, {-0.1 * relief, relief});
        const std::uint32_t posts = 8 * kPostsOfCell;
        const EcefMesh mesh = gridMesh(random, earth, extents, posts);
        const GroundPlates plates = platesOf(earth, mesh, extents);
        const double sag = 6.4e6 * (size / posts) * (size / posts);
        const double rounding = 1e-3 + 2.0 * 1.1 * relief / 65533.0;
        for (std::uint32_t cell = 0; cell < 64; ++cell) {
            double lowest = std::numeric_limits<double>::infinity();
            for (std::uint32_t i = 0; i <= kPostsOfCell; ++i) {
                for (std::uint32_t j = 0; j <= kPostsOfCell; ++j) {
                    const std::uint32_t row = cell / 8 * kPostsOfCell + i, column = cell % 8 * kPostsOfCell + j;
                    lowest = std::min(lowest, earth.toGeodetic(mesh.vertex(row * (posts + 1) + column)).altitude);
                }
            }
            EXPECT_NEAR(plates.least(8, cell / 8, cell % 8), lowest, sag + rounding);
        }
    }
}

TEST(GroundPlates, ColumnsOfFinerCellsAreThoseThatStandOut) {
    Random random(1738);
    const GroundPlates plates = platesOf(wgs84(), gridMesh(random, wgs84(), kHills, 16), kHills);
    core::EarthColumns all, some;
    for (const double worth : {0.0, 100.0, 1e9}) {
        for (std::size_t quarter = 0; quarter < 4; ++quarter) {
            std::size_t expected = 1;
            for (const std::size_t cells : {std::size_t{4}, std::size_t{8}}) {
                for (std::size_t i = 0; i < cells * cells / 4; ++i) {
                    const std::size_t row = quarter / 2 * cells / 2 + i / (cells / 2);
                    const std::size_t column = quarter % 2 * cells / 2 + i % (cells / 2);
                    const double above = plates.least(cells / 2, row / 2, column / 2);
                    expected += plates.least(cells, row, column) > above + worth ? 1U : 0U;
                }
            }
            plates.columns(8, 2, quarter, 1e3, worth, core::Frame(), some);
            EXPECT_EQ(some.size, expected);
            plates.columns(8, 2, quarter, 1e3, -HUGE_VAL, core::Frame(), all);
            EXPECT_EQ(all.size, 21);
            for (std::size_t i = 0, at = 0; i < some.size; ++i, ++at) {
                // the same in the same order
                while (at < all.size && columnOf(all, at).top != columnOf(some, i).top) ++at;
                EXPECT_LT(at, all.size);
            }
        }
    }
}

TEST(GroundPlates, ColumnsOfAGridLieBelowTheMeshWithEitherDiagonal) {
    Random random(1712);
    int known = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Ellipsoid ellipsoid = random.chance(0.5) ? wgs84() : Ellipsoid(1e5, 1e5 * random.uniform(0.996, 1.004));
        const GeodeticBin extents = randomExtents(random, ellipsoid);
        const auto cells = static_cast<std::uint32_t>(random.integer(2, 24));
        EcefMesh mesh = gridMesh(random, ellipsoid, extents, cells);
        // drawn a little beside its place
        const double room = random.uniform(0.0, 1e-4) * extents.latitude().width() * ellipsoid.polarRadius();
        const double margin = random.chance(0.5) ? room : 0.0;
        const glm::dvec3 aside = margin * random.direction();
        const GroundPlates plates = gridPlatesOf(ellipsoid, mesh, extents, cells, margin);
        for (std::size_t i = 0; i < mesh.size(); ++i) moveVertex(mesh, i, aside);
        expectBelow(random, ellipsoid, mesh, plates, known);
    }
    EXPECT_GT(known, 300 * 30);
}

// Up to the rise within one cell between posts, which counts with either diagonal.
TEST(GroundPlates, OfAGridAreThoseOfItsMesh) {
    Random random(1713);
    const Ellipsoid earth = wgs84();
    for (int trial = 0; trial < 50; ++trial) {
        const double size = random.logUniform(1e-3, 0.02);
        const double south = random.uniform(-1.0, 1.0);
        const GeodeticBin extents({south, south + size}, {1.0, 1.0 + size}, {-20.0, 30.0});
        const auto cells = static_cast<std::uint32_t>(random.integer(8, 64));
        const EcefMesh mesh = gridMesh(random, earth, extents, cells);
        // without vertices in common it is not known to be a grid
        const GroundPlates ofMesh = platesOf(earth, unmerged(mesh), extents),
                           ofGrid = gridPlatesOf(earth, mesh, extents, cells);
        const double spacing = size / cells * 6.4e6;
        for (const std::size_t side : kGrids) {
            for (std::size_t i = 0; i < side * side; ++i) {
                const double difference =
                    ofMesh.least(side, i / side, i % side) - ofGrid.least(side, i / side, i % side);
                EXPECT_GE(difference, -1e-2);
                EXPECT_LE(difference, (side == 1 ? 0.0 : 50.0) + spacing * spacing / 6.3e6 + 1e-2);
            }
        }
    }
}

TEST(GroundPlates, OfAGridAreNotKnownBeyondTheirDomain) {
    const Ellipsoid earth = wgs84();
    const auto isKnown = [&](const Interval& latitude, double width, std::size_t posts, double rise) {
        const core::GeodeticGrid grid{latitude, {1.0, 1.0 + width}, posts, posts};
        std::vector<double> altitudes(posts * posts, 100.0);
        altitudes[posts + 1] += rise;
        const bool known = GroundPlates(earth, grid, altitudes).isKnown();
        altitudes[posts * posts - 1] = std::nan("");
        EXPECT_FALSE(GroundPlates(earth, grid, altitudes).isKnown());
        return known;
    };
    EXPECT_TRUE(isKnown({0.5, 0.501}, 0.001, 3, 1000.0));
    EXPECT_FALSE(isKnown({0.5, 0.501}, 0.001, 2, 0.0));  // no post within
    EXPECT_FALSE(isKnown({0.5, 0.51}, 0.0, 9, 0.0));
    EXPECT_FALSE(isKnown({1.5, 1.5707963267948966}, 0.05, 33, 0.0));  // at the pole
    EXPECT_TRUE(isKnown({1.4, 1.45}, 0.05, 33, 0.0));
    EXPECT_FALSE(isKnown({0.5, 0.53}, 0.03, 4, 0.0));  // chords cut the rims
    EXPECT_TRUE(isKnown({0.5, 0.53}, 0.03, 16, 0.0));
    EXPECT_FALSE(isKnown({0.5, 0.9}, 0.4, 4, 0.0));  // too far apart
    EXPECT_TRUE(isKnown({0.5, 0.9}, 0.4, 64, 0.0));
    EXPECT_TRUE(isKnown({0.5, 0.5 + 1e-5}, 1e-5, 33, 50.0));
    EXPECT_FALSE(isKnown({0.5, 0.51}, 0.01, 9, 1e6));
}

TEST(GroundPlates, AreLowerByTheMarginOfTheMesh) {
    Random random(1710);
    const EcefMesh mesh = gridMesh(random, wgs84(), kHills, 16);
    const GroundPlates exact = platesOf(wgs84(), mesh, kHills), drawn = platesOf(wgs84(), mesh, kHills, 5.0);
    EXPECT_LE(drawn.least(8, 3, 4), exact.least(8, 3, 4) - 4.9);
    EXPECT_TRUE(drawn.isKnown());
    // a tenth of a rim is 11 m along the meridian; some are kept in reserve
    EXPECT_TRUE(platesOf(wgs84(), mesh, kHills, 8.5).isKnown());
    EXPECT_FALSE(platesOf(wgs84(), mesh, kHills, 13.0).isKnown());
}

TEST(GroundPlates, AreNotKnownWhereNoColumnFits) {
    Random random(1704);
    const Ellipsoid earth = wgs84();
    const auto isKnown = [&](const Ellipsoid& ellipsoid, const GeodeticBin& extents) {
        return !columnsOf(platesOf(ellipsoid, gridMesh(random, ellipsoid, extents, 32), extents), 8, 100.0).empty();
    };
    const Interval flat{0.0, 0.0};
    EXPECT_TRUE(isKnown(earth, GeodeticBin({0.5, 0.6}, {0.0, 0.1}, flat)));
    EXPECT_FALSE(isKnown(earth, GeodeticBin({1.57, 1.5707}, {0.0, 1.5}, flat)));  // beside a pole
    EXPECT_FALSE(isKnown(earth, GeodeticBin({0.5, 0.6}, {0.0, 4.0}, flat)));
    EXPECT_FALSE(isKnown(Ellipsoid(6e6, 5e6), GeodeticBin({0.5, 0.6}, {0.0, 0.1}, flat)));
    EXPECT_FALSE(isKnown(earth, GeodeticBin({0.5, 0.6}, {0.0, 0.1}, {1e6, 1e6})));
    EXPECT_TRUE(columnsOf(GroundPlates(), 1, 100.0).empty());
    const GeodeticBin plain({0.5, 0.6}, {0.0, 0.1}, flat);
    const GroundPlates known = platesOf(earth, gridMesh(random, earth, plain, 8), plain);
    EXPECT_TRUE(std::isfinite(known.least(8, 4, 4)));
    EXPECT_TRUE(columnsOf(known, 8, 1e6).empty());
    EXPECT_TRUE(columnsOf(known, 8, std::nan("")).empty());
}

// Oracle: positions in long double. Both sines and cosines of sums, and products, are rounded.
TEST(GroundPlates, CornersOfColumnsAreWrongByTheirErrorAtMost) {
    Random random(1721);
    constexpr Real kRim = 1.0L / 64;
    Real worst = 0;
    int wide = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Ellipsoid ellipsoid = trial % 4 == 3 ? Ellipsoid::plane() : wgs84();
        // the widest tiles that have columns are worst for the series of sines and cosines
        const double south = random.uniform(-1.0, 0.0), west = random.uniform(-3.0, 2.0);
        const GeodeticBin widest({south, south + 0.999}, {west, west + 0.8}, {-1e3, 1e3});
        const GeodeticBin extents = trial % 4 == 0 ? widest : randomExtents(random, ellipsoid);
        const EcefMesh mesh = gridMesh(random, ellipsoid, extents, 16);
        const GroundPlates plates = platesOf(ellipsoid, mesh, extents);
        const core::Frame frame =
            randomFrame(random, ellipsoid.toEcef({extents.latitude().lower, extents.longitude().upper, 100.0}));
        const std::size_t cells = random.pick(kGrids), quarter = static_cast<std::size_t>(random.integer(0, 3));
        const std::size_t half = cells / 2, here = std::max<std::size_t>(half, 1);
        const double depth = 1e-3 * ellipsoid.equatorialRadius();
        core::EarthColumns columns;
        plates.columns(cells, cells, quarter, depth, 0.0, frame, columns);
        for (std::size_t i = 0; i < columns.size; ++i) {
            if (std::isnan(columns.error[i])) continue;
            wide += trial % 4 == 0;
            const EarthColumn column = columnOf(columns, i);
            const std::size_t row = quarter / 2 * half + i / here, east = quarter % 2 * half + i % here;
            for (std::size_t corner = 0; corner < 8; ++corner) {
                const auto at = [&](const Interval& range, std::size_t cell, bool isUpper) {
                    const Real inCell = isUpper ? 1 - kRim : kRim;
                    return Real{range.lower} + (Real{range.upper} - range.lower) * (cell + inCell) / cells;
                };
                const Real p = at(extents.latitude(), row, corner / 2 % 2 == 1);
                const Real l = at(extents.longitude(), east, corner % 2 == 1);
                const double high = plates.least(cells, row, east), h = corner < 4 ? high : high - depth;
                constexpr Real kUnits = Ellipsoid::kMapUnitsInRadian;
                const RealVector place =
                    ellipsoid.isPlane() ? RealVector{kUnits * l, kUnits * p, h} : geodeticToEcef(ellipsoid, p, l, h);
                const RealVector from = place - real(frame.origin);
                const glm::dvec3& computed = corner < 4 ? column.top[corner] : column.bottom[corner - 4];
                const std::array<glm::dvec3, 3> axes{frame.x, frame.y, frame.z};
                for (int axis = 0; axis < 3; ++axis) {
                    const Real wrong =
                        std::abs(dot(from, real(axes[static_cast<std::size_t>(axis)])) - Real{computed[axis]});
                    ASSERT_LE(wrong, column.error) << "trial " << trial;
                    worst = std::max(worst, wrong / column.error);
                }
            }
        }
    }
    std::printf("%.2Lf of the error at most, %d columns of the widest tiles\n", worst, wide);
    EXPECT_GT(wide, 1000);
}

// Some triangles more: GroundPlates.AreNotKnownWhereTheMeshHasAHole. OpenGL does not draw a mesh from above whose front
// faces look down, when it culls back faces.
TEST(GroundPlates, NothingIsKnownWhereATriangleIsWrong) {
    Random random(1714);
    const Ellipsoid earth = wgs84();
    const EcefMesh whole = gridMesh(random, earth, kHills, 16);
    EcefMesh withLine = whole, withMore = whole, turned = whole, shorter = whole;
    withLine.triangles.insert(withLine.triangles.end(), {5, 5, 9});
    withMore.triangles.insert(withMore.triangles.end(), {0, 2, 34});
    turnOver(turned);
    EXPECT_FALSE(platesOf(earth, turned, kHills).isKnown());
    const auto isWhole = [&](const EcefMesh& mesh) {
        return std::isfinite(platesOf(earth, mesh, kHills).least(1, 0, 0));
    };
    EXPECT_TRUE(isWhole(whole) && isWhole(withLine));
    EXPECT_FALSE(isWhole(withMore));
    // the southernmost posts, but for the corners, stand farther north
    for (std::size_t i = 1; i < 16; ++i) {
        Geodetic place = earth.toGeodetic(whole.vertex(i));
        place.latitude += 0.05 * kHills.latitude().width() / 16.0;
        moveVertex(shorter, i, earth.toEcef(place) - whole.vertex(i));
    }
    EXPECT_TRUE(std::isfinite(platesOf(earth, whole, kHills).least(8, 0, 3)));
    EXPECT_FALSE(std::isfinite(platesOf(earth, shorter, kHills).least(8, 0, 3)));
}

}  // namespace
}  // namespace osgAnalyticBin::test
