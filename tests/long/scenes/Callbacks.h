// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What an application hangs on its nodes. What they do depends on the frame number alone. They survive osg::clone(),
// and are saved as plain callbacks that do nothing.

#pragma once

#include <osg/Matrixd>
#include <osg/NodeCallback>
#include <osg/NodeVisitor>
#include <osg/Vec3d>

namespace osgAnalyticBin::test {

/// Moves a MatrixTransform by an equal step in every frame, in its own frame.
class Mover : public osg::NodeCallback {
public:
    Mover() = default;
    Mover(const osg::Matrixd& start, const osg::Vec3d& step, int frame) : _start(start), _step(step), _frame(frame) {}
    Mover(const Mover& other, const osg::CopyOp& copyop);
    [[nodiscard]] osg::Object* cloneType() const override { return new Mover; }
    [[nodiscard]] osg::Object* clone(const osg::CopyOp& copyop) const override { return new Mover(*this, copyop); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

private:
    osg::Matrixd _start;
    osg::Vec3d _step;
    int _frame = 0;
};

/// Does nothing, or leaves its node out of the odd frames.
class Passer : public osg::NodeCallback {
public:
    explicit Passer(bool skipsOddFrames = false) : _skipsOddFrames(skipsOddFrames) {}
    Passer(const Passer& other, const osg::CopyOp& copyop);
    [[nodiscard]] osg::Object* cloneType() const override { return new Passer; }
    [[nodiscard]] osg::Object* clone(const osg::CopyOp& copyop) const override { return new Passer(*this, copyop); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

private:
    bool _skipsOddFrames;
};

}  // namespace osgAnalyticBin::test
