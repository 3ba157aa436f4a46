// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Viewpoint.h"

#include "../GlmBridge.h"
#include "../Inverse.h"

#include <osg/Camera>
#include <osg/GraphicsContext>
#include <osg/State>
#include <osg/Texture>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace osgAnalyticBin {

namespace {

// Shadow maps are drawn for another eye's picture, often of back faces alone.
bool drawsShadows(const osg::Camera& camera) {
    if (camera.getReferenceFrame() == osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT) return true;
    const osg::Camera::BufferAttachmentMap& attachments = camera.getBufferAttachmentMap();
    return !attachments.empty() && std::all_of(attachments.begin(), attachments.end(), [](const auto& attachment) {
        return attachment.first == osg::Camera::DEPTH_BUFFER;
    });
}

// The camera that is culled for, or whose buffers it draws into.
const osg::Camera* stageCamera(osg::NodeVisitor& visitor) {
    osgUtil::CullVisitor* const cullVisitor = visitor.asCullVisitor();
    return cullVisitor && cullVisitor->getRenderStage() ? cullVisitor->getCurrentCamera() : nullptr;
}

constexpr unsigned int kLeastDepthBits = 24;
constexpr GLenum kDepth32fStencil8 = 0x8CAD;  // GL_DEPTH32F_STENCIL8, which Windows lacks

// Whether a format has that many bits, or leaves their number to the driver.
bool isFineDepth(GLenum format) {
    return format == GL_DEPTH_COMPONENT || format == GL_DEPTH_COMPONENT24 || format == GL_DEPTH_COMPONENT32 ||
           format == GL_DEPTH_COMPONENT32F || format == GL_DEPTH_STENCIL_EXT || format == GL_DEPTH24_STENCIL8_EXT ||
           format == kDepth32fStencil8;
}

// Whether the depth buffer that is drawn into tells apart what horizons and occlusion tell apart. Where OSG leaves its
// size to the driver it is taken for fine enough, and so is one that OSG does not know.
bool hasFineDepthBuffer(osg::NodeVisitor& visitor) {
    const osg::Camera* const camera = stageCamera(visitor);
    if (camera && camera->getRenderTargetImplementation() == osg::Camera::FRAME_BUFFER_OBJECT) {
        for (const auto& [buffer, attachment] : camera->getBufferAttachmentMap()) {
            if (buffer != osg::Camera::DEPTH_BUFFER && buffer != osg::Camera::PACKED_DEPTH_STENCIL_BUFFER) continue;
            const osg::Texture* const texture = attachment._texture.get();
            const GLint format =
                texture ? texture->getInternalFormat() : static_cast<GLint>(attachment._internalFormat);
            return isFineDepth(static_cast<GLenum>(format));
        }
        return (camera->getImplicitBufferAttachmentRenderMask(true) & osg::Camera::IMPLICIT_DEPTH_BUFFER_ATTACHMENT) !=
               0;
    }
    const osg::State* const state = visitor.asCullVisitor() ? visitor.asCullVisitor()->getState() : nullptr;
    const osg::GraphicsContext* const context = state ? state->getGraphicsContext() : nullptr;
    return !context || !context->getTraits() || context->getTraits()->depth >= kLeastDepthBits;
}

// Whether the camera that is culled for draws shadows, or one does that it is relative to.
bool isShadowPass(osg::NodeVisitor& visitor) {
    const osg::Camera* const stage = stageCamera(visitor);
    if (stage && drawsShadows(*stage)) return true;
    const osg::NodePath& path = visitor.getNodePath();
    for (auto node = path.rbegin(); node != path.rend(); ++node) {
        const osg::Camera* camera = (*node)->asCamera();
        if (!camera) continue;
        if (drawsShadows(*camera)) return true;
        if (camera->getReferenceFrame() == osg::Transform::ABSOLUTE_RF) return false;
    }
    return false;
}

// Projections whose lines of sight meet in the origin of eye space.
bool isPerspective(const osg::Matrixd& p) {
    return p(2, 3) != 0.0 && p(0, 3) == 0.0 && p(1, 3) == 0.0 && p(3, 3) == 0.0 && p(3, 0) == 0.0 && p(3, 1) == 0.0;
}

// Projections whose lines of sight are parallel.
bool isOrthographic(const osg::Matrixd& p) {
    return p(0, 3) == 0.0 && p(1, 3) == 0.0 && p(2, 3) == 0.0 && p(3, 3) != 0.0;
}

}  // namespace

osg::Vec3d sightThroughCorner(const osg::Matrixd& p, int corner) {
    const double determinant = p(0, 0) * p(1, 1) - p(1, 0) * p(0, 1);
    const double x = (corner & 1 ? 1.0 : -1.0) * p(2, 3) - p(2, 0);
    const double y = (corner & 2 ? 1.0 : -1.0) * p(2, 3) - p(2, 1);
    return {(x * p(1, 1) - y * p(1, 0)) / determinant, (y * p(0, 0) - x * p(0, 1)) / determinant, 1.0};
}

