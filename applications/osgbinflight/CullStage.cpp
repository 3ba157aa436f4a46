// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullStage.h"

#include <chrono>

namespace osgAnalyticBin::flight {

CullStage::CullStage(osg::NodeVisitor::DatabaseRequestHandler& files)
    : _visitor(new osgUtil::CullVisitor), _stateGraph(new osgUtil::StateGraph), _stage(new osgUtil::RenderStage) {
    setRequestHandler(files);
}

void CullStage::setRequestHandler(osg::NodeVisitor::DatabaseRequestHandler& files) {
    _visitor->setDatabaseRequestHandler(&files);
}

double CullStage::cull(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    _visitor->reset();
    _stateGraph->clean();
    _stage->reset();
    const auto begin = std::chrono::steady_clock::now();
    cullScene(*_visitor, camera, frameStamp, *_stateGraph, *_stage);
    _stage->sort();
    _stateGraph->prune();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace osgAnalyticBin::flight
