// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What several tests of the core need.

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>
#include <osgAnalyticBin/core/bin/BinFamily.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>
#include <osgAnalyticBin/core/mesh/CrackBounds.h>
#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>
#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>
#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <core/kernels/OcclusionKernels.h>
#include <core/kernels/PlaneKernels.h>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <support/GeodeticOracle.h>
#include <support/Numbers.h>
#include <support/Planets.h>
#include <support/Random.h>
#include <support/RandomBins.h>
#include <support/RandomViews.h>
#include <support/View.h>
#include <utility>
#include <vector>

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

}  // namespace osgAnalyticBin::test
