// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/BoundingBox>
#include <osg/BoundingSphere>
#include <osg/Matrixd>
#include <osg/Polytope>

namespace osgAnalyticBin {

/// A box along the axes of the frame of a mesh, which holds its vertices. Empty at first.
class MeshBox final {
public:
    MeshBox() = default;
    explicit MeshBox(const osg::BoundingBoxf& box) : _box(box._min, box._max) {}
    /// What bin() has made a bin; boundless when that is not valid.
    explicit MeshBox(const AnalyticBin& bin);

    /// The box of a mesh of unknown extent.
    [[nodiscard]] static MeshBox boundless();

    [[nodiscard]] bool isBoundless() const { return _isBoundless; }
    [[nodiscard]] bool isEmpty() const { return !_isBoundless && !_box.valid(); }
    /// Not valid when it is empty or boundless.
    [[nodiscard]] const osg::BoundingBoxd& box() const { return _box; }

    void expandBy(const MeshBox& other);
    [[nodiscard]] bool contains(const MeshBox& other) const;
    /// The box of what is in this one, moved by an affine matrix.
    [[nodiscard]] MeshBox moved(const osg::Matrixd& matrix) const;

    /// As a bin of the map whose coordinates are those of the mesh. Not valid when the box is empty, boundless, or too
    /// far away for a map.
    [[nodiscard]] AnalyticBin bin() const;

private:
    osg::BoundingBoxd _box;
    bool _isBoundless = false;
};

/// A box, and the sphere that holds it, as they are tested against planes.
/// Guarantee: Outside means that no point of the box, and of the second sphere of the call, is inside the plane; Inside
/// that all are; rounding included. Tests: MeshBox.*.
/// Cost: six products a plane, nothing allocated.
class TestedBox final {
public:
    TestedBox() = default;
    /// Requires: the box is valid.
    explicit TestedBox(const osg::BoundingBoxd& box);

    /// Tests the planes that are undecided, and clears those that have the box inside. `also`: has to be out of view,
    /// too, for the same plane; null: nothing else.
    [[nodiscard]] core::Side classify(const osg::Polytope::PlaneList& planes, core::PlaneMask& undecided,
                                      const osg::BoundingSphere* also) const;

    [[nodiscard]] const osg::BoundingSphere& sphere() const { return _sphere; }

private:
    osg::Vec3d _center, _half;
    double _reach = 0.0;
    osg::BoundingSphere _sphere;
};

}  // namespace osgAnalyticBin
