// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileFixture.h"

#include <osg/Camera>
#include <osg/CoordinateSystemNode>
#include <osg/GraphicsContext>
#include <osg/PagedLOD>
#include <osgDB/DatabasePager>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>
#include <osgViewer/CompositeViewer>
#include <osgViewer/Viewer>

#include <cstddef>
#include <support/AnyScene.h>
#include <support/SyntheticDatabase.h>
#include <vector>

namespace osgAnalyticBin::test {

using Threading = osgViewer::ViewerBase::ThreadingModel;

/// osgViewer's own, those that it calls automatic left out.
inline constexpr Threading kThreadingModels[] = {Threading::SingleThreaded, Threading::CullDrawThreadPerContext,
                                                 Threading::DrawThreadPerContext,
                                                 Threading::CullThreadPerCameraDrawThreadPerContext};

[[nodiscard]] inline const char* nameOf(Threading threading) {
    constexpr const char* kNames[] = {"SingleThreaded", "CullDrawThreadPerContext", "DrawThreadPerContext",
                                      "CullThreadPerCameraDrawThreadPerContext", "AutomaticSelection"};
    return kNames[threading];
}

/// Whose a rig's cameras are.
enum class Layout {
    Views,  ///< each of a view of one CompositeViewer, with a context of its own
    Slaves  ///< all of one Viewer, side by side in one context
};

// OSG leaves tiles of osgTerrain that are new or changed, and that the update traversal does not come to, to the cull
// traversals; where several threads cull they all make the mesh at once, and crash, bins or not.
class MeshMaker : public osg::NodeVisitor {
public:
    MeshMaker() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override {
        auto* tile = dynamic_cast<osgTerrain::TerrainTile*>(&node);
        if (!tile) return traverse(node);
        if (_terrain && !tile->getTerrain()) tile->setTerrain(_terrain);
        if (tile->getDirtyMask() != 0) tile->init(tile->getDirtyMask(), true);
    }

    void apply(osg::CoordinateSystemNode& node) override {
        auto* outer = _terrain;
        if (auto* terrain = dynamic_cast<osgTerrain::Terrain*>(&node)) _terrain = terrain;
        apply(static_cast<osg::Node&>(node));
        _terrain = outer;
    }

private:
    osgTerrain::Terrain* _terrain = nullptr;
};

/// A whole osgViewer that draws a scene with its DatabasePager into pbuffers of 64 x 64 pixels for each camera.
/// Needs a display: see canDraw().
class ViewerRig {
public:
    ViewerRig(osg::Node& scene, Threading threading, Layout layout, int cameras)
        : _viewer(layout == Layout::Views ? makeViews(cameras, _views) : makeSlaves(cameras, _views)) {
        _viewer->setThreadingModel(threading);
        _viewer->setKeyEventSetsDone(0);
        for (osgViewer::View* view : _views) view->setSceneData(&scene);
        _viewer->realize();
        _viewer->getCameras(_cameras);
    }
    ~ViewerRig() { _viewer->stopThreading(); }
    ViewerRig(const ViewerRig&) = delete;
    ViewerRig& operator=(const ViewerRig&) = delete;

    /// Whether a graphics context can be made here.
    [[nodiscard]] static bool canDraw() {
        const osg::ref_ptr<osg::GraphicsContext> context = makeContext(kSize);
        return context && context->realize();
    }

    [[nodiscard]] osgViewer::ViewerBase& viewer() { return *_viewer; }

    /// The first view, or the only one.
    [[nodiscard]] osgViewer::View& view() { return *_views.front(); }

    /// Those that draw.
    [[nodiscard]] const std::vector<osg::Camera*>& cameras() const { return _cameras; }

    /// Number of PagedLODs above which the pager drops what is out of view.
    void setMostPagedLods(unsigned int count) { view().getDatabasePager()->setTargetMaximumNumberOfPageLOD(count); }

