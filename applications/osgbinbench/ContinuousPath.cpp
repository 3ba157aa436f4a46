// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ContinuousPath.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::bench {

namespace {

using core::Geodetic;
using flight::CameraPose;

double mixed(double a, double b, double share) {
    const double ratio = a > 0.0 && b > 0.0 ? b / a : 0.0;
    return ratio > 0.0 ? a * std::pow(ratio, share) : a + (b - a) * share;
}

Geodetic mixed(const Geodetic& a, const Geodetic& b, double share) {
    const core::Ellipsoid sphere(1.0, 1.0);
    const glm::dvec3 from = sphere.up(a.latitude, a.longitude);
    const glm::dvec3 to = sphere.up(b.latitude, b.longitude);
    const double angle = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
    const double sine = std::sin(angle);
    // Where the two ends coincide, or stand opposite each other, there is no one circle to follow.
    const glm::dvec3 v = sine > 1e-9 ? (std::sin((1.0 - share) * angle) * from + std::sin(share * angle) * to) / sine
                                     : (share < 0.5 ? from : to);
    return {std::asin(std::clamp(v.z, -1.0, 1.0)), std::atan2(v.y, v.x), mixed(a.altitude, b.altitude, share)};
}

CameraPose mixed(const CameraPose& a, const CameraPose& b, double share) {
    return {{},
            mixed(a.eye, b.eye, share),
            mixed(a.look, b.look, share),
            mixed(a.verticalFov, b.verticalFov, share),
            mixed(a.nearPlane, b.nearPlane, share),
            mixed(a.farPlane, b.farPlane, share),
            a.time + (b.time - a.time) * share,
            a.roll + (b.roll - a.roll) * share,
            a.eyeRight + (b.eyeRight - a.eyeRight) * share};
}

// When each pose is reached; poses that nobody gave times are a second apart.
std::vector<double> timesOf(const std::vector<CameraPose>& path) {
    const bool areGiven = path.front().time < path.back().time;
    std::vector<double> times;
    for (const CameraPose& pose : path) times.push_back(areGiven ? pose.time : static_cast<double>(times.size()));
    return times;
}

}  // namespace

std::vector<CameraPose> continuousPath(const std::vector<CameraPose>& path, int frames) {
    std::vector<CameraPose> poses;
    const std::vector<double> times = timesOf(path);
    const double duration = times.back() - times.front();
    std::size_t from = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const double time = times.front() + (frames > 1 ? duration * frame / (frames - 1) : 0.0);
        while (from + 2 < path.size() && times[from + 1] <= time) ++from;
        const std::size_t to = std::min(from + 1, path.size() - 1);
        const double seconds = times[to] - times[from];
        const double share = seconds > 0.0 ? std::clamp((time - times[from]) / seconds, 0.0, 1.0) : 0.0;
        poses.push_back(mixed(path[from], path[to], share));
    }
    return poses;
}

}  // namespace osgAnalyticBin::bench
