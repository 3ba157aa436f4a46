// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Oracle.h"

namespace osgAnalyticBin::test {

struct Failure {
    int frame = 0;
    std::string signature;  ///< of what kind it is
    std::string text;       ///< what was lost or found
};

/// What a run came across, to tell that it looked at something.
struct RunTotals {
    std::size_t delivered = 0;  ///< drawables, without bins
    std::size_t lost = 0;       ///< of them, not delivered with bins
    std::size_t drawn = 0;      ///< drawables, with bins
    std::size_t undone = 0;     ///< comparisons after bins were taken off
    PictureTotals pictures;
};

/// Builds the scene twice, installs bins on one, and runs the frames of both: events, update and cull traversals,
/// paging. With a painter, pictures of both are compared in place of what was delivered; the description is to be
/// picturable(). Returns: the first fault.
[[nodiscard]] std::optional<Failure> run(const Description& description, RunTotals& totals, Painter* painter = nullptr);

/// A description with less in it that fails in the same way, and how.
struct Shrunk {
    Description description;
    Failure failure;
};

/// Leaves out parts, frames and traits of the databases one after the other while the scene still fails.
/// `painter`: as for run().
[[nodiscard]] Shrunk shrink(const Description& description, const Failure& failure, Painter* painter = nullptr);

}  // namespace osgAnalyticBin::test
