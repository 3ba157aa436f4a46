// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/BoundingBox>
#include <osg/Matrixd>

namespace osgAnalyticBin {

/// A box along the axes of the frame of a mesh, which holds its vertices. Empty at first.
class MeshBox final {
public:
    MeshBox() = default;
    explicit MeshBox(const osg::BoundingBoxf& box) : _box(box._min, box._max) {}
    explicit MeshBox(const osg::BoundingBoxd& box) : _box(box) {}
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

}  // namespace osgAnalyticBin
