// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <vector>

namespace osgAnalyticBin {

/// The part of an eye's picture that terrain covers, as a search for tiles behind terrain has found it. The picture is
/// on the vertical plane in front of the eye, cut into strips of equal width: a point is at x = right / forward, y = up
/// / forward. Source: doc/theory/occlusion.md, section 4.
struct CoveredPicture {
    core::Frame eye{};                    ///< ECEF; its axes are right, forward and up
    core::Interval across;                ///< of x
    std::vector<core::Interval> heights;  ///< of y, from left to right; upper below lower: nothing is covered
};

}  // namespace osgAnalyticBin
