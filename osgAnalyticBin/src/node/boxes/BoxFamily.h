// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BoxSet.h"

#include <osg/CullStack>
#include <osg/Group>
#include <osg/NodeCallback>

#include <functional>

namespace osgAnalyticBin {

/// The cull callback of a group that has LODs of a photogrammetry set among its children. It tests their boxes, which
/// lie side by side in memory, enters those that are kept, and reads nothing of the others. Children that it does not
/// know, because they were added later, are entered. LODs need no callback of their own then.
/// Its class name is that of a plain osg::NodeCallback, so that nothing of it is saved with a scene.
/// Guarantee: that of BoxCullCallback. Tests: BoxSets.*.
/// Threads: run() changes nothing in the callback.
class BoxFamily final : public osg::NodeCallback {
public:
    /// The copy has no tiles.
    BoxFamily(const BoxFamily& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new BoxFamily(*this, copyop); }

    /// Puts a family on the group, behind its other callbacks, and switches off the tests of the spheres of its LODs.
    /// `tileOf`: what is known of a child; null: the child is no LOD of the set.
    static void place(osg::Group& group, BoxSet& set, const std::function<BoxTile*(const osg::Node&)>& tileOf);
    /// Removes it.
    static void remove(osg::Group& group);

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~BoxFamily() override = default;

private:
    BoxFamily(osg::Group& group, BoxSet& set, const std::function<BoxTile*(const osg::Node&)>& tileOf);
    [[nodiscard]] bool culls(const osg::Node& group, osg::CullStack& cullStack) const;
    void cullChildren(osg::Group& group, osg::NodeVisitor& nv, osg::CullStack& cullStack) const;

    const osg::Node* _group = nullptr;
    osg::ref_ptr<BoxSet> _set;
    osg::ref_ptr<BoxSlots> _slots;  // one for each child
};

}  // namespace osgAnalyticBin
