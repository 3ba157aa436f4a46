// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Billboard>
#include <osg/Camera>
#include <osg/Drawable>
#include <osg/Geode>
#include <osg/LOD>
#include <osg/Matrixd>
#include <osg/Projection>
#include <osgUtil/CullVisitor>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

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

/// A drawable in the render bins, and where it stands in the world.
struct DrawnMesh {
    osg::ref_ptr<osg::Drawable> drawable;
    osg::Matrixd localToWorld;
};

/// A tile whose own mesh is drawn.
struct DrawnTile {
    /// Which child of which child it is, from the scene's root on, such as "0/1/2": the same for every culling method.
    std::string key;
    std::vector<DrawnMesh> meshes;
    /// The bin by which the kit culls it, as it is shown: for the Terrain's vertical scale, skirts included.
    /// Invalid where the kit has installed none.
    AnalyticBin bin;
};

/// What one cull traversal did with the tiles of a database, whatever the method.
struct TileCounts {
    std::uint64_t tested = 0;     ///< tiles that the traversal reached
    std::uint64_t kept = 0;       ///< tiles whose children it reached
    std::uint64_t drawn = 0;      ///< tiles with geometry of their own in the render bins
    std::uint64_t drawables = 0;  ///< drawables in the render bins
    std::uint64_t triangles = 0;  ///< triangles of those
    std::uint64_t wanted = 0;     ///< files that PagedLODs asked for: not loaded yet
};

/// The same, and what else one looks at.
struct Census : TileCounts {
    std::uint64_t nodes = 0;      ///< nodes and drawables that the traversal reached
    std::uint64_t pagedLods = 0;  ///< PagedLODs among the tiles kept
    std::vector<DrawnTile> tiles;

    [[nodiscard]] std::set<std::string> keys() const;
};

/// How many tiles of a scene are in memory, shown or not. Cost: one traversal of all nodes.
[[nodiscard]] std::uint64_t residentTiles(osg::Node& scene);

/// Takes the census of a camera's scene. The mesh of a PagedLOD is the child that needs no file.
/// Requires: a camera with a viewport, and no update traversal meanwhile.
class TileCensus final : public CullWatcher {
public:
    [[nodiscard]] static Census take(osg::Camera& camera, osg::FrameStamp& frameStamp);

private:
    struct OpenTile {
        const osg::Node* node = nullptr;
        bool kept = false;
        DrawnTile drawn;
    };

    void enter(osg::Node& node) override;
    void leave(osg::Node& node) override;
    void draw(osg::Drawable& drawable) override;

    [[nodiscard]] std::string keyOfPath();

    std::vector<OpenTile> _openTiles;
    Census _census;
};

}  // namespace osgAnalyticBin::flight
