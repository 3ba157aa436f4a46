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
#include <support/Numbers.h>
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
