// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/Version.h>

namespace osgAnalyticBin {

const char* version() noexcept {
    return OSGANALYTICBIN_VERSION;
}

}  // namespace osgAnalyticBin
