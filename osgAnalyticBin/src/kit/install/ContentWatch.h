// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/BoundWatch.h"
#include "../tile/InstalledTile.h"
#include "MeshState.h"

#include <osgAnalyticBin/Export.h>

#include <osg/BoundingSphere>
#include <osg/Node>
#include <osg/observer_ptr>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

/// Detects content that is added below a tile, or changed there, after the tile's bin was made. When something below a
/// node is added, removed or moved, OSG recomputes the node's bound and calls this callback, which compares the content
/// with what the bins of the ancestors were fitted to. If one of these bins does not contain new content, its tile is
/// kept visible at once, and the database expands the bin in the next update traversal.
/// The bound of a tile of osgTerrain with a vertical scale, which OSG leaves out of account, is expanded by the tile's
/// bin, so that OSG's tests of spheres hold what is drawn. So is a sphere that the application has set for a level of
/// detail, by the spheres of what is loaded there.
/// Every tile and every group between tiles has a watch, which checks the node's own children, down to the next node
/// with a watch. It knows the meshes that the tile's bin was fitted to, and below which tile the node was then: what
/// has come there since, be it from below another tile or from a file that was read for an earlier bin, is new content.
/// Bounds are computed before tiles are culled: by osgViewer in every frame, and by DatabaseCullCallback.
class OSGANALYTICBIN_EXPORT ContentWatch : public BoundWatch {
public:
    ContentWatch() = default;
    /// A copy watches nothing.
    ContentWatch(const ContentWatch& other, const osg::CopyOp& copyop);
    META_Object(osgAnalyticBin, ContentWatch)

        /// Adds a watch to the node, in front of an existing callback. `fitted`: the children, or the node itself,
        /// that the node's bin was fitted to. `above`: the tile that the node is below; `tile`: the one that its
        /// children are below. Null: none.
        static void place(osg::Node& node, const std::vector<osg::ref_ptr<osg::Node>>& fitted, InstalledTile* above,
                          InstalledTile* tile);

    /// Removes the watch, that of a derived class, too.
    static void remove(osg::Node& node);

    /// Whether the node has a watch that found content among its children which the bin was not fitted to.
    [[nodiscard]] static bool hasNewContent(const osg::Node& node);

    /// Checks for new content now. Requires: the watched node exists.
    void look() const;

    osg::BoundingSphere computeBound(const osg::Node& node) const override;

protected:
    ~ContentWatch() override = default;

private:
    struct Fitted {
        const osg::Node* node;
        MeshState state;
        std::uint64_t content;
        mutable std::uint64_t bounds;  // 0: not known yet
    };

    struct Held {
        osg::observer_ptr<const osg::Node> node;  // another one may get its address
        osg::BoundingSphere sphere;
        MeshState state;
    };

    // The watch of a node that has one parent.
    [[nodiscard]] static const ContentWatch* ownWatchOf(const osg::Node& node);
    // Whether a child looks after itself, and is in the same place, below the same tile, as when its watch was placed.
    [[nodiscard]] bool isWatched(const osg::Node& child) const;
    // `slot`: its number among the children.
    [[nodiscard]] const Fitted* fittedOf(const osg::Node& child, std::size_t slot) const;
    // `withContent`: for children that OSG has been told of.
    [[nodiscard]] bool isFitted(const osg::Node& child, std::size_t slot, bool withBounds, bool withContent) const;
    // Whether the watched node is in the scene. If not, it is looked at again when it is: until then nothing that is
    // found may be acted on.
    [[nodiscard]] bool isMerged(const osg::Node& node) const;
    void check(const osg::Node& node) const;
    // Whether the child was looked at before, as it is now: it is in the bins of the tiles above, or they are about to
    // be expanded.
    [[nodiscard]] bool isHeld(unsigned int i, const osg::Node& child) const;
    void noteHeld(unsigned int i, const osg::Node& child) const;
    // Whether a transform in a fitted mesh has another matrix now, while the mesh still has the same parts.
    [[nodiscard]] bool isPartMoved(const osg::Group& group) const;

    const osg::Node* _node = nullptr;  // the watched one
    const osg::Node* _in = nullptr;    // its parent then; null: it had none, or several
    std::uint64_t _frame = 0;          // hash of the node's matrix; 0: it is no transform
    osg::ref_ptr<InstalledTile> _above, _tile;
    std::vector<Fitted> _fitted;
    mutable std::vector<Held> _held;  // by the number of the child
    mutable bool _isPending = false;  // something was found before the file was merged
};

}  // namespace osgAnalyticBin