    /// Where the first camera looks from; the others stand there too, and look elsewhere.
    void look(const osg::Matrixd& view) {
        for (std::size_t i = 0; i < _views.size(); ++i) {
            _views[i]->getCamera()->setViewMatrix(view * turned(static_cast<int>(i)));
        }
    }

    /// One frame at this simulated time (seconds), first half: events and updates, as osgViewer runs them. What an
    /// application changes between frames it changes after this.
    void update(double time) {
        _viewer->advance(time);
        _viewer->eventTraversal();
        _viewer->updateTraversal();
        MeshMaker maker;
        view().getSceneData()->accept(maker);
    }

    /// Second half: culling and drawing.
    void render() { _viewer->renderingTraversals(); }

private:
    static constexpr int kSize = 64;
    static constexpr double kFovDeg = 40.0;

    static osg::ref_ptr<osg::GraphicsContext> makeContext(int width) {
        osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
        traits->width = width;
        traits->height = kSize;
        traits->pbuffer = true;
        traits->doubleBuffer = false;
        traits->readDISPLAY();
        return osg::GraphicsContext::createGraphicsContext(traits);
    }

    static void setUp(osg::Camera& camera, osg::GraphicsContext* context, int x) {
        camera.setGraphicsContext(context);
        camera.setViewport(x, 0, kSize, kSize);
        camera.setProjectionMatrixAsPerspective(kFovDeg, 1.0, 1000.0, 1e8);
    }

    static osg::Matrixd turned(int camera) {
        return osg::Matrixd::rotate(osg::DegreesToRadians(30.0 * camera), 0.3, 1.0, 0.0);
    }

    static osg::ref_ptr<osgViewer::ViewerBase> makeViews(int cameras, std::vector<osgViewer::View*>& views) {
        const osg::ref_ptr<osgViewer::CompositeViewer> viewer = new osgViewer::CompositeViewer;
        for (int i = 0; i < cameras; ++i) {
            const osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
            setUp(*view->getCamera(), makeContext(kSize), 0);
            viewer->addView(view);
            views.push_back(view);
        }
        return viewer;
    }

    static osg::ref_ptr<osgViewer::ViewerBase> makeSlaves(int cameras, std::vector<osgViewer::View*>& views) {
        const osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
        const osg::ref_ptr<osg::GraphicsContext> context = makeContext(cameras * kSize);
        viewer->getCamera()->setProjectionMatrixAsPerspective(kFovDeg, 1.0, 1000.0, 1e8);
        for (int i = 0; i < cameras; ++i) {
            const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
            setUp(*camera, context, i * kSize);
            viewer->addSlave(camera, osg::Matrixd(), turned(i));
        }
        views.push_back(viewer);
        return viewer;
    }

