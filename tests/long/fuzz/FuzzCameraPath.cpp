// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Camera paths: what is read has views of finite numbers.

#include "CameraPath.h"
#include "Fuzz.h"

#include <cmath>
#include <sstream>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    std::string error;
    const auto poses = osgAnalyticBin::flight::readCameraPath(in, "path.csv", error);
    osgAnalyticBin::test::require(poses.has_value() == error.empty());
    osgAnalyticBin::test::require(error.find('\n') == std::string::npos);
    if (!poses) return 0;
    osgAnalyticBin::test::require(!poses->empty());
    for (const auto& pose : *poses) osgAnalyticBin::test::require(std::isfinite(pose.roll + pose.eyeRight));
    return 0;
}
