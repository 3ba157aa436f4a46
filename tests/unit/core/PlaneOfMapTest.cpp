// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Bins of a map: boxes in the plane. Oracle: their eight corners. Terrain in maps: HorizonBufferTest.cpp,
// GroundPlatesTest.cpp, HorizonTest.cpp.

#include "CoreTest.h"
#include "MeshSamples.h"

namespace osgAnalyticBin::test {
namespace {

constexpr double kUnits = Ellipsoid::kMapUnitsInRadian;

// A box in a map, and the bin that stands for it.
struct MapBox {
    explicit MapBox(Random& random)
        : x(range(random, 6e7)), y(range(random, 1e7)), z(range(random, 1e4)), margin(random.uniform(0.0, 2.0)) {}

    static Interval range(Random& random, double farthest) {
        const double from = random.uniform(-farthest, farthest);
        return {from, from + random.logUniform(1e-2, 1e6)};
    }
    [[nodiscard]] GeodeticBin bin() const {
        return GeodeticBin({y.lower / kUnits, y.upper / kUnits}, {x.lower / kUnits, x.upper / kUnits}, z);
    }
    [[nodiscard]] QuadraticBin quadratic() const {
        return std::get<QuadraticBin>(core::quadraticOrExact(Ellipsoid::plane(), bin(), margin));
    }
    [[nodiscard]] glm::dvec3 corner(int i) const {
        return {i & 1 ? x.upper : x.lower, i & 2 ? y.upper : y.lower, i & 4 ? z.upper : z.lower};
    }
    // Of the nearest and the farthest corner along a plane's normal, the margin included.
    [[nodiscard]] Interval distances(const Plane& plane) const {
        Interval range{HUGE_VAL, -HUGE_VAL};
        for (int i = 0; i < 8; ++i) {
            range.lower = std::min(range.lower, plane.distance(corner(i)));
            range.upper = std::max(range.upper, plane.distance(corner(i)));
        }
        return {range.lower - margin, range.upper + margin};
    }

