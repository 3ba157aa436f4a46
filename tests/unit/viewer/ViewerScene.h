// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osg/CoordinateSystemNode>
#include <osgDB/ReadFile>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <cmath>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

/// A camera without a window over the root tiles of a synthetic globe.
class ViewerScene {
public:
    explicit ViewerScene(const CullOptions& options = {}) {
        installBins(*_database, options);
        _camera->addChild(_database);
        _camera->setViewport(0, 0, 400, 400);
        _camera->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
        _stamp->setFrameNumber(1);
    }

    /// Looks straight down from a place or, with `pitchDeg`, to the north, so many degrees above straight down.
    void lookFrom(double latitudeDeg, double longitudeDeg, double altitude, double pitchDeg, double fovDeg) {
        osg::Matrixd toWorld;
        osg::EllipsoidModel().computeLocalToWorldTransformFromLatLongHeight(
            osg::DegreesToRadians(latitudeDeg), osg::DegreesToRadians(longitudeDeg), altitude, toWorld);
        const double pitch = osg::DegreesToRadians(pitchDeg);
        const osg::Vec3d sight(0.0, std::sin(pitch), -std::cos(pitch)), up(0.0, std::cos(pitch), std::sin(pitch));
        _camera->setViewMatrix(osg::Matrixd::inverse(toWorld) * osg::Matrixd::lookAt(osg::Vec3d(), sight, up));
        _camera->setProjectionMatrixAsPerspective(fovDeg, 1.0, 1000.0, 1e8);
    }

    /// What one cull traversal of the camera leaves to draw, and where in eye space.
    [[nodiscard]] std::map<const osg::Drawable*, osg::Matrixd> cull() {
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        const osg::ref_ptr<osgUtil::StateGraph> graph = new osgUtil::StateGraph;
        const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
        stage->setViewport(_camera->getViewport());
        stage->setCamera(_camera);
        visitor->setStateGraph(graph);
        visitor->setRenderStage(stage);
        visitor->setFrameStamp(_stamp);
        visitor->setTraversalNumber(_stamp->getFrameNumber());
        visitor->inheritCullSettings(*_camera);
        visitor->pushViewport(_camera->getViewport());
        visitor->pushProjectionMatrix(new osg::RefMatrix(_camera->getProjectionMatrix()));
        visitor->pushModelViewMatrix(new osg::RefMatrix(_camera->getViewMatrix()), osg::Transform::ABSOLUTE_RF);
        if (osg::Callback* callback = _camera->getCullCallback())
            callback->run(_camera, visitor);
        else
            visitor->traverse(*_camera);
        visitor->popModelViewMatrix();
        visitor->popProjectionMatrix();
        visitor->popViewport();
        nearPlane = visitor->getCalculatedNearPlane();
        farPlane = visitor->getCalculatedFarPlane();
        std::map<const osg::Drawable*, osg::Matrixd> drawn;
        collect(*graph, drawn);
        return drawn;
    }

    [[nodiscard]] osg::Camera& camera() { return *_camera; }
    [[nodiscard]] osg::Node& database() { return *_database; }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return *_stamp; }

    /// Near and far planes that the last cull() computed, metres.
    double nearPlane = 0.0;
    double farPlane = 0.0;

private:
    static void collect(const osgUtil::StateGraph& graph, std::map<const osg::Drawable*, osg::Matrixd>& drawn) {
        for (const auto& leaf : graph._leaves) drawn[leaf->getDrawable()] = *leaf->_modelview;
        for (const auto& child : graph._children) collect(*child.second, drawn);
    }

    const TemporaryFolder _folder;
    const osg::ref_ptr<osg::Node> _database = osgDB::readRefNodeFile(writeSyntheticDatabase(_folder.path()));
    const osg::ref_ptr<osg::Camera> _camera = new osg::Camera;
    const osg::ref_ptr<osg::FrameStamp> _stamp = new osg::FrameStamp;
};

}  // namespace osgAnalyticBin::test
