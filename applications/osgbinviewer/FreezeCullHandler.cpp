// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Handlers.h"
#include "ViewTools.h"

namespace osgAnalyticBin::viewer {

namespace {

constexpr const char* kFrustumName = "frozen frustum";

void removeFrustum(osg::Group& overlay) {
    for (unsigned int i = overlay.getNumChildren(); i-- > 0;)
        if (overlay.getChild(i)->getName() == kFrustumName) overlay.removeChildren(i, 1);
}

}  // namespace

FreezeCullHandler::FreezeCullHandler() {
    addKey('F', "Freeze the culling camera, to fly round what it draws.",
           [this](osgViewer::View& view) { setFrozen(view, !_isFrozen); });
}

void FreezeCullHandler::setFrozen(osgViewer::View& view, bool frozen) {
    _isFrozen = frozen;
    const auto globe = flight::findGlobe(*view.getSceneData());
    for (osg::Camera* camera : CameraCulling::drawingCameras(view)) {
        CameraCulling& culling = CameraCulling::of(*camera);
        culling.thaw();
        removeFrustum(culling.overlay());
        if (!frozen) continue;
        CullingView seen = CameraCulling::cullingView(*camera);
        // the window may be resized
        seen.viewport = new osg::Viewport(*seen.viewport);
        culling.freeze(seen);
        const osg::ref_ptr<osg::Node> frustum = makeFrustum(seen, globe, view.getSceneData()->getBound().radius());
        frustum->setName(kFrustumName);
        culling.overlay().addChild(frustum);
        computeBounds(*frustum);
    }
}

}  // namespace osgAnalyticBin::viewer
