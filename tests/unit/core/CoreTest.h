// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What several tests of the core need.

#pragma once

#include <osgAnalyticBin/core/bin/BinFamily.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>
#include <osgAnalyticBin/core/mesh/FinerMeshes.h>
#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>
#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/common.hpp>
#include <gtest/gtest.h>
#ifdef OSGANALYTICBIN_SIMD
#include <hwy/highway.h>
#endif

#include <core/kernels/OcclusionKernels.h>
#include <core/kernels/PlaneKernels.h>
#include <cstdio>
#include <initializer_list>
#include <support/Planets.h>
#include <support/View.h>
#include <utility>

namespace osgAnalyticBin::test {

using core::BinHull;
using core::EcefMesh;
using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::Geodetic;
using core::GeodeticBin;
using core::GeodeticGrid;
using core::GeodeticGridBounds;
using core::GeodeticMapping;
using core::GroundPlates;
using core::HorizonBin;
using core::HorizonBuffer;
using core::HorizonEye;
using core::Interval;
using core::MeshBounds;
using core::Plane;
using core::PlaneMask;
using core::PlaneSet;
using core::QuadraticBin;
using core::Side;

/// One by one degree beside the Gulf of Guinea.
inline const GeodeticBin kOneDegree = GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0});

inline PlaneSet setOf(std::initializer_list<Plane> planes) {
    PlaneSet set;
    for (const Plane& plane : planes) set.push_back(plane);
    return set;
}

inline double smaller(const Ellipsoid& e) {
    return std::min(e.equatorialRadius(), e.polarRadius());
}

inline double larger(const Ellipsoid& e) {
    return std::max(e.equatorialRadius(), e.polarRadius());
}

inline double smallestCurvatureRadius(const Ellipsoid& e) {
    return smaller(e) * smaller(e) / larger(e);
}

/// At this place, turned at random.
inline core::Frame randomFrame(Random& random, const glm::dvec3& origin) {
    core::Frame frame{origin, random.direction(), {}, {}};
    frame.y = glm::normalize(glm::cross(frame.x, random.direction()));
    frame.z = glm::cross(frame.x, frame.y);
    return frame;
}

/// Whether a range of distances holds the true range, up to the rounding error of the true one.
inline bool holds(const Interval& range, const RealRange& truth, Real rounding) {
    return range.lower <= truth.lower + rounding && range.upper >= truth.upper - rounding;
}

/// Any number of planes. Most of them touch one of the bins, or nearly; some have NaN or infinity in place of a number.
inline void addRandomPlanes(Random& random, const std::vector<BinOracle>& oracles, PlaneSet& planes) {
    constexpr std::array<double, 4> kNoNumbers{kNaN, kInfinity, -kInfinity, std::numeric_limits<double>::max()};
    const int count = random.chance(0.5) ? random.integer(4, 6) : random.integer(0, static_cast<int>(core::kMaxPlanes));
    const bool allInside = random.chance(0.3);
    for (int i = 0; i < count; ++i) {
        const BinOracle& near =
            oracles[static_cast<std::size_t>(random.integer(0, static_cast<int>(oracles.size()) - 1))];
        Plane plane = randomPlane(random, near, random.pick(kPlaneKinds));
        if (allInside) plane.offset += random.uniform(0.0, 2.0) * sizeOf(near.ellipsoid(), near.bin());
        if (random.chance(0.01)) {
            double& number = random.chance(0.5) ? plane.offset : plane.normal[random.integer(0, 2)];
            number = random.pick(kNoNumbers);
        }
        planes.push_back(plane);
    }
}

/// A bin of any kind, and a plane near it or far from it.
struct PlaneCase {
    explicit PlaneCase(Random& random)
        : kind(random.pick(kBinKinds)),
          oracle(randomEllipsoid(random), randomBin(random, kind)),
          plane(randomPlane(random, oracle, random.pick(kPlaneKinds))) {}

    BinKind kind;
    BinOracle oracle;
    Plane plane;
};

inline void expectSideOf(const Plane& plane, const RealVector& point, Side side, BinKind kind) {
    const Real distance = exactDistance(plane, point);
    ASSERT_TRUE(side != Side::Outside || distance < 0) << nameOf(kind);
    ASSERT_TRUE(side != Side::Inside || distance >= 0) << nameOf(kind);
}

// What must hold for any bin that tells how far its points are from a plane. `make(ellipsoid, bin, margin)` makes it;
// `tolerance(planeCase)`: metres by which two evaluations of the same geometry may differ.

template <class Make, class Tolerance>
void expectMarginToWidenTheRangeByItself(Random& random, const Make& make, const Tolerance& tolerance) {
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const double margin = random.logUniform(1e-3, 1e5);
        const auto bare = make(c.oracle.ellipsoid(), c.oracle.bin(), 0.0);
        const auto wide = make(c.oracle.ellipsoid(), c.oracle.bin(), margin);
        const double most = 2e-9 * margin + tolerance(c);
        ASSERT_NEAR(bare.distanceRange(c.plane).lower - wide.distanceRange(c.plane).lower, margin, most);
        ASSERT_NEAR(wide.distanceRange(c.plane).upper - bare.distanceRange(c.plane).upper, margin, most);
        const Side side = wide.classify(c.plane);
        if (side == Side::Straddling) continue;
        const RealVector point = geodeticToEcef(c.oracle.ellipsoid(), randomPosition(random, c.oracle.bin())) +
                                 real(margin * 0.999999 * random.direction());
        ASSERT_NO_FATAL_FAILURE(expectSideOf(c.plane, point, side, c.kind));
    }
}

template <class Make>
void expectPlanesWithoutNumbersToBeUndecided(const Make& make) {
    const auto bin = make(wgs84(), kOneDegree, 0.0);
    for (int broken = 0; broken < 4; ++broken) {
        Plane plane{{1.0, 0.0, 0.0}, -1e9};
        ASSERT_EQ(bin.classify(plane), Side::Outside);
        (broken < 3 ? plane.normal[broken] : plane.offset) = kNaN;
        EXPECT_EQ(bin.classify(plane), Side::Straddling) << broken;
        EXPECT_EQ(bin.classify({-plane.normal, -plane.offset}), Side::Straddling) << broken;
    }
    for (const double offset : {kInfinity, -kInfinity})
        EXPECT_EQ(bin.classify({{1.0, 0.0, 0.0}, offset}), Side::Straddling);
}

#ifdef OSGANALYTICBIN_SIMD
/// Runs a check, which is told the name, with the kernels of each target that this processor has.
template <class Check>
void forEachTarget(const Check& check) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        core::kernels::chooseKernels();
        check(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    core::kernels::chooseKernels();
}
#endif

}  // namespace osgAnalyticBin::test
