// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DrawnState.h"
#include "Footprint.h"
#include "Prefetch.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/core/Plane.h>

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/PagedLOD>
#include <osg/ref_ptr>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <optional>

namespace osgAnalyticBin {

/// The distance from the plane of the eye to the farthest corner of a box, as osgUtil::CullVisitor computes its far
/// plane. `toEye`: from the box's frame to eye space. Requires: a valid box.
[[nodiscard]] inline double farthestDepth(const osg::BoundingBox& box, const osg::Matrixd& toEye) {
    double depth = -toEye(3, 2);
    for (int i = 0; i < 3; ++i) depth += std::max(-toEye(i, 2) * box._min[i], -toEye(i, 2) * box._max[i]);
    return depth;
}

/// Whether exactly osgTerrain::GeometryTechnique draws a tile of osgTerrain, and has made it a mesh.
[[nodiscard]] bool isDrawnByGeometry(const osgTerrain::TerrainTile& tile);

/// A tile of a family at the time when the family was made, as far as cull traversals need it besides its bin. It draws
/// the tile's own mesh like osgUtil::CullVisitor, in less time: it adds the drawables without creating a culling set
/// for the mesh's transform. If nodes of the mesh have changed since, or one of them has a cull callback, OSG draws the
/// mesh. Frustum tests of spheres are left out: the bin stands for that of the tile, and boxes of drawables are within
/// those of the mesh. Guarantee: the render graph is that of OSG: the same drawables in the same order, with the same
/// matrices, states, depths, and near and far planes; tests: FamilyTile.*. Threads: all functions at any time.
class FamilyTile {
public:
    FamilyTile() = default;
    FamilyTile(osg::Node& tile, const AnalyticBinCullCallback& callback);

    /// The tile's bin. Returns: nullptr for what is no tile.
    [[nodiscard]] const AnalyticBinCullCallback* callback() const { return _callback.get(); }
    /// The tile itself. Returns: nullptr where it has no levels of detail.
    [[nodiscard]] osg::PagedLOD* paged() const { return _paged; }

    /// Whether the bin's callback is the first of the tile's cull callbacks.
    [[nodiscard]] bool isFirst(const osg::Node& tile) const { return tile.getCullCallback() == _anyCallback; }
    /// Whether the tile has no cull callbacks that do something in the traversal, other than that of its bin.
    [[nodiscard]] bool isAlone(const osg::Node& tile, const osg::CullSettings& settings) const;
    /// Whether a traversal may pass by the tile's own callback and OSG's test of its sphere. It requires, besides: a
    /// visitor of exactly the class osgUtil::CullVisitor, and a tile with the bin's callback in front.
    [[nodiscard]] bool isPossible() const { return _isPossible; }

    static constexpr std::size_t kMostParts = 4;
    /// A node of the own mesh, parents before children: part(0) is the mesh. OSG draws the whole mesh as long as it
    /// enters each of them. Returns: nullptr behind the last one; of all, where the mesh is not known.
    [[nodiscard]] osg::Node* part(std::size_t i) const { return i < _count ? _parts[i].node.get() : nullptr; }
    [[nodiscard]] bool isMesh(const osg::Node& node) const { return &node == part(0); }

    /// Whether meshes can be drawn in this traversal.
    [[nodiscard]] static bool canDraw(osgUtil::CullVisitor& visitor);
    /// Draws the mesh; boxes are tested against the undecided planes. Returns: false where the mesh is left to OSG.
    [[nodiscard]] bool draw(osgUtil::CullVisitor& visitor, core::PlaneMask undecided) const;
    /// How far from the plane of the eye the mesh is drawn: farthestDepth() of its boxes, minus infinity where it has
    /// none.
    struct Depths {
        double all, drawn;  ///< of all boxes, and of those that draw() does not find outside of the undecided planes
    };
    /// Returns: nullopt where draw() leaves the mesh to OSG.
    [[nodiscard]] std::optional<Depths> farthest(osgUtil::CullVisitor& visitor, core::PlaneMask undecided) const;
    /// Whether OSG's test of the mesh's sphere has to be left out: OSG makes that of an osgTerrain tile without the
    /// vertical scale. Requires: a mesh.
    [[nodiscard]] bool isEnteredUntested(const osgUtil::CullVisitor& visitor) const;

    /// Whether a traversal draws the whole mesh, by what is quickly known: all parts are as they were, of classes that
    /// draw everything below them, and neither states nor callbacks leave anything out. False also for tiles of
    /// osgTerrain.
    [[nodiscard]] bool isDrawnWhole(const osg::NodeVisitor& visitor, const osg::CullSettings& settings,
                                    const StateRules& rules) const;

    /// Whether OSG runs none of the application's code in the tile: it has only its own mesh, which is as it was.
    [[nodiscard]] bool isMeshAlone(const osg::Node& tile, const osgUtil::CullVisitor& visitor) const;

    /// Prefetches the tile's node, and what the walk read when it last came there.
    void fetch(const osg::Node& tile) const {
        constexpr std::uintptr_t kLines = 6;
        prefetchLines(reinterpret_cast<std::uintptr_t>(&tile), kLines);
        _footprint.fetch();
    }
    [[nodiscard]] const Footprint& footprint() const { return _footprint; }
    /// Notes what is read of the mesh where it is drawn.
    void noteMesh(Footprint::Notes& notes) const;

private:
    enum class Kind : unsigned char { Unknown, Group, Transform, Geometry, Terrain };
    struct Part {
        osg::ref_ptr<osg::Node> node;
        Kind kind = Kind::Unknown;
        unsigned char above = 0;     // number of its parent among the parts; the first has none
        unsigned char place = 0;     // index among the parent's children
        unsigned char children = 0;  // number of children of a group or transform; 0: not known
    };
    /// The mesh whose bound is known to be computed. osgTerrain makes meshes in the update traversal, and OSG computes
    /// their bounds in all cull threads at once: one may read what another is writing.
    class BoundedMesh {
    public:
        BoundedMesh() = default;
        BoundedMesh(const BoundedMesh&) {}
        BoundedMesh& operator=(const BoundedMesh&) { return *this; }
        void computeBoundOf(const osg::Node& mesh) const;

    private:
        mutable std::atomic<const osg::Node*> _mesh{nullptr};
    };
    class Delivery;

    [[nodiscard]] static Kind kindOf(const osg::Node& node);
    [[nodiscard]] static osg::Node* meshOf(osg::Node& tile, osg::PagedLOD* paged);
    [[nodiscard]] bool append(osg::Node& node);
    [[nodiscard]] bool canBeDrawn();
    [[nodiscard]] bool isMeshAsKnown(const osg::NodeVisitor& visitor, const osg::CullSettings& settings) const;

    osg::ref_ptr<const AnalyticBinCullCallback> _callback;
    const osg::Callback* _anyCallback = nullptr;  // the same, found in fewer steps
    osg::PagedLOD* _paged = nullptr;
    bool _isPossible = false;
    bool _isOwnMesh = false;
    bool _isDrawn = false;          // here, not by OSG
    bool _areClassesKnown = false;  // of all parts
    unsigned char _count = 0;       // of parts
    std::array<Part, kMostParts> _parts;
    BoundedMesh _bounded;
    Footprint _footprint;
};

}  // namespace osgAnalyticBin
