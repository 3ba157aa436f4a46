// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BoxSet.h"

#include <osg/LOD>
#include <osg/NodeCallback>

namespace osgAnalyticBin {

class CullTraversal;

/// What a cull visitor knows; quick within a set.
[[nodiscard]] CullTraversal& boxTraversalOf(osg::NodeVisitor& visitor);

/// The cull callback of a LOD of a photogrammetry set, whose own sphere is not tested any more. It says of itself that
/// it is a plain osg::NodeCallback: a scene that is saved holds nothing of it.
/// Guarantee: a LOD is never culled if a vertex of it, or of what is loaded below, is inside all planes; nor, where its
/// box is complete, if one of what is not loaded is. Tests: BoxSets.*.
/// Threads: run() changes nothing in the callback.
class BoxCullCallback final : public osg::NodeCallback {
public:
    BoxCullCallback(BoxSet* set, BoxTile* tile) : _set(set), _tile(tile) {}
    /// A copy knows the same tile.
    BoxCullCallback(const BoxCullCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new BoxCullCallback(*this, copyop); }

    /// Puts a callback on the LOD, in front of its own ones, and switches off the test of its sphere.
    static void place(osg::LOD& node, BoxSet& set, BoxTile& tile);
    /// Takes it off again.
    static void remove(osg::LOD& node);

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~BoxCullCallback() override = default;

private:
    [[nodiscard]] bool isCulled(const osg::Node& node, osg::CullStack& cullStack, osg::NodeVisitor& nv) const;

    const osg::ref_ptr<BoxSet> _set;
    const osg::ref_ptr<BoxTile> _tile;
    bool _wasCullingActive = true;
};

/// Stands on the root of a set: lets OSG begin with all planes there.
class BoxSetCullCallback final : public osg::NodeCallback {
public:
    BoxSetCullCallback() = default;
    BoxSetCullCallback(const BoxSetCullCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new BoxSetCullCallback(*this, copyop); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~BoxSetCullCallback() override = default;
};

/// Stands on the root of a set: has the boxes of its tiles grow by what was read.
class BoxSetUpdateCallback final : public osg::NodeCallback {
public:
    explicit BoxSetUpdateCallback(BoxSet* set) : _set(set) {}
    BoxSetUpdateCallback(const BoxSetUpdateCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new BoxSetUpdateCallback(*this, copyop); }

    [[nodiscard]] BoxSet& set() const { return *_set; }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~BoxSetUpdateCallback() override = default;

private:
    const osg::ref_ptr<BoxSet> _set;
};

}  // namespace osgAnalyticBin
