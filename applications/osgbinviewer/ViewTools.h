// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraView.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osg/Array>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Vec3d>
#include <osg/Vec4>

#include <initializer_list>
#include <optional>
#include <vector>

namespace osgAnalyticBin::viewer {

/// Computes the bounds of everything below a node, hidden or not. OSG does so on first use, which for an overlay that
/// two cameras draw happens in two cull threads at once. Call between frames.
void computeBounds(osg::Node& node);

/// A view's frustum: edges and translucent sides from the eye to the globe, or as far as the eye sees past it.
/// `reach`: metres that it is drawn where there is no globe.
[[nodiscard]] osg::ref_ptr<osg::Node> makeFrustum(const CullingView& view, const std::optional<flight::Globe>& globe,
                                                  double reach);

/// Where a viewer starts: the whole globe with room around it; or, of a database that covers a part of the globe, that
/// part from the south and above.
struct HomeView {
    osg::Vec3d eye;
    osg::Vec3d center;
    osg::Vec3d up;
};

/// `projection`: of a perspective camera, for which the view is as near as it can be.
[[nodiscard]] HomeView homeViewOf(osg::Node& scene, const osg::Matrixd& projection);

/// Triangles, seen from both sides, or lines of one colour between vertices: blended, in a render bin of the overlay.
/// They do not change the depth buffer.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeIndexed(osg::Vec3Array& vertices, GLenum primitives,
                                                      const std::vector<unsigned int>& indices, const osg::Vec4& colour,
                                                      int renderBin);

/// Parts of a drawing, where a matrix puts them.
[[nodiscard]] osg::ref_ptr<osg::Node> placed(const osg::Matrixd& toWorld,
                                             std::initializer_list<osg::ref_ptr<osg::Geometry>> parts);

/// The surface of a bin as meshes and lines.
struct SlabMesh {
    osg::Vec3d origin;                    ///< ECEF, metres
    std::vector<osg::Vec3> vertices;      ///< from the origin
    std::vector<unsigned int> triangles;  ///< three indices each
    std::vector<unsigned int> lines;      ///< two indices each: the bin's twelve edges
};

/// The six curved faces of a bin, a vertex every degree or finer; triangles are counterclockwise from outside.
/// Guarantee: the top lies outside the bin, by 500 m at most, the sag of chords of a degree both
/// ways; all other vertices are on the bin's surface to the rounding of float; tests: Slab.*. Requires: a bin that is
/// not empty.
[[nodiscard]] SlabMesh slabMesh(const core::GeodeticBin& bin, const core::Ellipsoid& ellipsoid);

/// Faces that look towards the eye, translucent where the colour is, and edges, in ECEF: in front of terrain that they
/// coincide with. Of several slabs, the nearest face alone is seen. `edgesBin`: render bin of the edges, from 21 on.
[[nodiscard]] osg::ref_ptr<osg::Node> makeSlab(const SlabMesh& mesh, const osg::Vec4& faces, const osg::Vec4& edges,
                                               int edgesBin);

}  // namespace osgAnalyticBin::viewer
