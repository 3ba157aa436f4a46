// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullFixture.h"

#include <osg/CollectOccludersVisitor>
#include <osg/FrameStamp>
#include <osg/Geometry>
#include <osg/Viewport>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <iterator>
#include <utility>

namespace osgAnalyticBin::test {

CullView CullView::lookAt(const osg::Vec3d& eye, const osg::Vec3d& center, const osg::Vec3d& up, double fovDeg) {
    CullView view;
    view.modelView = osg::Matrixd::lookAt(eye, center, up);
    view.projection = osg::Matrixd::perspective(fovDeg, 1.0, 1.0, 1e8);
    return view;
}

std::vector<osg::Plane> CullView::sidePlanes() const {
    osg::Polytope frustum;
    frustum.setToUnitFrustum(false, false);
    frustum.transformProvidingInverse(modelView * projection);
    return frustum.getPlaneList();
}

namespace {

void collectOccluders(osg::Node& scene, const CullView& view, osg::Viewport* viewport, osgUtil::CullVisitor& visitor) {
    osg::ref_ptr<osg::CollectOccludersVisitor> collector = new osg::CollectOccludersVisitor;
    collector->setCullingMode(view.cullingMode);
    collector->pushViewport(viewport);
    collector->pushProjectionMatrix(new osg::RefMatrix(view.projection));
    collector->pushModelViewMatrix(new osg::RefMatrix(view.modelView), osg::Transform::ABSOLUTE_RF);
    scene.accept(*collector);
    collector->popModelViewMatrix();
    collector->popProjectionMatrix();
    collector->popViewport();
    collector->removeOccludedOccluders();
    visitor.getOccluderList().clear();
    std::copy(collector->getCollectedOccluderSet().begin(), collector->getCollectedOccluderSet().end(),
              std::back_inserter(visitor.getOccluderList()));
}

void collectDrawn(const osgUtil::RenderBin& bin, std::set<const osg::Drawable*>& drawn) {
    // a traversal that is not sorted leaves all in graphs of states
    for (const osgUtil::StateGraph* graph : const_cast<osgUtil::RenderBin&>(bin).getStateGraphList())
        for (const auto& leaf : graph->_leaves) drawn.insert(leaf->getDrawable());
    for (const auto& [number, child] : const_cast<osgUtil::RenderBin&>(bin).getRenderBinList())
        collectDrawn(*child, drawn);
}

}  // namespace

std::vector<Leaf> leavesIn(osgUtil::RenderBin& bin) {
    std::vector<std::pair<unsigned int, Leaf>> found;
    const std::function<void(osgUtil::RenderBin&)> collect = [&](osgUtil::RenderBin& from) {
        for (const osgUtil::StateGraph* graph : from.getStateGraphList()) {
            std::vector<const osg::StateSet*> states;
            for (const auto* above = graph; above; above = above->_parent) states.push_back(above->getStateSet());
            for (const auto& leaf : graph->_leaves)
                found.push_back({leaf->_traversalOrderNumber,
                                 {leaf->getDrawable(), *leaf->_modelview, leaf->_depth, states, *leaf->_projection}});
        }
        for (const auto& [number, child] : from.getRenderBinList()) collect(*child);
    };
    collect(bin);
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Leaf> leaves;
    for (auto& [order, leaf] : found) leaves.push_back(std::move(leaf));
    return leaves;
}

CullResult cull(osg::Node& scene, const CullView& view, osgUtil::CullVisitor& visitor, unsigned int frame,
                double time) {
    const osg::ref_ptr<osg::Viewport> viewport = new osg::Viewport(0, 0, 512, 512);
    const osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
    stamp->setFrameNumber(frame);
    stamp->setReferenceTime(time);
    const osg::ref_ptr<osgUtil::StateGraph> stateGraph = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    stage->setViewport(viewport.get());
    stage->setCamera(view.camera.get());

    visitor.reset();
    visitor.setFrameStamp(stamp.get());
    visitor.setTraversalNumber(frame);
    visitor.setCullingMode(view.cullingMode);
    visitor.setComputeNearFarMode(view.computeNearFar);
    visitor.setStateGraph(stateGraph.get());
    visitor.setRenderStage(stage.get());
    if (view.cullingMode & osg::CullSettings::SHADOW_OCCLUSION_CULLING)
        collectOccluders(scene, view, viewport.get(), visitor);
    visitor.pushViewport(viewport.get());
    const osg::ref_ptr<osg::RefMatrix> projection = new osg::RefMatrix(view.projection);
    visitor.pushProjectionMatrix(projection.get());
    visitor.pushModelViewMatrix(new osg::RefMatrix(view.modelView), osg::Transform::ABSOLUTE_RF);
    if (view.states) {
        view.states->setAttribute(viewport);
        visitor.pushStateSet(view.states);
    }
    scene.accept(visitor);
    if (view.states) visitor.popStateSet();
    visitor.popModelViewMatrix();
    visitor.popProjectionMatrix();
    visitor.popViewport();
    CullResult result;
    result.projection = *projection;
    collectDrawn(*stage, result.drawn);
    result.stateGraph = stateGraph;
    result.stage = stage;
    return result;
}

CullResult cull(osg::Node& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    return cull(scene, view, *visitor);
}

CullOptions by(Method method) {
    CullOptions options;
    options.method = method;
    return options;
}

std::vector<AnalyticBin> startTiles() {
    std::vector<AnalyticBin> tiles;
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            const double south = -90.0 + 22.5 * y;
            const double west = -180.0 + 22.5 * x;
            tiles.emplace_back(
                core::GeodeticBin::fromDegrees({south, south + 22.5}, {west, west + 22.5}, {-500.0, 9000.0}));
        }
    }
    return tiles;
}

std::vector<osg::Vec3d> samples(const AnalyticBin& bin, int n, const osg::EllipsoidModel& ellipsoid) {
    std::vector<osg::Vec3d> points;
    const auto at = [](const core::Interval& interval, int i, int count) {
        return interval.lower + interval.width() * i / (count - 1);
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < 3; ++k) {
                osg::Vec3d p;
                ellipsoid.convertLatLongHeightToXYZ(at(bin.bin().latitude(), i, n), at(bin.bin().longitude(), j, n),
                                                    at(bin.bin().altitude(), k, 3), p.x(), p.y(), p.z());
                points.push_back(p);
            }
        }
    }
    return points;
}

}  // namespace osgAnalyticBin::test
