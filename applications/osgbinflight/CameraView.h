// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "GlmBridge.h"

#include <osg/Camera>
#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// The globe of a scene: its ellipsoid, and where it stands in the world. That of a map is mapPlane().
struct Globe {
    osg::ref_ptr<const osg::EllipsoidModel> ellipsoid;  ///< its radii
    osg::Matrixd localToWorld;                          ///< from ECEF, or the map, to the world

    [[nodiscard]] core::Ellipsoid radii() const { return toCore(*ellipsoid); }
    [[nodiscard]] osg::Vec3d toWorld(const core::Geodetic& position) const;
    [[nodiscard]] core::Geodetic geodetic(const osg::Vec3d& world) const;
    /// The local vertical of a position, of unit length. Frame: the world's.
    [[nodiscard]] osg::Vec3d vertical(const core::Geodetic& position) const;
    /// Where a ray from the eye meets the ellipsoid first. Frame: the world's.
    [[nodiscard]] std::optional<osg::Vec3d> intersection(const osg::Vec3d& eye, const osg::Vec3d& direction) const;
};

/// Where a line first meets what is loaded of a scene. Frame: the world's.
[[nodiscard]] std::optional<osg::Vec3d> firstHit(osg::Node& scene, const osg::Vec3d& from, const osg::Vec3d& to);

/// The globe of the first CoordinateSystemNode with an ellipsoid. Returns: nullopt for scenes without.
[[nodiscard]] std::optional<Globe> findGlobe(osg::Node& scene);

/// The map of the scene's first tile, if that tile is in a map; else findGlobe(); else OSG's default ellipsoid in world
/// coordinates.
[[nodiscard]] Globe globeOf(osg::Node& scene);

/// The "up" of a view without roll, in the world's frame: the local vertical at the eye, or north where the view goes
/// straight up or down. `sight`: along the view, in the world's frame, of unit length.
[[nodiscard]] osg::Vec3d upWithoutRoll(const Globe& globe, const core::Geodetic& eye, const osg::Vec3d& sight);

/// From the world to the eye. Up is upWithoutRoll(), turned by the roll.
[[nodiscard]] osg::Matrixd viewMatrixOf(const CameraPose& pose, const Globe& globe);

/// Perspective with the pose's vertical field of view, near and far plane, sheared when `eyeRight` is not 0.
/// `aspect` is width / height.
[[nodiscard]] osg::Matrixd projectionMatrixOf(const CameraPose& pose, const Globe& globe, double aspect);

/// Gives a camera the view and the projection of a pose; OSG computes near and far planes where the pose has none.
void placeCamera(osg::Camera& camera, const CameraPose& pose, const Globe& globe);

/// OSG's default ellipsoid in world coordinates.
[[nodiscard]] inline Globe defaultGlobe() {
    return {new osg::EllipsoidModel, osg::Matrixd()};
}

/// Reads camera paths, one file or more, and joins them to one path: the first pose of each is one second after the
/// last of the file before. A file that ends in .path is an animation path of OpenSceneGraph, as key z of its viewers
/// records it: of that, a pose every half second while the camera moves, with their field of view, 29.15 degrees. All
/// others are read by readCameraPath(). `globe`: asked for with the first .path, which is given in world coordinates.
/// Throws: Failure when a file cannot be opened, or is broken, or two share a pose's name.
[[nodiscard]] std::vector<CameraPose> readCameraPathFiles(const std::vector<std::string>& fileNames,
                                                          const std::function<Globe()>& globe = defaultGlobe);

}  // namespace osgAnalyticBin::flight
