// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <osg/Node>
#include <osg/Vec3d>
#include <osg/Vec4>

#include <vector>

namespace osgAnalyticBin::viewer {

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