namespace {

// How far the near plane of a perspective projection is from the eye at most; infinite when in doubt. Depths of 0 and 1
// in clip space are at the near plane or beyond it, whether depth is reversed or not and from -1 or from 0.
double reachOfNearPlane(const osg::Matrixd& p, const osg::Matrixd& eyeToWorld) {
    std::array<double, 2> farthest{};  // at depths of 0 and 1
    for (int corner = 0; corner < 4; ++corner) {
        const osg::Vec3d sight = sightThroughCorner(p, corner);
        const double length = osg::Matrixd::transform3x3(sight, eyeToWorld).length();
        for (std::size_t depth = 0; depth < farthest.size(); ++depth) {
            const double z =
                p(3, 2) / (static_cast<double>(depth) * p(2, 3) - p(2, 2) - sight.x() * p(0, 2) - sight.y() * p(1, 2));
            const double distance = z * p(2, 3) > 0.0 ? length * std::abs(z) : std::numeric_limits<double>::infinity();
            if (!(distance <= farthest[depth])) farthest[depth] = distance;
        }
    }
    return std::min(farthest[0], farthest[1]);
}

// The corner of an orthographic picture at which the near plane, which may be tilted, is farthest along the view.
osg::Vec3d farthestOfNearPlane(const osg::Matrixd& unproject, const osg::Vec3d& direction) {
    osg::Vec3d farthest = osg::Vec3d(-1.0, -1.0, -1.0) * unproject;
    for (int corner = 1; corner < 4; ++corner) {
        const osg::Vec3d at = osg::Vec3d(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, -1.0) * unproject;
        if (at * direction > farthest * direction) farthest = at;
    }
    return farthest;
}

// Whether the near plane of the projection cuts what is drawn: not where OSG computes another one, unless it culls by
// this one before, or the planes are computed for shadows alone (osgShadow::ViewDependentShadowMap).
bool isNearPlaneInUse(osg::CullStack& cullStack, osg::NodeVisitor& visitor) {
    const osg::Camera* const camera = stageCamera(visitor);
    return isFinalProjection(cullStack) ||
           (cullStack.getCurrentCullingSet().getCullingMask() & osg::CullingSet::NEAR_PLANE_CULLING) ||
           (camera && camera->getComputeNearFarMode() == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
}

// A lower bound; scaled to the unit sphere, lengths shrink by the smaller radius at least.
double distanceTo(const core::Ellipsoid& ellipsoid, double depth, const glm::dvec3& eye) {
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    const double smaller = std::min(a, b);
    return (glm::length(eye / glm::dvec3(a, a, b)) - (1.0 - depth / smaller)) * smaller;
}

}  // namespace

bool isFinalProjection(const osg::CullStack& cullStack) {
    return cullStack.getComputeNearFarMode() == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
}

bool hasTiltedPlanes(const osg::Matrixd& projection) noexcept {
    return projection(0, 2) != 0.0 || projection(1, 2) != 0.0;
}

std::optional<Viewpoint> Viewpoint::of(osg::CullStack& cullStack, osg::NodeVisitor& visitor, bool inShadowPasses) {
    if (!hasFineDepthBuffer(visitor) || (!inShadowPasses && isShadowPass(visitor))) return std::nullopt;
    const osg::Matrixd& projection = *cullStack.getProjectionMatrix();
    const auto inverse = affineInverse(*cullStack.getModelViewMatrix());
    // near and far planes in one place make numbers that are not finite
    if (!inverse || !hasFiniteNumbers(projection)) return std::nullopt;
    const osg::Matrixd& eyeToWorld = *inverse;
    Viewpoint viewpoint;
    if (isPerspective(projection)) {
        // what is farther away has the greater depth, except where depth is reversed
        if (!(projection(3, 2) < 0.0)) return std::nullopt;
        // in double precision; the cull stack's own eye point is float
        const osg::Vec3d eye = osg::Vec3d() * eyeToWorld;
        viewpoint._point = toGlm(eye);
        if (isNearPlaneInUse(cullStack, visitor)) viewpoint._nearReach = reachOfNearPlane(projection, eyeToWorld);
        return viewpoint;
    }
    osg::Matrixd unproject;
    if (!isOrthographic(projection) || !unproject.invert(projection)) return std::nullopt;
    const osg::Vec3d direction = osg::Vec3d(0.0, 0.0, 1.0) * unproject - osg::Vec3d(0.0, 0.0, -1.0) * unproject;
    // the projection does not tell reversed depth from a reversed viewing direction
    if (!(direction.z() < 0.0)) return std::nullopt;
    if (hasTiltedPlanes(projection) && !isFinalProjection(cullStack)) return std::nullopt;
    osg::Vec3d start = farthestOfNearPlane(unproject, direction);
    // With near and far computed, what is wholly behind the eye is not drawn and hides nothing.
    if (!isFinalProjection(cullStack) && start.z() > 0.0) start += direction * (start.z() / -direction.z());
    viewpoint._isDirection = true;
    viewpoint._point = toGlm(start * eyeToWorld);
    viewpoint._direction = toGlm(osg::Matrixd::transform3x3(direction, eyeToWorld));
    return viewpoint;
}

double Viewpoint::nearReach() const noexcept {
    return _nearReach > 0.0 ? _nearReach : std::numeric_limits<double>::infinity();
}

std::optional<core::HorizonEye> Viewpoint::above(const core::Ellipsoid& ellipsoid, double depth) const noexcept {
    if (_isDirection) {
        // a near plane that cuts the globe shows its inside, so no deeper occluder may be used
        if (!core::HorizonEye::fromDirection(ellipsoid, 0.0, _direction, _point)) return std::nullopt;
        return core::HorizonEye::fromDirection(ellipsoid, depth, _direction, _point);
    }
    if (_nearReach > 0.0 && !(_nearReach < distanceTo(ellipsoid, depth, _point))) return std::nullopt;
    return core::HorizonEye::fromEye(ellipsoid, depth, _point);
}

}  // namespace osgAnalyticBin
