// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "LevelPicture.h"

#include "../kit/DepthBuffer.h"
#include "../kit/GlmBridge.h"
#include "../kit/Inverse.h"

#include <glm/geometric.hpp>
#include <osg/Viewport>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

// Views and corners of views that are less level than this have no picture on a vertical plane.
constexpr double kLevel = 0.2;

}  // namespace

std::optional<LevelView> LevelView::of(osg::CullStack& cullStack, const core::Ellipsoid& ellipsoid,
                                       const glm::dvec3& eye, std::optional<double> leastNear) {
    const osg::Matrixd& projection = *cullStack.getProjectionMatrix();
    const osg::Viewport* const viewport = cullStack.getViewport();
    const auto eyeToWorld = affineInverse(*cullStack.getModelViewMatrix());
    osg::Matrixd unproject;
    if (!viewport || !eyeToWorld || !unproject.invert(projection)) return std::nullopt;
    const auto toWorld = [&](const osg::Vec3d& v) { return toGlm(osg::Matrixd::transform3x3(v, *eyeToWorld)); };
    LevelView view;
    const core::Geodetic place = ellipsoid.toGeodetic(eye);
    view.up = ellipsoid.up(place.latitude, place.longitude);
    const glm::dvec3 look = glm::normalize(toWorld({0.0, 0.0, -1.0}));
    const glm::dvec3 level = look - glm::dot(look, view.up) * view.up;
    if (!(glm::length(level) > kLevel)) return std::nullopt;
    view.forward = glm::normalize(level);
    view.depthStep = kDepthStep / (leastNear ? *leastNear : depthScaleOf(projection));
    for (std::size_t i = 0; i < view.corners.size(); ++i) {
        const osg::Vec4d clip(i & 1U ? 1.0 : -1.0, i & 2U ? 1.0 : -1.0, 0.5, 1.0);
        const osg::Vec4d point = clip * unproject;
        const osg::Vec3d ray(point.x(), point.y(), point.z());
        view.corners[i] = toWorld(ray / std::copysign(ray.z(), ray.z() * projection(2, 3)));
    }
    const double width = glm::distance(view.corners[0], view.corners[1]);
    const double height = glm::distance(view.corners[0], view.corners[2]);
    view.pixels = std::min(width, height) / std::max(width / viewport->width(), height / viewport->height());
    return view.pixels > 0.0 ? std::optional(view) : std::nullopt;
}

core::Frame LevelView::frameAt(const glm::dvec3& place) const {
    return {place, glm::cross(forward, up), forward, up};
}

std::optional<PictureSpan> PictureSpan::of(const LevelView& view, const core::Frame& frame) {
    PictureSpan span{core::Interval::none(), 0.0, 0.0};
    double levelness = 1.0;
    for (const glm::dvec3& corner : view.corners) {
        const double ahead = glm::dot(corner, frame.y), length = glm::length(corner);
        if (!(ahead > kLevel * length)) return std::nullopt;
        span.across.expandBy(glm::dot(corner, frame.x) / ahead);
        levelness = std::min(levelness, ahead / length);
        span.depthStep = std::max(span.depthStep, view.depthStep / ahead);
    }
    if (!(span.across.width() > 0.0)) return std::nullopt;
    span.drawing = span.across.width() / (128.0 * view.pixels * levelness * levelness);
    constexpr double kRounding = 1e-6;
    const double room = kRounding * span.across.width();
    span.across = {span.across.lower - room, span.across.upper + room};
    return span;
}

}  // namespace osgAnalyticBin
