// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/Export.h>

#include <osg/Camera>
#include <osg/Group>
#include <osg/Matrixd>
#include <osg/NodeCallback>
#include <osg/Viewport>

#include <optional>
#include <vector>

namespace osgUtil {
class CullVisitor;
}
namespace osgViewer {
class View;
}

namespace osgAnalyticBin {

/// The matrices and the viewport of a cull traversal.
struct CullingView {
    osg::Matrixd view;                     ///< from the world to the eye
    osg::Matrixd projection;               ///< from the eye to clip space
    osg::ref_ptr<osg::Viewport> viewport;  ///< pixels
};

/// The cull callback of a camera that can show what is drawn from elsewhere. While it is frozen, the scene is culled,
/// refined and paged by a culling view, and is drawn with the camera's own view. Every test of every node runs with the
/// matrices of the culling view, so exactly the same is drawn. Overlays are drawn by the camera's own view, cut by
/// neither near nor far plane. Cameras inside the scene (render to texture) keep the culling
/// view throughout, and OccluderNodes are those of the camera's own view.
/// Threads: setters and the overlay's nodes may be touched where no cull traversal runs, as between frames.
class OSGANALYTICBINVIEWER_EXPORT CameraCulling : public osg::NodeCallback {
public:
    CameraCulling();

    /// Returns the camera's CameraCulling; the first call installs it after the callbacks that are there.
    [[nodiscard]] static CameraCulling& of(osg::Camera& camera);

    /// Returns: nullptr when the camera has none.
    [[nodiscard]] static CameraCulling* find(osg::Camera& camera);

    /// The cameras that draw a view's scene: the master or its slaves.
    [[nodiscard]] static std::vector<osg::Camera*> drawingCameras(osgViewer::View& view);

    /// The present culling view; by default the camera's own.
    [[nodiscard]] static CullingView cullingView(osg::Camera& camera);

    /// Culls by this view from now on.
    void freeze(const CullingView& view) {
        _frozen = view;
        declare();
    }
    /// Culls by the camera's own view again.
    void thaw() {
        _frozen.reset();
        declare();
    }
    /// Whether freeze() holds.
    [[nodiscard]] bool isFrozen() const { return _frozen.has_value(); }

    /// What the camera draws on top of its scene, in the world's frame; it is filled where the scene is shown as
    /// lines.
    [[nodiscard]] osg::Group& overlay() { return *_overlay; }

    /// One cull traversal of the camera.
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

    /// Of the overlay, with the camera's own.
    void resizeGLObjectBuffers(unsigned int size) override;
    /// As resizeGLObjectBuffers().
    void releaseGLObjects(osg::State* state) const override;

protected:
    ~CameraCulling() override;

private:
    void declare();
    void drawOverlay(osgUtil::CullVisitor& visitor) const;

    std::optional<CullingView> _frozen;
    const osg::ref_ptr<osg::Group> _overlay;
};

}  // namespace osgAnalyticBin
