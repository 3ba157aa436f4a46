// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ForeignTraversal.h"

#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osgUtil/CullVisitor>
#include <osgViewer/View>

namespace osgAnalyticBin {

namespace {

bool draws(osg::Camera& camera) {
    const CameraCulling* culling = CameraCulling::find(camera);
    return camera.getGraphicsContext() && camera.getViewport() && !(culling && culling->isFollowing());
}

}  // namespace

CameraCulling::CameraCulling() : _overlay(new osg::Group) {
    // DYNAMIC meshes are drawn before they change; near and far planes are the scene's alone
    _overlay->setCullingActive(false);
    constexpr GLenum kDepthClamp = 0x864F;
    _overlay->getOrCreateStateSet()->setMode(kDepthClamp, osg::StateAttribute::ON);
    _overlay->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
}

CameraCulling::~CameraCulling() = default;

CameraCulling* CameraCulling::find(osg::Camera& camera) {
    for (osg::Callback* callback = camera.getCullCallback(); callback; callback = callback->getNestedCallback()) {
        if (auto* found = dynamic_cast<CameraCulling*>(callback)) return found;
    }
    return nullptr;
}

CameraCulling& CameraCulling::of(osg::Camera& camera) {
    if (CameraCulling* known = find(camera)) return *known;
    const osg::ref_ptr<CameraCulling> made = new CameraCulling;
    camera.addCullCallback(made);
    return *made;
}

std::vector<osg::Camera*> CameraCulling::drawingCameras(osgViewer::View& view) {
    std::vector<osg::Camera*> cameras;
    if (draws(*view.getCamera())) cameras.push_back(view.getCamera());
    for (unsigned int i = 0; i < view.getNumSlaves(); ++i) {
        const osg::View::Slave& slave = view.getSlave(i);
        if (slave._useMastersSceneData && slave._camera && draws(*slave._camera)) cameras.push_back(slave._camera);
    }
    return cameras;
}

std::optional<CullingView> CameraCulling::foreignView() const {
    if (_frozen) return _frozen;
    osg::ref_ptr<osg::Camera> followed;
    if (!_followed.lock(followed)) return std::nullopt;
    return _followedView ? *_followedView : cullingView(*followed);
}

void CameraCulling::updateFollowed() {
    osg::ref_ptr<osg::Camera> followed;
    if (_followed.lock(followed)) _followedView = cullingView(*followed);
}

CullingView CameraCulling::cullingView(osg::Camera& camera) {
    const CameraCulling* culling = find(camera);
    const std::optional<CullingView> foreign = culling ? culling->foreignView() : std::nullopt;
    if (foreign) return *foreign;
    return {camera.getViewMatrix(), camera.getProjectionMatrix(), camera.getViewport()};
}

void CameraCulling::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osgUtil::CullVisitor* visitor = nv->asCullVisitor();
    if (!visitor) {
        traverse(node, nv);
        return;
    }
    if (const auto view = foreignView()) {
        traverseBy(*view, *visitor, [&] { traverse(node, nv); });
    } else {
        traverse(node, nv);
    }
    drawOverlay(*visitor);
    osg::ref_ptr<osg::Camera> followed;
    const CameraCulling* other = _followed.lock(followed) ? find(*followed) : nullptr;
    if (other && other != this) other->drawOverlay(*visitor);
}

void CameraCulling::resizeGLObjectBuffers(unsigned int size) {
    _overlay->resizeGLObjectBuffers(size);
}

// The next window gets the number of a closed one: nothing may be left of that.
void CameraCulling::releaseGLObjects(osg::State* state) const {
    _overlay->releaseGLObjects(state);
    osg::ref_ptr<osg::Camera> followed;
    const CameraCulling* other = _followed.lock(followed) ? find(*followed) : nullptr;
    if (other && other != this) other->_overlay->releaseGLObjects(state);
}

void CameraCulling::drawOverlay(osgUtil::CullVisitor& visitor) const {
    if (_overlay->getNumChildren() == 0) return;
    const auto mode = visitor.getComputeNearFarMode();
    visitor.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    _overlay->accept(visitor);
    visitor.setComputeNearFarMode(mode);
}

}  // namespace osgAnalyticBin
