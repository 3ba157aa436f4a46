// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BoxSet.h"

#include <osg/LOD>
#include <osg/NodeCallback>

namespace osgAnalyticBin {

struct BinCounts;
class CullTraversal;

/// The state of a cull visitor; found quickly within a set.
[[nodiscard]] CullTraversal& boxTraversalOf(osg::NodeVisitor& visitor);

/// Counts tested boxes; within a set all at once at its end.
void countBoxes(osg::NodeVisitor& visitor, const BinCounts& counts);

/// The cull callback of a LOD of a photogrammetry set, whose own sphere is not tested any more. Its class name is that
/// of a plain osg::NodeCallback, so that nothing of it is saved with a scene.
/// Guarantee: a LOD is never culled if a vertex of it, or of what is loaded below, is inside all planes; nor, where its
/// box is complete, if one of what is not loaded is. Tests: BoxSets.*.
/// Threads: run() changes nothing in the callback.
class BoxCullCallback final : public osg::NodeCallback {
public:
    BoxCullCallback(BoxSet* set, BoxTile* tile) : _set(set), _tile(tile) {}
    /// A copy refers to the same tile.
    BoxCullCallback(const BoxCullCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new BoxCullCallback(*this, copyop); }

    /// Puts a callback on the LOD, in front of its own ones, and switches off the test of its sphere.
    static void place(osg::LOD& node, BoxSet& set, BoxTile& tile);
    /// Removes it.
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

/// On the root of a set: makes OSG test all planes from there on.
class BoxSetCullCallback final : public osg::NodeCallback {
public:
    BoxSetCullCallback() = default;
    BoxSetCullCallback(const BoxSetCullCallback& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new BoxSetCullCallback(*this, copyop); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~BoxSetCullCallback() override = default;
};

/// On the root of a set: expands the boxes of its tiles by what was read.
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
