// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A real cull traversal without a window.

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Camera>
#include <osg/Group>
#include <osgUtil/CullVisitor>

#include <functional>
#include <set>

namespace osgAnalyticBin::test {

/// A camera: what osgViewer hands to its cull visitor.
struct CullView {
    osg::Matrixd modelView;
    osg::Matrixd projection;
    osg::ref_ptr<osg::Camera> camera;    // what the render stage says it draws for; may be null
    osg::ref_ptr<osg::StateSet> states;  // above the scene; may be null; the viewport is added to them
    osg::CullSettings::CullingMode cullingMode = osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING;
    osg::CullSettings::ComputeNearFarMode computeNearFar = osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;

    /// Perspective with the given vertical field of view, aspect 1.
    static CullView lookAt(const osg::Vec3d& eye, const osg::Vec3d& center, const osg::Vec3d& up, double fovDeg);

    [[nodiscard]] std::vector<osg::Plane> sidePlanes() const;
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
std::vector<Leaf> leavesIn(osgUtil::RenderBin& bin);

/// Runs one cull traversal, as osgUtil::SceneView does; occluders in the scene take part. `time`: of the frame, in
/// seconds.
CullResult cull(osg::Node& scene, const CullView& view, osgUtil::CullVisitor& visitor, unsigned int frame = 1,
                double time = 0.0);
/// By a visitor of its own.
CullResult cull(osg::Node& scene, const CullView& view);

[[nodiscard]] CullOptions by(Method method);

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
std::vector<AnalyticBin> startTiles();

/// Points of the bin on a grid of n x n x 3, in ECEF.
std::vector<osg::Vec3d> samples(const AnalyticBin& bin, int n,
                                const osg::EllipsoidModel& ellipsoid = osg::EllipsoidModel());

}  // namespace osgAnalyticBin::test
