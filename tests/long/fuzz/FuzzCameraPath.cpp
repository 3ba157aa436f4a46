// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Camera paths: what is read has views of finite numbers.

#include "CameraPath.h"
#include "Failure.h"
#include "Fuzz.h"

#include <cmath>
#include <sstream>

using namespace osgAnalyticBin;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    try {
        const auto poses = flight::readCameraPath(in, "path.csv");
        test::require(!poses.empty());
        for (const auto& pose : poses) test::require(std::isfinite(pose.roll + pose.eyeRight));
    } catch (const support::Failure& failure) {
        test::requireOneLine(failure);
    }
    return 0;
}
