// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Camera paths: what is read has views of finite numbers.

#include "CameraPath.h"
#include "Failure.h"
#include "Fuzz.h"

#include <cmath>
#include <sstream>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    try {
        const auto poses = osgAnalyticBin::flight::readCameraPath(in, "path.csv");
        osgAnalyticBin::test::require(!poses.empty());
        for (const auto& pose : poses) osgAnalyticBin::test::require(std::isfinite(pose.roll + pose.eyeRight));
    } catch (const osgAnalyticBin::support::Failure& failure) {
        const std::string error = failure.what();
        osgAnalyticBin::test::require(!error.empty() && error.find('\n') == std::string::npos);
    }
    return 0;
}
