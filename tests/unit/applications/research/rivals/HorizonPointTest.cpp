// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: the point itself, found from samples of the bin, whose own line of sight is tested in long double. That no
// visible point is hidden: HullSoundness.cpp.

#include "HorizonPoint.h"

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <support/Numbers.h>
#include <support/RandomBins.h>
#include <support/RandomViews.h>
#include <support/View.h>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::GeodeticBin;
using core::HorizonBin;
using core::HorizonEye;
using rivals::HorizonPoint;

constexpr double kPointDepth = 11000.0;

HorizonPoint pointOf(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin = 0.0) {
    return HorizonPoint(HorizonBin(ellipsoid, bin, margin));
}

// The point as [R13] has it, from samples in the space where the occluder is the unit ball: along the middle, as high
// as the sample needs that needs most.
std::optional<RealVector> sampledPoint(const GeodeticBin& bin, Real scale) {
    const Real a = wgs84().equatorialRadius();
    const Real b = wgs84().polarRadius();
    const auto inBall = [&](Real latitude, Real longitude) {
        const RealVector p = geodeticToEcef(wgs84(), latitude, longitude, bin.altitude().upper);
        return RealVector{p.x / a / scale, p.y / a / scale, p.z / b / scale};
    };
    const RealVector middle = inBall(bin.center().latitude, bin.center().longitude);
    const RealVector direction = (1 / length(middle)) * middle;
    constexpr int kSteps = 8;
    Real height = 0;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
            const RealVector p = inBall(bin.latitude().lower + bin.latitude().width() * i / kSteps,
                                        bin.longitude().lower + bin.longitude().width() * j / kSteps);
            const Real angle = std::acos(std::min<Real>(1, dot(p, direction) / length(p))) + std::acos(1 / length(p));
            if (!(angle < static_cast<Real>(kHalfPi))) return std::nullopt;
            height = std::max(height, 1 / std::cos(angle));
        }
    }
    const RealVector q = height * direction;
    return RealVector{q.x * a * scale, q.y * a * scale, q.z * b * scale};
}

TEST(HorizonPoint, IsThePublishedPoint) {
    Random random(423);
    const Real scale = 1 - static_cast<Real>(kPointDepth) / wgs84().polarRadius();
    int differences = 0;
    int hidden = 0;
    constexpr int kTrials = 20000;
    for (int trial = 0; trial < kTrials; ++trial) {
        const GeodeticBin bin = randomTile(random, random.integer(1, 6), {-500.0, 3000.0});
        const glm::dvec3 eye = randomEye(random, wgs84(), kPointDepth);
        const auto prepared = HorizonEye::fromEye(wgs84(), kPointDepth, eye);
        const auto point = sampledPoint(bin, scale);
        if (!prepared || !point) continue;
        const bool isPublishedHidden = !segmentMissesOccluder(wgs84(), kPointDepth, *point, real(eye));
        hidden += isPublishedHidden ? 1 : 0;
        differences += isPublishedHidden != pointOf(wgs84(), bin).isHiddenFrom(*prepared) ? 1 : 0;
    }
    EXPECT_GT(hidden, kTrials / 4);
    // The middle in latitude is not quite that of the scaled latitudes, and no sample may be the farthest point.
    EXPECT_LT(differences, kTrials / 500);
}

TEST(HorizonPoint, MissingInformationIsVisible) {
    const auto eye = HorizonEye::fromEye(wgs84(), kPointDepth, {1e7, 0.0, 0.0});
    ASSERT_TRUE(eye);
    const auto behind = [](double halfWidthDeg, core::Interval altitude) {
        return GeodeticBin::fromDegrees({-1.0, 1.0}, {180.0 - halfWidthDeg, 180.0 + halfWidthDeg}, altitude);
    };
    EXPECT_TRUE(pointOf(wgs84(), behind(1.0, {0.0, 1000.0})).isHiddenFrom(*eye));
    EXPECT_FALSE(pointOf(wgs84(), behind(1.0, {0.0, 1000.0}), kNaN).isHiddenFrom(*eye));
    EXPECT_FALSE(pointOf(wgs84(), behind(1.0, {-4e6, 1000.0})).isHiddenFrom(*eye))
        << "nearer the centre than altitudes go";
    EXPECT_FALSE(pointOf(wgs84(), behind(95.0, {0.0, 1000.0})).isHiddenFrom(*eye)) << "wider than any point stands for";
    EXPECT_FALSE(pointOf(wgs84(), GeodeticBin()).isHiddenFrom(*eye));
    EXPECT_FALSE(pointOf(wgs84(), GeodeticBin::wholeGlobe({0.0, 1000.0})).isHiddenFrom(*eye));
}

}  // namespace
}  // namespace osgAnalyticBin::test
