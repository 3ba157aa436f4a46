// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <stdexcept>

namespace osgAnalyticBin::support {

/// An error that ends the program; its text is one line: what, where, what to do.
class Failure final : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace osgAnalyticBin::support
