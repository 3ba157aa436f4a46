// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// Bytes that operator new has handed out in this process, in all libraries, and delete has not taken back.
[[nodiscard]] long long bytesOfObjects();

/// Says what the main thread does from now on. Where it does not report again for 60 s, the process says on stderr what
/// it did last, prints its stack, and aborts.
void reportProgress(const std::string& what);

}  // namespace osgAnalyticBin::test
