// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What an application hangs on its nodes, and nodes of its own. What they do depends on the frame number alone. They
// survive osg::clone(), and are saved as plain callbacks that do nothing, and plain groups.

#pragma once

#include <osg/Drawable>
#include <osg/Group>
#include <osg/Matrixd>
#include <osg/NodeCallback>
#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osg/Vec3d>

#include <string>
#include <type_traits>

namespace osgAnalyticBin::test {

/// What osg::clone() makes of a class by its own copy constructor.
template <class Self, class Base>
class Cloned : public Base {
public:
    [[nodiscard]] osg::Object* cloneType() const override { return new Self; }
    [[nodiscard]] osg::Object* clone(const osg::CopyOp& copyop) const override {
        Self* const copy = new Self(static_cast<const Self&>(*this));
        if constexpr (std::is_base_of_v<osg::Callback, Base>)
            copy->setNestedCallback(copyop(copy->getNestedCallback()));
        return copy;
    }
};

/// Moves a MatrixTransform by an equal step in every frame, in its own frame.
class Mover : public Cloned<Mover, osg::NodeCallback> {
public:
    Mover() = default;
    Mover(const osg::Matrixd& start, const osg::Vec3d& step, int frame) : _start(start), _step(step), _frame(frame) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

private:
    osg::Matrixd _start;
    osg::Vec3d _step;
    int _frame = 0;
};

/// Does nothing, or leaves its node out of the odd frames.
class Passer : public Cloned<Passer, osg::NodeCallback> {
public:
    explicit Passer(bool skipsOddFrames = false) : _skipsOddFrames(skipsOddFrames) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

private:
    bool _skipsOddFrames;
};

/// Leaves a child of its group out of the cull traversal, or all of a node that is no plain group.
class LeaverOut : public Cloned<LeaverOut, osg::NodeCallback> {
public:
    explicit LeaverOut(unsigned int number = 0) : _number(number) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

private:
    unsigned int _number;  // of the children, counted around
};

/// Pushes a state in the cull traversal.
class StatePusher : public Cloned<StatePusher, osg::NodeCallback> {
public:
    explicit StatePusher(osg::StateSet* states = nullptr) : _states(states) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

private:
    osg::ref_ptr<osg::StateSet> _states;
};

/// Sets the traversal mask for what is below.
class Masker : public Cloned<Masker, osg::NodeCallback> {
public:
    explicit Masker(osg::Node::NodeMask mask = ~0u) : _mask(mask) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

private:
    osg::Node::NodeMask _mask;
};

/// Takes itself off when it has run.
class OneShotCallback : public Cloned<OneShotCallback, osg::NodeCallback> {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;
};

/// Computes the bound that OSG computes without it, or a wrong one, or none: see Kind.
class OwnBound : public Cloned<OwnBound, osg::Node::ComputeBoundingSphereCallback> {
public:
    enum Kind { Right, Elsewhere, Small, Unknown };
    explicit OwnBound(Kind kind = Right) : _kind(kind) {}
    [[nodiscard]] osg::BoundingSphere computeBound(const osg::Node& node) const override {
        const osg::BoundingSphere bound = node.computeBound();
        if (_kind == Unknown) return {};
        return {bound.center() * (_kind == Elsewhere ? 20.0f : 1.0f), _kind == Small ? 1.0f : bound.radius()};
    }

private:
    Kind _kind;
};

/// Computes the box that OSG computes without it.
class OwnBox : public Cloned<OwnBox, osg::Drawable::ComputeBoundingBoxCallback> {
public:
    [[nodiscard]] osg::BoundingBox computeBound(const osg::Drawable& drawable) const override {
        return drawable.computeBoundingBox();
    }
};

/// Leaves a drawable out, or keeps it.
class DrawableLeaverOut : public Cloned<DrawableLeaverOut, osg::DrawableCullCallback> {
public:
    explicit DrawableLeaverOut(bool leavesOut = false) : _leavesOut(leavesOut) {}

    bool cull(osg::NodeVisitor* nv, osg::Drawable* drawable, osg::RenderInfo* info) const override;

private:
    bool _leavesOut;
};

/// Draws a drawable, or nothing in its place.
class OwnDrawing : public Cloned<OwnDrawing, osg::Drawable::DrawCallback> {
public:
    explicit OwnDrawing(bool draws = true) : _draws(draws) {}

    void drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const override;

private:
    bool _draws;
};

/// Looks at every visitor that it meets as applications do: one of the cull traversal is a CullVisitor, and the handler
/// of its requests is a DatabasePager. What is otherwise is told by takeComplaint().
class CastingGroup : public osg::Group {
public:
    CastingGroup() = default;
    CastingGroup(const CastingGroup& other, const osg::CopyOp& copyop);
    [[nodiscard]] osg::Object* cloneType() const override { return new CastingGroup; }
    [[nodiscard]] osg::Object* clone(const osg::CopyOp& copyop) const override {
        return new CastingGroup(*this, copyop);
    }

    void traverse(osg::NodeVisitor& nv) override;
};

/// Returns: what a CastingGroup has seen since the last call, else nothing.
[[nodiscard]] std::string takeComplaint();

}  // namespace osgAnalyticBin::test
