// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osg/Camera>
#include <osg/CoordinateSystemNode>
#include <osg/Group>
#include <osg/Matrixd>
#include <osg/Vec3d>

#include <optional>
#include <vector>

namespace osgGA {
class GUIActionAdapter;
class GUIEventAdapter;
}  // namespace osgGA
namespace osgViewer {
class View;
}

namespace osgAnalyticBin {

/// The osgViewer view that an event handler was called for. Returns: nullptr for other viewers.
[[nodiscard]] osgViewer::View* viewOf(osgGA::GUIActionAdapter& action);

/// Whether another handler has handled an event; FRAME events are for all handlers.
[[nodiscard]] bool isTaken(const osgGA::GUIEventAdapter& event);

/// The cameras that draw a view's scene: the master or its slaves, those left out that look at another camera.
[[nodiscard]] std::vector<osg::Camera*> drawingCameras(osgViewer::View& view);

/// The globe of a scene, and where it stands in the world.
struct SceneGlobe {
    osg::ref_ptr<const osg::EllipsoidModel> ellipsoid;
    osg::Matrixd toWorld;

    /// Where a ray from the eye meets the ellipsoid first. Frame: the world's.
    [[nodiscard]] std::optional<osg::Vec3d> intersection(const osg::Vec3d& eye, const osg::Vec3d& direction) const;

    /// Local vertical, in the world's frame, of unit length.
    [[nodiscard]] osg::Vec3d vertical(const osg::Vec3d& position) const;

    /// Metres above the ellipsoid.
    [[nodiscard]] double altitude(const osg::Vec3d& position) const;
};

/// That of the first CoordinateSystemNode with an ellipsoid below a node. Returns: nullopt for scenes without.
[[nodiscard]] std::optional<SceneGlobe> globeOf(osg::Node& scene);

/// Computes the bounds of everything below a node, hidden or not. OSG does so on first use, which for an overlay that
/// two cameras draw happens in two cull threads at once. Call between frames.
void computeBounds(osg::Node& node);

/// A view's frustum: edges and translucent sides from the eye to the globe, or as far as the eye sees past it.
/// `reach`: metres that it is drawn where there is no globe.
[[nodiscard]] osg::ref_ptr<osg::Node> makeFrustum(const CullingView& view, const std::optional<SceneGlobe>& globe,
                                                  double reach);

}  // namespace osgAnalyticBin
