// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Run.h"

namespace osgAnalyticBin::test {

/// A description with less in it that fails in the same way, and how.
struct Shrunk {
    Description description;
    Failure failure;
};

/// Leaves out parts, frames and traits of the databases one after the other while the scene still fails.
/// `painter`: as for run().
[[nodiscard]] Shrunk shrink(const Description& description, const Failure& failure, Painter* painter = nullptr);

}  // namespace osgAnalyticBin::test