    std::vector<osgViewer::View*> _views;  // the viewer keeps them
    osg::ref_ptr<osgViewer::ViewerBase> _viewer;
    std::vector<osg::Camera*> _cameras;
};

/// A view from a place on WGS 84 (degrees, metres), turned by `heading` and `pitch` (degrees; pitch 0 looks straight
/// down, 90 to the horizon).
[[nodiscard]] inline osg::Matrixd viewFrom(double latitude, double longitude, double altitude, double heading,
                                           double pitch) {
    osg::Matrixd toWorld;
    osg::EllipsoidModel().computeLocalToWorldTransformFromLatLongHeight(
        osg::DegreesToRadians(latitude), osg::DegreesToRadians(longitude), altitude, toWorld);
    const osg::Matrixd turn = osg::Matrixd::rotate(osg::DegreesToRadians(pitch), 1.0, 0.0, 0.0) *
                              osg::Matrixd::rotate(osg::DegreesToRadians(-heading), 0.0, 0.0, 1.0);
    return osg::Matrixd::inverse(turn * toWorld);
}

/// Number of PagedLODs below a node that more than their first child is loaded of.
[[nodiscard]] inline std::size_t pagedIn(osg::Node& scene) {
    std::size_t count = 0;
    visitNodes(scene, [&](osg::Node& node) {
        const auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        if (paged && paged->getNumChildren() > 1) ++count;
    });
    return count;
}

// Writes the synthetic database, and edits the tiles of all files, or of those below the root's tiles alone.
// Returns: the root's file; empty when something cannot be written.
inline std::string writeEdited(const std::string& folder, const std::string& files,
                               const std::function<void(osg::PagedLOD& tile)>& edit) {
    const std::string rootFile = writeSyntheticDatabase(folder);
    for (const std::string& name : osgDB::getDirectoryContents(folder)) {
        if (name[0] == '.' || name.rfind(files, 0) != 0) continue;
        const osg::ref_ptr<osg::Node> content = osgDB::readRefNodeFile(folder + "/" + name);
        if (!content) return {};
        for (unsigned int i = 0; i < content->asGroup()->getNumChildren(); ++i)
            edit(dynamic_cast<osg::PagedLOD&>(*content->asGroup()->getChild(i)));
        if (!osgDB::writeNodeFile(*content, folder + "/" + name)) return {};
    }
    return rootFile;
}

// Puts an osgTerrain tile in the place of the mesh, and takes the stored bin away.
inline void makeTerrain(osg::PagedLOD& tile) {
    constexpr unsigned int kPosts = 9;
    const core::GeodeticBin extents = storedBin(tile).bin().withAltitude({0.0, 0.0});
    const osg::ref_ptr<osgTerrain::TerrainTile> terrain =
        makeTerrainTile(extents, kPosts, kPosts, [&](unsigned int i, unsigned int j) {
            const double x = extents.longitude().lower + i * extents.longitude().width() / (kPosts - 1);
            const double y = extents.latitude().lower + j * extents.latitude().width() / (kPosts - 1);
            return static_cast<float>(2000.0 * std::sin(11.0 * x) * std::sin(17.0 * y));
        });
    const double width = extents.longitude().width();
    const auto place = [width](const core::Interval& range, double from) {
        return static_cast<int>(std::floor((range.middle() + from) / width));
    };
    terrain->setTileID(osgTerrain::TileID(static_cast<int>(std::lround(std::log2(0.25 * osg::PI / width))),
                                          place(extents.longitude(), osg::PI), place(extents.latitude(), osg::PI_2)));
    tile.setChild(0, terrain);
    tile.setUserDataContainer(nullptr);
}

/// The globe of writeSyntheticDatabase(), but with stored bins that are too low for the meshes in the files below the
/// root: they are widened when the tiles are loaded. Returns: the database's file; empty when it cannot be written.
[[nodiscard]] inline std::string writeFalseDatabase(const std::string& folder) {
    return writeEdited(folder, "tiles_0_", [](osg::PagedLOD& tile) {
        AnalyticBin bin = storedBin(tile);
        bin.setBin(bin.bin().withAltitude({-60000.0, -50000.0}));
        setStoredBin(tile, bin);
    });
}

/// The globe of writeSyntheticDatabase() as osgTerrain tiles with 9 x 9 posts, without stored bins. Its root is an
/// osgTerrain::Terrain. Returns: the database's file; empty when it cannot be written.
[[nodiscard]] inline std::string writeTerrainDatabase(const std::string& folder) {
    const std::string file = writeEdited(folder, "", makeTerrain);
    const osg::ref_ptr<osg::Node> globe = osgDB::readRefNodeFile(file);
    if (!globe) return {};
    const osg::ref_ptr<osgTerrain::Terrain> root = new osgTerrain::Terrain;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    for (unsigned int i = 0; i < globe->asGroup()->getNumChildren(); ++i) root->addChild(globe->asGroup()->getChild(i));
    return osgDB::writeNodeFile(*root, file) ? file : std::string();
}

}  // namespace osgAnalyticBin::test
