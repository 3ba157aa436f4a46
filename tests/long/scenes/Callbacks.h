// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What an application hangs on its nodes, and nodes of its own. What they do depends on the frame number alone. They
// survive osg::clone(), and are saved as plain callbacks that do nothing, and plain groups.

#pragma once

#include "Description.h"

namespace osgAnalyticBin::test {

/// Moves a MatrixTransform by an equal step in every frame, in its own frame.
[[nodiscard]] osg::ref_ptr<osg::NodeCallback> makeMover(const osg::Matrixd& start, const osg::Vec3d& step, int frame);

/// Hangs on a node the callback that a part is, if it is one.
void addCallback(const Part& part, osg::Node& node);

/// Looks at every visitor that it meets as applications do: one of the cull traversal is a CullVisitor, and the handler
/// of its requests is a DatabasePager. What is otherwise is told by takeComplaint().
class CastingGroup : public osg::Group {
public:
    CastingGroup() = default;
    CastingGroup(const CastingGroup& other, const osg::CopyOp& copyop) : osg::Group(other, copyop) {}
    [[nodiscard]] osg::Object* cloneType() const override { return new CastingGroup; }
    [[nodiscard]] osg::Object* clone(const osg::CopyOp& copyop) const override {
        return new CastingGroup(*this, copyop);
    }

    void traverse(osg::NodeVisitor& nv) override;
};

/// Undoes what callbacks of the kind Meddles did in the last traversal.
void undoMeddling();

/// Returns: what a CastingGroup or a callback has seen since the last call that OSG shows to none, else nothing.
[[nodiscard]] std::string takeComplaint();

}  // namespace osgAnalyticBin::test
