// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kit/CallbackChain.h"

#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osg/PolygonMode>
#include <osgUtil/CullVisitor>
#include <osgUtil/PositionalStateContainer>
#include <osgUtil/RenderLeaf>
#include <osgUtil/StateGraph>
#include <osgViewer/View>

#include <cstddef>
#include <functional>
#include <map>

namespace osgAnalyticBin {

namespace {

bool draws(osg::Camera& camera) {
    return camera.getGraphicsContext() && camera.getViewport();
}

using AttributeList = osgUtil::PositionalStateContainer::AttrMatrixList;

// Moves the drawables that the other view collected to the visitor's own view.
class Mover {
public:
    Mover(osgUtil::CullVisitor& visitor, const CullingView& other, const osg::RefMatrix* otherProjection)
        : _visitor(visitor),
          _otherProjection(otherProjection),
          _otherToOwn(osg::Matrixd::inverse(other.view) * *visitor.getModelViewMatrix()) {}

    void moveLeaves(osgUtil::StateGraph& graph) {
        for (const auto& leaf : graph._leaves) moveLeaf(*leaf);
        for (const auto& child : graph._children) moveLeaves(*child.second);
    }

    void moveAttributes(AttributeList& attributes, std::size_t first) {
        for (std::size_t i = first; i < attributes.size(); ++i) {
            if (attributes[i].second) attributes[i].second = moved(*attributes[i].second);
        }
    }

private:
    void moveLeaf(osgUtil::RenderLeaf& leaf) {
        // cameras inside the scene have projections of their own
        if (leaf._projection != _otherProjection || !leaf._modelview) return;
        leaf._projection = _visitor.getProjectionMatrix();
        leaf._modelview = moved(*leaf._modelview);
        if (_visitor.getComputeNearFarMode() == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR) return;
        // the visitor finds the nearest corner of a box by the matrix that was pushed last
        _visitor.pushModelViewMatrix(leaf._modelview.get(), osg::Transform::RELATIVE_RF);
        (void)_visitor.updateCalculatedNearFar(*leaf._modelview, leaf.getDrawable()->getBoundingBox());
        _visitor.popModelViewMatrix();
    }

    osg::RefMatrix* moved(osg::RefMatrix& matrix) {
        osg::ref_ptr<osg::RefMatrix>& known = _moved[&matrix];
        if (!known) known = new osg::RefMatrix(matrix * _otherToOwn);
        return known.get();
    }

    osgUtil::CullVisitor& _visitor;
    const osg::RefMatrix* const _otherProjection;
    const osg::Matrixd _otherToOwn;
    std::map<osg::ref_ptr<osg::RefMatrix>, osg::ref_ptr<osg::RefMatrix>> _moved;
};

// Runs a part of a cull traversal with another view, and moves the drawables that it collects into the visitor's own
// view.
void traverseBy(const CullingView& view, osgUtil::CullVisitor& visitor, const std::function<void()>& traverse) {
    const osg::ref_ptr<osg::RefMatrix> projection = new osg::RefMatrix(view.projection);
    const osg::ref_ptr<osg::RefMatrix> modelView = new osg::RefMatrix(view.view);
    const osg::ref_ptr<osg::Viewport> viewport = view.viewport ? view.viewport.get() : visitor.getViewport();
    osgUtil::PositionalStateContainer& state = *visitor.getRenderStage()->getPositionalStateContainer();
    AttributeList& attributes = state.getAttrMatrixList();
    const std::size_t firstAttribute = attributes.size();
    std::map<unsigned int, std::size_t> firstTextureAttributes;
    for (const auto& [unit, list] : state.getTexUnitAttrMatrixListMap()) firstTextureAttributes[unit] = list.size();
    const auto nearPlane = visitor.getCalculatedNearPlane();
    const auto farPlane = visitor.getCalculatedFarPlane();

    visitor.pushViewport(viewport);
    visitor.pushProjectionMatrix(projection);
    visitor.pushModelViewMatrix(modelView, osg::Transform::ABSOLUTE_RF);
    traverse();
    visitor.popModelViewMatrix();
    visitor.popProjectionMatrix();
    visitor.popViewport();

    visitor.setCalculatedNearPlane(nearPlane);
    visitor.setCalculatedFarPlane(farPlane);
    Mover mover(visitor, view, projection);
    mover.moveLeaves(*visitor.getRootStateGraph());
    mover.moveAttributes(attributes, firstAttribute);
    for (auto& [unit, list] : state.getTexUnitAttrMatrixListMap()) {
        mover.moveAttributes(list, firstTextureAttributes[unit]);
    }
}

}  // namespace

CameraCulling::CameraCulling() : _overlay(new osg::Group) {
    declare();
    // DYNAMIC meshes are drawn before they change; near and far planes are the scene's alone
    _overlay->setCullingActive(false);
    constexpr GLenum kDepthClamp = 0x864F;
    _overlay->getOrCreateStateSet()->setMode(kDepthClamp, osg::StateAttribute::ON);
    _overlay->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
    // text stays readable where the scene is shown as lines
    _overlay->getOrCreateStateSet()->setAttribute(new osg::PolygonMode,
                                                  osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
}

CameraCulling::~CameraCulling() = default;

// By its own view the camera is culled as without this callback: what terrain hides does not depend on it.
void CameraCulling::declare() {
    setTraversesAlways(*this, !_frozen);
}

CameraCulling* CameraCulling::find(osg::Camera& camera) {
    return findCallback<CameraCulling>(camera.getCullCallback());
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

CullingView CameraCulling::cullingView(osg::Camera& camera) {
    const CameraCulling* culling = find(camera);
    if (culling && culling->_frozen) return *culling->_frozen;
    return {camera.getViewMatrix(), camera.getProjectionMatrix(), camera.getViewport()};
}

void CameraCulling::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osgUtil::CullVisitor* visitor = nv->asCullVisitor();
    if (!visitor) {
        traverse(node, nv);
        return;
    }
    if (_frozen) {
        traverseBy(*_frozen, *visitor, [&] { traverse(node, nv); });
    } else {
        traverse(node, nv);
    }
    drawOverlay(*visitor);
}

void CameraCulling::resizeGLObjectBuffers(unsigned int size) {
    _overlay->resizeGLObjectBuffers(size);
}

// The next window gets the number of a closed one: nothing may be left of that.
void CameraCulling::releaseGLObjects(osg::State* state) const {
    _overlay->releaseGLObjects(state);
}

void CameraCulling::drawOverlay(osgUtil::CullVisitor& visitor) const {
    if (_overlay->getNumChildren() == 0) return;
    const auto mode = visitor.getComputeNearFarMode();
    visitor.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    _overlay->accept(visitor);
    visitor.setComputeNearFarMode(mode);
}

}  // namespace osgAnalyticBin
