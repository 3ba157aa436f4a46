// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osg/Node>

#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

/// Notices what is added below a tile, or changes there, after its bin was made. OSG computes the bound of a node anew
/// when something below it was added, removed or moved, and asks this on the way: it compares the content with the
/// content that the bins above were fitted to. What is new has to lie in the bins of all tiles above; else these are
/// kept visible at once, and their databases widen them in the next update traversal.
/// It stands on every tile, and on groups between tiles; each looks after its own children, up to the next that is
/// watched. The meshes that a tile was fitted to are known.
/// Bounds are computed before tiles are culled: by osgViewer in every frame, and by DatabaseCullCallback.
class OSGANALYTICBIN_EXPORT ContentWatch final : public osg::Node::ComputeBoundingSphereCallback {
public:
    ContentWatch() = default;
    /// A copy knows nothing, and so finds nothing new.
    ContentWatch(const ContentWatch& other, const osg::CopyOp& copyop);
    META_Object(osgAnalyticBin, ContentWatch)

        /// Puts a watch on the node, in front of a callback that is there. `fitted`: the children, or the node itself,
        /// that the node's bin was fitted to.
        static void place(osg::Node& node, const std::vector<osg::ref_ptr<osg::Node>>& fitted);

    /// Takes it off again.
    static void remove(osg::Node& node);

    /// Whether a watch stands on the node, and has found content among its children that the bin was not fitted to.
    [[nodiscard]] static bool hasNewContent(const osg::Node& node);

    /// Looks for new content now. Requires: the node that it was placed on is alive.
    void look() const;

    osg::BoundingSphere computeBound(const osg::Node& node) const override;

protected:
    ~ContentWatch() override = default;

private:
    // Hashes of a mesh.
    struct Structure {
        std::uint64_t parts = 1;   // changes when a part is added, removed or replaced
        std::uint64_t frames = 1;  // changes when a part is moved
        [[nodiscard]] bool operator==(const Structure& other) const {
            return parts == other.parts && frames == other.frames;
        }
    };
    struct Fitted {
        const osg::Node* node;
        Structure structure;
        mutable std::uint64_t bounds;  // 0: not known yet
    };

    [[nodiscard]] static Structure structureOf(const osg::Node& mesh);

    // That of a node in one place.
    [[nodiscard]] static const ContentWatch* ownWatchOf(const osg::Node& node);
    [[nodiscard]] bool isFitted(const osg::Node& child, bool withBounds) const;
    void check(const osg::Node& node) const;
    // As it is without the watch.
    [[nodiscard]] osg::BoundingSphere boundOf(const osg::Node& node) const;

    // Whether a transform in a fitted mesh has another matrix now, while the mesh still has the same parts.
    [[nodiscard]] bool isPartMoved(const osg::Group& group) const;

    const osg::Node* _node = nullptr;  // that it was placed on
    std::uint64_t _frame = 0;          // a hash of that node's matrix; 0: it is no transform
    std::vector<Fitted> _fitted;
    mutable bool _isPending = false;  // whether content has not been looked at from all tiles above: the file is not
                                      // merged yet
    osg::ref_ptr<osg::Node::ComputeBoundingSphereCallback> _previous;
};

}  // namespace osgAnalyticBin
