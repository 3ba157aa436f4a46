// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <stdexcept>

namespace osgAnalyticBin::indexing {

/// Why no index of a database can be made; its text is one line: what, where, what to do.
class OSGANALYTICBIN_EXPORT Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
    ~Failure() override;
};

}  // namespace osgAnalyticBin::indexing
