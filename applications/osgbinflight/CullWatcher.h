// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Billboard>
#include <osg/Camera>
#include <osg/Geode>
#include <osg/LOD>
#include <osg/Projection>
#include <osgUtil/CullVisitor>

#include <cstdint>

namespace osgAnalyticBin::flight {

/// Takes the requests of PagedLODs, and does nothing but count them.
class RequestCounter : public osg::NodeVisitor::DatabaseRequestHandler {
public:
    void requestNodeFile(const std::string&, osg::NodePath&, float, const osg::FrameStamp*,
                         osg::ref_ptr<osg::Referenced>&, const osg::Referenced*) override {
        ++count;
    }
    std::uint64_t count = 0;
};

/// What osgUtil::SceneView keeps from frame to frame for its cull stage, without a window.
class CullStage {
public:
    /// `files` takes the requests of PagedLODs.
    explicit CullStage(osg::NodeVisitor::DatabaseRequestHandler& files) { _visitor->setDatabaseRequestHandler(&files); }

    /// Culls a camera's scene as osgViewer does before it draws, and sorts what is found.
    /// Requires: a camera with a viewport, and no update traversal meanwhile. Returns: how long it took, milliseconds.
    double cull(osg::Camera& camera, osg::FrameStamp& frameStamp);

private:
    osg::ref_ptr<osgUtil::CullVisitor> _visitor = new osgUtil::CullVisitor;
    osg::ref_ptr<osgUtil::StateGraph> _stateGraph = new osgUtil::StateGraph;
    osg::ref_ptr<osgUtil::RenderStage> _stage = new osgUtil::RenderStage;
};

/// Culls a camera's scene once more, off the record: nothing is drawn and no file is asked for, but a derived class
/// sees what is reached and what is drawn. Because only OSG's own calls are watched, that is alike for every culling
/// method.
/// Requires: a camera with a viewport, and no update traversal meanwhile; drawing may go on.
/// Cost: one cull traversal.
class CullWatcher : public osgUtil::CullVisitor {
public:
    /// Traverses the scene as `frameStamp`'s frame shows it. To be called once.
    void watch(osg::Camera& camera, osg::FrameStamp& frameStamp);

    using osgUtil::CullVisitor::apply;
    void apply(osg::Node& node) override { visit(node); }
    void apply(osg::Geode& node) override { visit(node); }
    void apply(osg::Group& node) override { visit(node); }
    void apply(osg::LOD& node) override { visit(node); }
    void apply(osg::Transform& node) override { visit(node); }
    void apply(osg::Projection& node) override { visit(node); }
    void apply(osg::Camera& node) override { visit(node); }
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Billboard& node) override;

protected:
    CullWatcher();

    /// The traversal comes to a node, drawables included, before any test; getNodePath() ends with it.
    virtual void enter(osg::Node& node) = 0;
    /// The same node again, after its children; not called for drawables and billboards.
    virtual void leave(osg::Node& node) = 0;
    /// A drawable went to the render bins; the model-view matrix is its own.
    virtual void draw(osg::Drawable& drawable) = 0;

    /// Files that PagedLODs asked for: not loaded yet.
    [[nodiscard]] std::uint64_t wanted() const { return _wanted->count; }

private:
    template <class NodeType>
    void visit(NodeType& node) {
        enter(node);
        osgUtil::CullVisitor::apply(node);
        leave(node);
    }

    osg::ref_ptr<RequestCounter> _wanted;
};

/// Triangles of a drawable's primitives.
[[nodiscard]] std::uint64_t trianglesOf(osg::Drawable& drawable);

}  // namespace osgAnalyticBin::flight
