// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin::test {

/// Bytes that operator new has handed out in this process, in all libraries, and delete has not taken back.
[[nodiscard]] long long bytesOfObjects();

}  // namespace osgAnalyticBin::test
