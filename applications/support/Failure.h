// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <stdexcept>

namespace osgAnalyticBin::support {

/// An error that ends the program; its text is one line: what, where, what to do.
class Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A wrong command line: an unknown option, a value out of its range, options that contradict each other. What is wrong
/// with the files that it names is a Failure.
class UsageError final : public Failure {
public:
    using Failure::Failure;
};

}  // namespace osgAnalyticBin::support
