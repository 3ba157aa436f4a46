// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullWatcher.h"

#include <osg/Camera>
#include <osg/FrameStamp>

namespace osgAnalyticBin::flight {

/// What osgUtil::SceneView keeps from frame to frame for its cull stage, without a window.
class CullStage {
public:
    /// `files` takes the requests of PagedLODs.
    explicit CullStage(osg::NodeVisitor::DatabaseRequestHandler& files);
    void setRequestHandler(osg::NodeVisitor::DatabaseRequestHandler& files);

    /// Culls a camera's scene as osgViewer does before it draws, and sorts what is found.
    /// Requires: a camera with a viewport, and no update traversal meanwhile. Returns: how long it took, milliseconds.
    double cull(osg::Camera& camera, osg::FrameStamp& frameStamp);

private:
    osg::ref_ptr<osgUtil::CullVisitor> _visitor;
    osg::ref_ptr<osgUtil::StateGraph> _stateGraph;
    osg::ref_ptr<osgUtil::RenderStage> _stage;
};

}  // namespace osgAnalyticBin::flight
