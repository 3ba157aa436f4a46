// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osg/Camera>
#include <osgUtil/CullVisitor>
#include <osgUtil/SceneView>
#include <osgViewer/Renderer>
#include <osgViewer/ViewerBase>

#include <algorithm>

namespace osgAnalyticBin {

namespace {

void add(const BinCounts& some, BinCounts& sum) {
    sum.tested += some.tested;
    sum.outside += some.outside;
    sum.inside += some.inside;
    sum.straddling += some.straddling;
    sum.hidden += some.hidden;
    sum.beyondEdge += some.beyondEdge;
    sum.occluded += some.occluded;
}

// Calls it for each cull visitor of a camera.
template <class Call>
void forEachVisitor(osg::Camera& camera, const Call& call) {
    // threading models that cull a frame while the last one is drawn use two in turn
    constexpr unsigned int kSceneViews = 2;
    auto* const renderer = dynamic_cast<osgViewer::Renderer*>(camera.getRenderer());
    for (unsigned int i = 0; renderer && i < kSceneViews; ++i) {
        osgUtil::SceneView* const sceneView = renderer->getSceneView(i);
        if (!sceneView) continue;
        for (const osgUtil::CullVisitor* const visitor :
             {sceneView->getCullVisitor(), sceneView->getCullVisitorLeft(), sceneView->getCullVisitorRight()}) {
            if (visitor) call(*visitor);
        }
    }
}

}  // namespace

BinCounts binCounts(osg::Camera& camera, unsigned int frame) {
    BinCounts sum;
    sum.frame = frame;
    forEachVisitor(camera, [&](const osgUtil::CullVisitor& visitor) {
        const BinStatistics* const statistics = BinStatistics::find(visitor);
        const BinCounts counts = statistics ? statistics->getCounts() : BinCounts();
        if (statistics && counts.frame == frame) add(counts, sum);
    });
    return sum;
}

BinCounts binCounts(osgViewer::ViewerBase& viewer) {
    BinCounts sum;
    osgViewer::ViewerBase::Cameras cameras;
    viewer.getCameras(cameras);
    for (osg::Camera* const camera : cameras) {
        forEachVisitor(*camera, [&sum](const osgUtil::CullVisitor& visitor) {
            const unsigned int frame = visitor.getTraversalNumber();
            if (frame != osg::UNINITIALIZED_FRAME_NUMBER) sum.frame = std::max(sum.frame, frame);
        });
    }
    for (osg::Camera* const camera : cameras) add(binCounts(*camera, sum.frame), sum);
    return sum;
}

}  // namespace osgAnalyticBin
