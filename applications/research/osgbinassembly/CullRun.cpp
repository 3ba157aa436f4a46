// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullRun.h"

#include "CullWatcher.h"

#include <osgAnalyticBin/mappings/QuadraticBinCullCallback.h>

#include <osg/Polytope>
#include <osgUtil/RenderStage>

#include <algorithm>
#include <chrono>
#include <random>
#include <unordered_set>

namespace osgAnalyticBin::assembly {

namespace {

// Notes that the cull traversal entered a part.
class Recorder : public osg::NodeCallback {
public:
    explicit Recorder(char& reached) : _reached(reached) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        _reached = 1;
        traverse(node, nv);
    }

private:
    char& _reached;
};

void install(const Part& part, Culling culling, char& reached) {
    const osg::ref_ptr<Recorder> recorder = new Recorder(reached);
    part.geode->setCullingActive(culling != Culling::Bins);
    if (culling == Culling::Spheres) {
        part.geode->setCullCallback(recorder.get());
        return;
    }
    const osg::ref_ptr<QuadraticBinCullCallback> callback =
        new QuadraticBinCullCallback(part.bin, part.geode->getBound());
    callback->setNestedCallback(recorder.get());
    part.geode->setCullCallback(callback.get());
}

void collectDrawables(const osgUtil::StateGraph& graph, std::unordered_set<const osg::Drawable*>& drawables) {
    for (const auto& leaf : graph._leaves) drawables.insert(leaf->getDrawable());
    for (const auto& child : graph._children) collectDrawables(*child.second, drawables);
}

class Traversal {
public:
    explicit Traversal(osg::Node& scene) : _visitor(new osgUtil::CullVisitor), _camera(new osg::Camera) {
        _camera->setViewport(0, 0, 1600, 900);
        _camera->setCullingMode(osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING);
        _camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        _camera->addChild(&scene);
    }

    // Returns: milliseconds.
    double run(const Camera& camera) {
        _graph = new osgUtil::StateGraph;
        const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
        const osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
        stamp->setFrameNumber(++_frame);
        _camera->setProjectionMatrix(camera.projection);
        _camera->setViewMatrix(camera.modelView);
        _visitor->reset();
        const auto before = std::chrono::steady_clock::now();
        flight::cullScene(*_visitor, *_camera, *stamp, *_graph, *stage);
        const auto after = std::chrono::steady_clock::now();
        return std::chrono::duration<double, std::milli>(after - before).count();
    }

    [[nodiscard]] std::unordered_set<const osg::Drawable*> drawables() const {
        std::unordered_set<const osg::Drawable*> result;
        collectDrawables(*_graph, result);
        return result;
    }

private:
    osg::ref_ptr<osgUtil::CullVisitor> _visitor;
    osg::ref_ptr<osg::Camera> _camera;
    osg::ref_ptr<osgUtil::StateGraph> _graph;
    unsigned int _frame = 0;
};

bool isInView(const osg::Vec3& sample, const std::vector<osg::Plane>& planes) {
    return std::all_of(planes.begin(), planes.end(),
                       [&](const osg::Plane& plane) { return plane.distance(osg::Vec3d(sample)) >= 0.0; });
}

}  // namespace

Visibility visibleParts(const Assembly& assembly, const std::vector<Camera>& cameras) {
    Visibility result(cameras.size());
    std::vector<std::vector<osg::Plane>> planes;
    for (const Camera& camera : cameras) planes.push_back(camera.sidePlanes());
    for (const Part& part : assembly.parts) {
        const std::vector<osg::Vec3> samples = part.samples();
        for (std::size_t c = 0; c < cameras.size(); ++c) {
            result[c].push_back(std::any_of(samples.begin(), samples.end(),
                                            [&](const osg::Vec3& sample) { return isInView(sample, planes[c]); }));
        }
    }
    return result;
}

CullFigures cullAssembly(const Assembly& assembly, const std::vector<Camera>& cameras, const Visibility& visible,
                         Culling culling) {
    std::vector<char> reached(assembly.parts.size());
    for (std::size_t i = 0; i < reached.size(); ++i) install(assembly.parts[i], culling, reached[i]);
    Traversal traversal(*assembly.scene);
    CullFigures figures;
    if (!cameras.empty()) traversal.run(cameras.front());  // bounds are computed here, not below
    for (std::size_t c = 0; c < cameras.size(); ++c) {
        std::fill(reached.begin(), reached.end(), char{0});
        figures.milliseconds += traversal.run(cameras[c]) / static_cast<double>(cameras.size());
        const std::unordered_set<const osg::Drawable*> drawables = traversal.drawables();
        figures.drawn += drawables.size();
        for (std::size_t i = 0; i < reached.size(); ++i) {
            figures.kept += reached[i] != 0;
            figures.falselyCulled += visible[c][i] && drawables.count(assembly.parts[i].geode->getDrawable(0)) == 0;
        }
    }
    for (const Part& part : assembly.parts) {
        part.geode->setCullCallback(nullptr);
        part.geode->setCullingActive(true);
    }
    return figures;
}

std::vector<osg::Plane> Camera::sidePlanes() const {
    osg::Polytope frustum;
    frustum.setToUnitFrustum(false, false);
    frustum.transformProvidingInverse(modelView * projection);
    return frustum.getPlaneList();
}

std::vector<Camera> randomCameras(std::size_t count, double halfExtent, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto between = [&](double lower, double upper) {
        return lower + (upper - lower) * (static_cast<double>(random()) / static_cast<double>(std::mt19937::max()));
    };
    std::vector<Camera> cameras;
    while (cameras.size() < count) {
        const osg::Vec3d eye(between(-halfExtent, halfExtent), between(-halfExtent, halfExtent), between(1.0, 60.0));
        const osg::Vec3d target(between(-halfExtent, halfExtent), between(-halfExtent, halfExtent), between(0.0, 12.0));
        const osg::Vec3d ahead = target - eye;
        // Not straight down, where "up" would have no meaning.
        if (osg::Vec2d(ahead.x(), ahead.y()).length() < 1.0) continue;
        cameras.push_back({osg::Matrixd::lookAt(eye, target, osg::Vec3d(0.0, 0.0, 1.0)),
                           osg::Matrixd::perspective(between(10.0, 50.0), 16.0 / 9.0, 0.1, 1e4)});
    }
    return cameras;
}

}  // namespace osgAnalyticBin::assembly
