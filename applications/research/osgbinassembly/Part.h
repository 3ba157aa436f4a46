// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BezierSolid.h"

#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <osg/Geode>

#include <vector>

namespace osgAnalyticBin::assembly {

/// A piece of the assembly: what is drawn, and the bin that holds it.
struct Part {
    osg::ref_ptr<osg::Geode> geode;
    core::QuadraticBin bin;

    /// Points of the mesh: its vertices, and its edges every half metre.
    [[nodiscard]] std::vector<osg::Vec3> samples() const;
};

/// A quarter of a straight pipe's wall along the frame's z axis, from its origin on.
[[nodiscard]] Part makePipeQuarter(const core::Frame& frame, double radius, double wall, double length, int quarter);

/// A quarter of the wall of half a bend by 90 degrees about the frame's z axis; `half` is 0 or 1.
[[nodiscard]] Part makeBendQuarter(const core::Frame& frame, double bendRadius, double radius, double wall, int half,
                                   int quarter);

/// A curved panel.
[[nodiscard]] Part makePanel(const BezierSolid& panel);

}  // namespace osgAnalyticBin::assembly
