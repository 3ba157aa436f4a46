// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A real cull traversal without a window.

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Camera>
#include <osg/CollectOccludersVisitor>
#include <osg/FrameStamp>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Viewport>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace osgAnalyticBin::test {

/// A camera: what osgViewer hands to its cull visitor.
struct CullView {
    osg::Matrixd modelView;
    osg::Matrixd projection;
    osg::ref_ptr<osg::Camera> camera;              // what the render stage says it draws for; may be null
    osg::ref_ptr<osg::StateSet> states;            // above the scene; may be null; the viewport is added to them
    osg::ref_ptr<osgUtil::RenderStage> sameStage;  // that is used in each traversal; null: another one
    osg::ref_ptr<osg::RefMatrix> sameProjection;   // the same of the object with the matrix
    osg::CullSettings::CullingMode cullingMode = osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING;
    osg::CullSettings::ComputeNearFarMode computeNearFar = osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;

    /// Perspective with the given vertical field of view, aspect 1.
    static CullView lookAt(const osg::Vec3d& eye, const osg::Vec3d& center, const osg::Vec3d& up, double fovDeg) {
        CullView view;
        view.modelView = osg::Matrixd::lookAt(eye, center, up);
        view.projection = osg::Matrixd::perspective(fovDeg, 1.0, 1.0, 1e8);
        return view;
    }

    [[nodiscard]] std::vector<osg::Plane> sidePlanes() const {
        osg::Polytope frustum;
        frustum.setToUnitFrustum(false, false);
        frustum.transformProvidingInverse(modelView * projection);
        return frustum.getPlaneList();
    }
};

/// What a cull traversal leaves to draw.
struct CullResult {
    std::set<const osg::Drawable*> drawn;  // by the view itself, not by cameras that render to textures
    osg::Matrixd projection;               // with the near and far planes that were computed, if any
    // To draw it, until the visitor's next traversal.
    osg::ref_ptr<osgUtil::StateGraph> stateGraph;
    osg::ref_ptr<osgUtil::RenderStage> stage;
};

/// A leaf of a render bin: the drawable, its matrix, its depth, the states above it. The projection is not compared.
struct Leaf {
    const osg::Drawable* drawable;
    osg::Matrixd matrix;
    float depth;
    std::vector<const osg::StateSet*> states;
    osg::Matrixd projection;

    bool operator==(const Leaf& other) const {
        return drawable == other.drawable && matrix == other.matrix && depth == other.depth && states == other.states;
    }
};

/// The leaves of a render bin and those in it, in the order in which they were delivered.
inline std::vector<Leaf> leavesIn(osgUtil::RenderBin& bin) {
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

inline void collectOccluders(osg::Node& scene, const CullView& view, osg::Viewport* viewport,
                             osgUtil::CullVisitor& visitor) {
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

inline void collectDrawn(const osgUtil::RenderBin& bin, std::set<const osg::Drawable*>& drawn) {
    // a traversal that is not sorted leaves all in graphs of states
    for (const osgUtil::StateGraph* graph : const_cast<osgUtil::RenderBin&>(bin).getStateGraphList())
        for (const auto& leaf : graph->_leaves) drawn.insert(leaf->getDrawable());
    for (const auto& [number, child] : const_cast<osgUtil::RenderBin&>(bin).getRenderBinList())
        collectDrawn(*child, drawn);
}

/// Runs one cull traversal, as osgUtil::SceneView does; occluders in the scene take part. `time`: in seconds.
inline CullResult cull(osg::Node& scene, const CullView& view, osgUtil::CullVisitor& visitor, unsigned int frame = 1,
                       double time = 0.0) {
    const osg::ref_ptr<osg::Viewport> viewport = new osg::Viewport(0, 0, 512, 512);
    const osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
    stamp->setFrameNumber(frame);
    stamp->setReferenceTime(time);
    const osg::ref_ptr<osgUtil::StateGraph> stateGraph = new osgUtil::StateGraph;
    const auto stage = view.sameStage ? view.sameStage : osg::ref_ptr(new osgUtil::RenderStage);
    stage->reset();
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
    const auto projection =
        view.sameProjection ? view.sameProjection : osg::ref_ptr(new osg::RefMatrix(view.projection));
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
/// By a visitor of its own.
inline CullResult cull(osg::Node& scene, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    return cull(scene, view, *visitor);
}

[[nodiscard]] inline CullOptions by(Method method) {
    CullOptions options;
    options.method = method;
    return options;
}

/// From option text that is right.
[[nodiscard]] inline CullOptions optionsOf(const std::string& text) {
    std::string error;
    const auto options = cullOptionsFromText(text, error);
    if (!options) throw std::invalid_argument(error);
    return *options;
}

/// Does something, if anything, before its node is traversed.
struct Before : osg::NodeCallback {
    using Action = std::function<void(osgUtil::CullVisitor&)>;
    explicit Before(Action what = {}) : action(std::move(what)) {}
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        if (action && nv->asCullVisitor()) action(*nv->asCullVisitor());
        traverse(node, nv);
    }
    const Action action;
};

/// Notes that the cull traversal reached it; put behind a bin's callback as a nested one.
struct VisitRecorder : Before {
    VisitRecorder(const std::string& name, std::set<std::string>& visited)
        : Before([name, &visited](auto&) { visited.insert(name); }) {}
};

/// The 128 start tiles, 22.5 degrees wide, with altitudes -500 .. 9000 m.
inline std::vector<AnalyticBin> startTiles() {
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

/// Points of the bin on a grid of n x n x 3, in ECEF.
inline std::vector<osg::Vec3d> samples(const AnalyticBin& bin, int n,
                                       const osg::EllipsoidModel& ellipsoid = osg::EllipsoidModel()) {
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
