// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "AllowedOccluders.h"
#include "Description.h"
#include "Painter.h"
#include "Recorder.h"

#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::test {

/// A pixel that differs, and how many do.
struct PictureDifference {
    std::string without;  ///< key of the drawable in it, and the point in eye space
    std::string with;
    int column = 0, row = 0;
    std::size_t pixels = 0;
};

/// Totals of the comparisons of pictures.
struct PictureTotals {
    std::size_t pictures = 0;
    std::size_t covered = 0;  ///< pixels with something in them
    std::size_t allowed = 0;  ///< pixels that differ where the documentation says that they may
};

/// The scene with what cannot be pictured taken out of its views: near and far planes that are computed of what is
/// drawn, and so differ with bins, and small features that are culled though they have a pixel. Without clip planes, as
/// OSG places one by the matrix of whatever is drawn first below its state, and without primitive restart, as display
/// lists keep what was in force when they were made.
[[nodiscard]] Description picturable(Description description);

/// Compares the paintings of two deliveries, pixel for pixel. Returns: the first difference that is not allowed.
[[nodiscard]] std::optional<PictureDifference> findPictureDifference(const Description& description,
                                                                     const Painter& painter, const Delivery& without,
                                                                     const Delivery& with,
                                                                     const std::vector<AllowedOccluder>& allowed,
                                                                     PictureTotals& totals);

}  // namespace osgAnalyticBin::test
