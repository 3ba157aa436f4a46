// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Footprint.h"

#include <osg/Node>
#include <osg/PagedLOD>
#include <osg/ref_ptr>
#include <osgUtil/CullVisitor>

#include <array>
#include <atomic>
#include <cstddef>

namespace osgAnalyticBin {

class CullTraversal;

/// Enters a kept tile as osgUtil::CullVisitor does, in less time: the drawables of the tile's own mesh are delivered
/// without a culling set for the mesh's transform, and the root group of a file goes to its family at once. What the
/// mesh is made of is known from when the family was made; where something else stands there now, or has a cull
/// callback or a sphere test of its own, OSG enters it.
/// Guarantee: it delivers what OSG delivers, in the same order, with the same matrices, states, depths and near and far
/// planes; tests: TileEntry.*.
/// Threads: everything at any time.
class TileEntry {
public:
    static constexpr std::size_t kMostParts = 4;
    /// The nodes of a tile's own mesh, each behind the one that it hangs below, all of which have to be entered for all
    /// of it to be drawn. None: not known, or more than these.
    using MeshParts = std::array<osg::ref_ptr<osg::Node>, kMostParts>;

    TileEntry() = default;
    /// Of a tile, whose own mesh is `parts`. Whoever keeps this keeps the nodes.
    TileEntry(osg::Node& tile, const MeshParts& parts);

    /// Whether it can enter the tile. Requires, when it does: a visitor of the very type osgUtil::CullVisitor, and a
    /// tile that has no sphere test and no cull callback but that of its bin.
    [[nodiscard]] bool isPossible() const { return _isPossible; }
    void enter(osg::Node& tile, osgUtil::CullVisitor& visitor, CullTraversal& traversal) const;

    /// Has the memory fetched that entering the tile read last time.
    void fetch() const { _footprint.fetch(); }

private:
    enum class Kind : unsigned char { Unknown, Group, Transform, Geometry, Terrain };
    struct Part {
        osg::Node* node = nullptr;
        Kind kind = Kind::Unknown;
        unsigned char above = 0;     // number of the part that it hangs below, if it is not the first
        unsigned char place = 0;     // among that one's children
        unsigned char children = 0;  // of a group or transform
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
    [[nodiscard]] bool enterShownLevel(osgUtil::CullVisitor& visitor, CullTraversal& traversal,
                                       Footprint::Notes& notes) const;
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
