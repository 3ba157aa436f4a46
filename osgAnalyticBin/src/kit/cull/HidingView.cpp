// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "HidingView.h"

#include "../DepthBuffer.h"
#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../Spheres.h"
#include "Viewpoint.h"

#include <osgUtil/RenderStage>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace osgAnalyticBin {

namespace {

// Of a pixel: twice the step to which drivers snap the corners of triangles, as in the search for tiles behind terrain.
constexpr double kDrawing = 1.0 / 128.0;

// The rounding of spheres, and of the positions that drivers compute: both are floats.
constexpr double kRounding = 0x1p-20;

bool areEqual(const osg::Matrixd& a, const osg::Matrixd& b) {
    return std::memcmp(a.ptr(), b.ptr(), 16 * sizeof(double)) == 0;
}

osgUtil::RenderStage* stageOf(osgUtil::CullVisitor& visitor) {
    osgUtil::RenderBin* const bin = visitor.getCurrentRenderBin();
    return bin ? bin->getStage() : nullptr;
}

const osg::RefMatrix* viewOf(osgUtil::CullVisitor& visitor) {
    osgUtil::RenderStage* const stage = stageOf(visitor);
    return stage ? stage->getInitialViewMatrix() : nullptr;
}

// The angle that a pixel takes in the middle of the picture, where it is largest; infinite where it is not known.
double pixelOf(osgUtil::CullVisitor& visitor) {
    const osg::Viewport* const viewport = visitor.getViewport();
    const osg::Matrixd& projection = *visitor.getProjectionMatrix();
    if (!viewport) return HUGE_VAL;
    return 2.0 /
           std::min(std::abs(projection(0, 0)) * viewport->width(), std::abs(projection(1, 1)) * viewport->height());
}

}  // namespace

HidingView::Picture HidingView::Picture::of(osgUtil::CullVisitor& visitor) {
    Picture picture;
    picture.frame = visitor.getTraversalNumber();
    picture.stage = stageOf(visitor);
    picture.projection = visitor.getProjectionMatrix();
    picture.projectionThen = *picture.projection;
    picture.view = viewOf(visitor);
    if (picture.view) picture.viewThen = *picture.view;
    picture.conditions = TileSelection::Conditions::of(visitor, visitor);
    return picture;
}

bool HidingView::Picture::isOf(osgUtil::CullVisitor& visitor) const {
    return frame == visitor.getTraversalNumber() && projection == visitor.getProjectionMatrix() &&
           stage == stageOf(visitor) && view == viewOf(visitor) && areEqual(projectionThen, *projection) &&
           (!view || areEqual(viewThen, *view)) && conditions == TileSelection::Conditions::of(visitor, visitor);
}

void HidingView::set(osgUtil::CullVisitor& visitor, const Known& known) {
    clear();
    const auto culling = visitor.getCurrentCullingSet().getCullingMask();
    if (!(culling & osg::CullingSet::VIEW_FRUSTUM_CULLING)) return;
    _picture = Picture::of(visitor);
    _ecefToEye = *visitor.getModelViewMatrix();
    _eyeToEcef.reset();
    _drawing = kDrawing * pixelOf(visitor);
    // A near plane that OSG computes is no nearer than the ratio times a depth that is drawn.
    _isStepRelative = !isFinalProjection(visitor);
    _depthStep =
        kDepthStep / (_isStepRelative ? visitor.getNearFarRatio() : depthScaleOf(*visitor.getProjectionMatrix()));
    _above = nullptr;
    _known = known;
}

// Only when a node asks: most scenes have none that does.
bool HidingView::findFrame() {
    if (_eyeToEcef) return true;
    _eyeToEcef = affineInverse(_ecefToEye);
    if (_eyeToEcef) _scale = stretchOf(*_eyeToEcef);
    return _eyeToEcef.has_value();
}

bool HidingView::isInUse(const osg::NodeVisitor& visitor) const {
    constexpr unsigned int kLately = 64;
    return _askedIn != 0 && visitor.getTraversalNumber() - _askedIn < kLately;
}

bool HidingView::takeWorth() {
    // a model saves several microseconds of drawing; see noteHidden() for what a search takes
    constexpr unsigned int kMany = 16;
    const bool isWorth = _hidden >= kMany || (_hidden > 0 && 4 * _hidden >= _asked);
    _asked = _hidden = 0;
    return isWorth;
}

bool HidingView::hides(osgUtil::CullVisitor& visitor, const osg::BoundingSphere& sphere,
                       const osg::Matrixd& localToEye) {
    _askedIn = std::max(1u, visitor.getTraversalNumber());
    ++_asked;
    if (!_known || !sphere.valid() || !isAffine(localToEye) || !_picture.isOf(visitor) || !findFrame()) return false;
    const osg::Vec3d local(sphere.center()), inEye = local * localToEye;
    const double float32 = kRounding * (local.length() + static_cast<double>(sphere.radius()));
    const double distance = _scale * inEye.length();
    const double radius =
        _scale * stretchOf(localToEye) * (static_cast<double>(sphere.radius()) + float32) + kRounding * distance;
    const glm::dvec3 centre = toGlm(inEye * *_eyeToEcef);
    const bool isBeyond = isBehindHorizon(centre, radius + _drawing * distance, distance);
    const bool isHidden =
        _known->hider ? _known->hider->hidesBall(centre, radius, isBeyond) : isBeyond && !_known->isCutOpen;
    if (isHidden && _known->hider) ++_hidden;
    return isHidden;
}

bool HidingView::isBehindHorizon(const glm::dvec3& centre, double radius, double distance) const {
    if (!_known->eye) return false;
    const double share = _known->eye->shareBefore(_known->ellipsoid, centre, radius);
    // 1 / z of what is drawn less that of the sphere
    const double step = _isStepRelative ? _depthStep : _depthStep * share * (distance + radius) / _scale;
    return 1.0 - share > step;
}

DrawnState HidingView::stateAbove(osgUtil::CullVisitor& visitor, const StateRules& rules) {
    const osgUtil::StateGraph* const graph = visitor.getCurrentStateGraph();
    if (!graph) return {false, false};
    if (!_above || graph->_parent != _above) {
        _above = graph->_parent;
        _stateAbove = drawnStates(_above, nullptr, rules);
        _isDepthTestKnownAbove = saysDepthTest(visitor, _above);
    }
    if (!_isDepthTestKnownAbove && !saysDepthTest(visitor, graph)) return {false, false};
    DrawnState drawn = drawnStates(graph, _above, rules);
    drawn &= _stateAbove;
    return drawn;
}

}  // namespace osgAnalyticBin
