// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

namespace osgAnalyticBin::test {

/// Calls `function` with positions on the top and the bottom of a bin, a grid of `steps` x `steps` cells, until it
/// returns false.
template <class Function>
void forSamples(const core::GeodeticBin& bin, int steps, const Function& function) {
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            for (const double h : {bin.altitude().upper, bin.altitude().lower}) {
                const core::Geodetic position{bin.latitude().lower + bin.latitude().width() * i / steps,
                                              bin.longitude().lower + bin.longitude().width() * j / steps, h};
                if (!function(position)) return;
            }
        }
    }
}

}  // namespace osgAnalyticBin::test