    Interval x, y, z;
    double margin;
};

TEST(PlaneOfMap, PositionsAreCoordinatesWithoutRounding) {
    Random random(4810);
    const Ellipsoid plane = Ellipsoid::plane();
    EXPECT_TRUE(plane.isPlane());
    EXPECT_FALSE(Ellipsoid(kUnits, kUnits).isPlane());
    EXPECT_FALSE(plane == Ellipsoid(kUnits, kUnits));
    for (int trial = 0; trial < 1000; ++trial) {
        const glm::dvec3 point(random.uniform(-6e7, 6e7), random.uniform(-1e7, 1e7), random.uniform(-1e4, 1e4));
        const core::Geodetic position = plane.toGeodetic(point);
        EXPECT_EQ(plane.toEcef(position), point);
        EXPECT_EQ(plane.up(position.latitude, position.longitude), glm::dvec3(0.0, 0.0, 1.0));
    }
}

TEST(PlaneOfMap, TellsBoxesFromPlanesToRounding) {
    Random random(4811);
    for (int trial = 0; trial < 20000; ++trial) {
        const MapBox box(random);
        const QuadraticBin bin = box.quadratic();
        Plane plane{random.direction(), 0.0};
        plane.offset = -glm::dot(plane.normal, box.corner(random.integer(0, 7)));
        const Interval range = box.distances(plane);
        const double rounding = 1e-9 * (glm::length(box.corner(0)) + glm::length(box.corner(7)));
        plane.offset +=
            random.pick(std::array<double, 6>{-range.lower + rounding, -range.lower - rounding, -range.upper + rounding,
                                              -range.upper - rounding, -range.lower, -range.upper});
        const Interval moved = box.distances(plane);
        const Side side = bin.classify(plane);
        EXPECT_TRUE(side != Side::Outside || moved.upper < 0.0);
        EXPECT_TRUE(side != Side::Inside || moved.lower >= 0.0);
        EXPECT_TRUE(side == Side::Outside || moved.upper >= -0.5 * rounding);
        EXPECT_TRUE(side == Side::Inside || moved.lower <= 0.5 * rounding);
        core::BinFamily family(3);
        family.set(1, bin);
        const core::PlaneSet planes = setOf({plane});
        core::FamilyVerdict verdict{};
        family.classify(planes, 1, verdict);
        EXPECT_EQ((verdict.outside >> 1 & 1) != 0, side == Side::Outside);
        EXPECT_EQ((verdict.insideAll >> 1 & 1) != 0, side == Side::Inside);
    }
}

TEST(PlaneOfMap, ABoxBeyondAnEdgeIsSeparated) {
    Random random(4812);
    int separated = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const MapBox box(random);
        const QuadraticBin bin = box.quadratic();
        // two planes through a point, near the box
        const glm::dvec3 middle = 0.5 * (box.corner(0) + box.corner(7));
        const glm::dvec3 at = middle + random.uniform(0.0, 2.0) * (box.corner(random.integer(0, 7)) - middle);
        core::PlaneSet planes;
        for (int i = 0; i < 2; ++i) {
            const glm::dvec3 normal = random.direction();
            planes.push_back({normal, -glm::dot(normal, at)});
        }
        core::BinFamily family(1);
        family.set(0, bin);
        const bool isSeparated = core::isSeparated(bin, planes, planes.size(), 3);
        EXPECT_EQ(family.isSeparated(0, planes, 3), isSeparated);
        if (!isSeparated) continue;
        ++separated;
        for (int sample = 0; sample < 20; ++sample) {
            const glm::dvec3 point(random.uniform(box.x.lower, box.x.upper), random.uniform(box.y.lower, box.y.upper),
                                   random.uniform(box.z.lower, box.z.upper));
            EXPECT_FALSE(planes[0].distance(point) >= 0.0 && planes[1].distance(point) >= 0.0);
        }
    }
    EXPECT_GT(separated, 6300);  // a thousand mixtures of the two planes part 6413
}

TEST(PlaneOfMap, BoundsOfMeshesAreThoseOfTheirVertices) {
    Random random(4814);
    const Ellipsoid plane = Ellipsoid::plane();
    for (int trial = 0; trial < 200; ++trial) {
        const MapBox box(random);
        const core::EcefMesh mesh = gridMesh(random, plane, box.bin(), 4);
        const core::MeshBounds bounds(plane, mesh);
        core::GeodeticMeshBounds thorough(plane, box.bin().center().longitude);
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
            thorough.expandByTriangle(mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]),
                                      mesh.vertex(mesh.triangles[i + 2]));
        }
        const auto [south, north] = std::minmax_element(mesh.y.begin(), mesh.y.end());
        const auto [west, east] = std::minmax_element(mesh.x.begin(), mesh.x.end());
        const auto [low, high] = std::minmax_element(mesh.z.begin(), mesh.z.end());
        EXPECT_EQ(bounds.bin(),
                  GeodeticBin({*south / kUnits, *north / kUnits}, {*west / kUnits, *east / kUnits}, {*low, *high}));
        EXPECT_EQ(bounds.sag(), 0.0);
        EXPECT_EQ(bounds.altitudes(), mesh.z);
        EXPECT_FALSE(bounds.touchesAxis());
        EXPECT_TRUE(thorough.bin().contains(bounds.bin()));
        const core::GeodeticGridBounds grid(plane, {box.bin().latitude(), box.bin().longitude(), 5, 5}, 1e4);
        EXPECT_TRUE(grid.isKnown());
        EXPECT_EQ(grid.latitude(), box.bin().latitude());
        EXPECT_EQ(grid.sag(), 0.0);
    }
    core::EcefMesh broken{{0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}, {0.0, NAN, 0.0}, {0, 1, 2}};
    EXPECT_TRUE(core::MeshBounds(plane, broken).bin().empty());
    const core::EcefMesh far{{0.0, 1.0, 1.0}, {1.1 * kUnits, 0.0, 1.0}, {0.0, 0.0, 0.0}, {0, 1, 2}};
    EXPECT_TRUE(core::MeshBounds(plane, far).bin().empty());
}

// Tiles of a thousand kilometres sag by metres: nothing beside heights.
TEST(PlaneOfMap, FinerMeshesHardlySag) {
    const double size = 1e6 / kUnits;
    const GeodeticBin tile({0.0, size}, {0.0, size}, {0.0, 1000.0});
    EXPECT_LT(core::sagOfFinerMeshes(Ellipsoid::plane(), tile, false), 30.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
