// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/Frame.h>

#include <glm/geometric.hpp>

namespace osgAnalyticBin::core {

Frame Frame::aboutAxis(const glm::dvec3& origin, const glm::dvec3& axis, const glm::dvec3& zeroDirection) noexcept {
    Frame frame;
    frame.origin = origin;
    frame.z = glm::normalize(axis);
    frame.y = glm::normalize(glm::cross(frame.z, zeroDirection));
    frame.x = glm::cross(frame.y, frame.z);
    return frame;
}

Frame Frame::placedIn(const Frame& outer) const noexcept {
    const auto turned = [&](const glm::dvec3& v) { return v.x * outer.x + v.y * outer.y + v.z * outer.z; };
    return {outer.toOuter(origin), turned(x), turned(y), turned(z)};
}

}  // namespace osgAnalyticBin::core
