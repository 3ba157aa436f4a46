// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Footprint.h"

#include <osg/Drawable>
#include <osg/Node>
#include <osg/PagedLOD>
#include <osg/ref_ptr>
#include <osgUtil/CullVisitor>

#include <array>
#include <atomic>
#include <cstddef>

namespace osgAnalyticBin {

/// Enters a kept tile like osgUtil::CullVisitor, in less time: it adds the drawables of the tile's own mesh without
/// creating a culling set for the mesh's transform, and passes the root group of a file to its family directly. The
/// nodes of the mesh are those at the time when the family was made. If they have changed, or one of them has a cull
/// callback, OSG enters the tile. Frustum tests of spheres are left out: the bin stands for that of the tile, and boxes
/// of drawables are within those of the mesh.
/// Guarantee: the render graph is that of OSG: the same drawables in the same order, with the same matrices, states,
/// depths, and near and far planes; tests: TileEntry.*.
/// Threads: all functions at any time.
class TileEntry {
public:
    static constexpr std::size_t kMostParts = 4;
    /// All nodes that have to be entered to draw a tile's own mesh, parents before children. None: unknown, or more
    /// than fit.
    using MeshParts = std::array<osg::ref_ptr<osg::Node>, kMostParts>;

    TileEntry() = default;
    /// `parts`: the tile's own mesh. The owner holds references to the nodes.
    TileEntry(osg::Node& tile, const MeshParts& parts);

    /// Whether enter() may be called. It requires, besides: a visitor of exactly the class osgUtil::CullVisitor, and a
    /// tile without cull callbacks other than that of its bin and a suspended one for clusters.
    [[nodiscard]] bool isPossible() const { return _isPossible; }
    /// A level of detail that remains to be entered.
    struct Level {
        osg::Node* node = nullptr;
        const osg::StateSet* state = nullptr;  ///< of the tile
    };
    /// `notes`: of the footprint. Returns: the level that is shown, if it is not the mesh; the visitor stands in the
    /// tile until leave() then.
    [[nodiscard]] Level enter(osg::Node& tile, osgUtil::CullVisitor& visitor, Footprint::Notes& notes) const;
    static void leave(const Level& level, osgUtil::CullVisitor& visitor);

    /// Whether a part of the mesh has neither a state nor callbacks, and is of a class that is known to draw everything
    /// below it. False also for tiles of osgTerrain, and where it takes longer to tell.
    [[nodiscard]] bool isBare(std::size_t part) const {
        const Kind kind = _parts[part].kind;
        if (kind == Kind::Unknown || kind == Kind::Terrain) return false;
        const osg::Node& node = *_parts[part].node;
        return !node.getStateSet() && !node.getCullCallback() && !node.getUpdateCallback() &&
               !node.getEventCallback() &&
               !(kind == Kind::Geometry && static_cast<const osg::Drawable&>(node).getDrawCallback());
    }

    /// The memory that the last enter() read, and what was entered for it.
    [[nodiscard]] const Footprint& footprint() const { return _footprint; }
    /// Prefetches that memory.
    void fetch() const { _footprint.fetch(); }

private:
    enum class Kind : unsigned char { Unknown, Group, Transform, Geometry, Terrain };
    struct Part {
        osg::Node* node = nullptr;
        Kind kind = Kind::Unknown;
        unsigned char above = 0;     // number of its parent among the parts; the first has none
        unsigned char place = 0;     // index among the parent's children
        unsigned char children = 0;  // number of children of a group or transform
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
    [[nodiscard]] Level enterShownLevel(osgUtil::CullVisitor& visitor, Footprint::Notes& notes) const;
    [[nodiscard]] bool drawLevel(osg::Node& level, osgUtil::CullVisitor& visitor, Footprint::Notes& notes) const;
    [[nodiscard]] bool drawMesh(osgUtil::CullVisitor& visitor, Footprint::Notes& notes) const;
    [[nodiscard]] bool isMeshAsKnown(const osgUtil::CullVisitor& visitor, Footprint::Notes& notes) const;

    osg::PagedLOD* _paged = nullptr;
    bool _isPossible = false;
    bool _isOwnMesh = false;                // the first part is the tile
    std::array<Part, kMostParts> _parts{};  // no nodes: the mesh is not known
    Footprint _footprint;
    BoundedMesh _bounded;
};

}  // namespace osgAnalyticBin
