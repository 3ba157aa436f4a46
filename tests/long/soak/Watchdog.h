// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// Says what the main thread does from now on. Where it does not report again for 60 s, the process says on stderr what
/// it did last, prints its stack, and aborts.
void reportProgress(const std::string& what);

}  // namespace osgAnalyticBin::test
