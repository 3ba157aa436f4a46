// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Parts.h"

#include <osgAnalyticBin/Declarations.h>

namespace osgAnalyticBin::test {

namespace {

std::string complaint;
std::vector<std::function<void()>> undoing;

/// Where a visitor is, and what it has decided there.
struct Whereabouts {
    explicit Whereabouts(osgUtil::CullVisitor& visitor)
        : path(visitor.getNodePath()),
          states(visitor.getCurrentStateGraph()),
          undecided(visitor.getCurrentCullingSet().getFrustum().getCurrentMask()) {}
    bool operator==(const Whereabouts& other) const {
        return path == other.path && states == other.states && undecided == other.undecided;
    }
    /// Whether each node of the path is a child of the one before.
    [[nodiscard]] bool isConnected() const {
        const auto isApart = [](osg::Node* above, osg::Node* below) {
            return !above->asGroup() || !above->asGroup()->containsNode(below);
        };
        return std::adjacent_find(path.begin(), path.end(), isApart) == path.end();
    }

    const osg::NodePath path;
    const osgUtil::StateGraph* const states;
    const osg::Polytope::ClippingMask undecided;
};

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

/// Does something in place of the traversal, which it may go on with.
class Acting : public Cloned<Acting, osg::NodeCallback> {
public:
    using Action = std::function<void(Acting&, osg::Node*, osg::NodeVisitor*)>;
    explicit Acting(Action action = {}) : _action(std::move(action)) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        if (!nv->asCullVisitor()) return act(node, nv);
        const Whereabouts before(*nv->asCullVisitor());
        if (!before.isConnected() || before.path.back() != node) complaint = "a callback is run away from its node";
        act(node, nv);
        if (!(Whereabouts(*nv->asCullVisitor()) == before))
            complaint = "a visitor leaves a node otherwise than it came";
    }

private:
    void act(osg::Node* node, osg::NodeVisitor* nv) {
        _action ? _action(*this, node, nv) : static_cast<void>(traverse(node, nv));
    }

    Action _action;
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
struct OwnBox : Cloned<OwnBox, osg::Drawable::ComputeBoundingBoxCallback> {
    [[nodiscard]] osg::BoundingBox computeBound(const osg::Drawable& drawable) const override {
        return drawable.computeBoundingBox();
    }
};

/// Leaves a drawable out, or keeps it.
struct DrawableLeaverOut : Cloned<DrawableLeaverOut, osg::DrawableCullCallback> {
    explicit DrawableLeaverOut(bool isOut = false) : leavesOut(isOut) {}
    bool cull(osg::NodeVisitor*, osg::Drawable*, osg::RenderInfo*) const override { return leavesOut; }
    bool leavesOut;
};

/// Draws a drawable, or nothing in its place.
struct OwnDrawing : Cloned<OwnDrawing, osg::Drawable::DrawCallback> {
    explicit OwnDrawing(bool isDrawn = true) : draws(isDrawn) {}
    void drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const override {
        if (draws) drawable->drawImplementation(info);
    }
    bool draws;
};

bool isCull(const osg::NodeVisitor& nv) {
    return nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR;
}

// Whether all children are traversed.
bool isPlainGroup(const osg::Node& node) {
    return node.asGroup() && !node.asSwitch() && !dynamic_cast<const osg::LOD*>(&node) &&
           !dynamic_cast<const osg::Sequence*>(&node) && !dynamic_cast<const osgTerrain::TerrainTile*>(&node);
}

// Does nothing, or leaves its node out of the odd frames.
Acting* makePasser(bool skipsOddFrames) {
    return new Acting([=](Acting& self, osg::Node* node, osg::NodeVisitor* nv) {
        if (!isCull(*nv) || !skipsOddFrames || nv->getTraversalNumber() % 2 == 0) self.traverse(node, nv);
    });
}

// Leaves a child of its group out of the cull traversal, or all of a node that is no plain group. `number`: of the
// children, counted around.
Acting* makeLeaverOut(unsigned int number) {
    return new Acting([=](Acting& self, osg::Node* node, osg::NodeVisitor* nv) {
        if (!isCull(*nv)) return static_cast<void>(self.traverse(node, nv));
        osg::Group* const group = isPlainGroup(*node) ? node->asGroup() : nullptr;
        for (unsigned int i = 0; group && i < group->getNumChildren(); ++i)
            if (i != number % group->getNumChildren()) group->getChild(i)->accept(*nv);
    });
}

// Pushes a state in the cull traversal.
Acting* makeStatePusher(const Part& part) {
    const osg::ref_ptr<osg::StateSet> states = new osg::StateSet;
    setState(part.variant, part.value, *states);
    return new Acting([=](Acting& self, osg::Node* node, osg::NodeVisitor* nv) {
        osgUtil::CullVisitor* const visitor = nv->asCullVisitor();
        if (visitor) visitor->pushStateSet(states);
        self.traverse(node, nv);
        if (visitor) visitor->popStateSet();
    });
}

// Sets the traversal mask for what is below.
Acting* makeMasker(osg::Node::NodeMask mask) {
    return new Acting([=](Acting& self, osg::Node* node, osg::NodeVisitor* nv) {
        const osg::Node::NodeMask before = nv->getTraversalMask();
        if (isCull(*nv)) nv->setTraversalMask(before & mask);
        self.traverse(node, nv);
        nv->setTraversalMask(before);
    });
}

// Changes the next tile of the row when the traversal comes to its node. Variants: masks it; masks its mesh; shows it.
Acting* makeMeddler(const Part& part) {
    TileKey next = part.tile;
    ++next.column;
    const std::string name = nodeName(part.variant == 1 ? Hook::Own : Hook::Tile, next);
    Acting* const meddler = new Acting([=](Acting& self, osg::Node* node, osg::NodeVisitor* nv) {
        const osg::ref_ptr<osg::Node> tile = isCull(*nv) ? findNode(*nv->getNodePath().front(), name) : nullptr;
        if (tile) {
            undoing.push_back([tile, mask = tile->getNodeMask()] { tile->setNodeMask(mask); });
            tile->setNodeMask(part.variant == 2 ? ~0u : 0);
        }
        self.traverse(node, nv);
    });
    setTraversesAlways(*meddler);
    return meddler;
}

// Takes itself off when it has run.
Acting* makeOneShot() {
    return new Acting([](Acting& self, osg::Node* node, osg::NodeVisitor* nv) {
        const osg::ref_ptr<Acting> keep(&self);
        self.traverse(node, nv);
        node->removeUpdateCallback(&self);
    });
}

// In front of what is there, or behind it.
void hang(const osg::ref_ptr<osg::NodeCallback>& callback, bool isNested, osg::Node& node) {
    if (isNested) return node.addCullCallback(callback);
    callback->setNestedCallback(node.getCullCallback());
    node.setCullCallback(callback);
}

// What is masked is one child.
void addMasker(const Part& part, bool isNested, osg::Node& node) {
    constexpr osg::Node::NodeMask kMasked = 2;
    osg::Group* const group = node.asGroup();
    if (!group || group->getNumChildren() == 0) return;
    group->getChild(static_cast<unsigned int>(part.variant) % group->getNumChildren())->setNodeMask(kMasked);
    hang(makeMasker(~kMasked), isNested, node);
}

// OSG takes no notice of one that computes what it would.
void setBoundCallback(OwnBound::Kind kind, osg::Node& node) {
    node.setComputeBoundingSphereCallback(new OwnBound(kind));
    if (kind != OwnBound::Right) node.dirtyBound();
}

// Variants: whether it leaves out, or draws nothing.
void setDrawableCallback(const Part& part, osg::Drawable& drawable) {
    const bool isOdd = part.variant % 2 == 1;
    switch (part.kind) {
        case PartKind::DrawableCull:
            return drawable.setCullCallback(new DrawableLeaverOut(isOdd));
        case PartKind::DrawableDraw:
            return drawable.setDrawCallback(new OwnDrawing(!isOdd));
        case PartKind::DrawableUpdate:
            return drawable.setUpdateCallback(new osg::DrawableUpdateCallback);
        case PartKind::DrawableBound:
            drawable.setComputeBoundingBoxCallback(new OwnBox);
            return drawable.dirtyBound();
        default:
            return;
    }
}

}  // namespace

osg::ref_ptr<osg::NodeCallback> makeMover(const osg::Matrixd& start, const osg::Vec3d& step, int frame) {
    return new Acting([=](Acting& self, osg::Node* node, osg::NodeVisitor* nv) {
        auto* const transform = dynamic_cast<osg::MatrixTransform*>(node);
        if (transform && nv->getFrameStamp()) {
            const int frames = static_cast<int>(nv->getFrameStamp()->getFrameNumber()) - frame;
            transform->setMatrix(osg::Matrixd::translate(step * frames) * start);
        }
        self.traverse(node, nv);
    });
}

void addCallback(const Part& part, osg::Node& node) {
    const bool isNested = part.id % 2 == 0;
    switch (part.kind) {
        case PartKind::UserCull:
            return hang(makePasser(part.variant >= 2), part.variant % 2 == 0, node);
        case PartKind::UserUpdate:
            return node.addUpdateCallback(makePasser(false));
        case PartKind::LeavesOut:
            return hang(makeLeaverOut(static_cast<unsigned int>(part.variant)), isNested, node);
        case PartKind::OneShot:
            return node.addUpdateCallback(makeOneShot());
        case PartKind::PushesState:
            return hang(makeStatePusher(part), isNested, node);
        case PartKind::Masks:
            return addMasker(part, isNested, node);
        case PartKind::Meddles:
            return hang(makeMeddler(part), isNested, node);
        case PartKind::BoundCallback:
            return setBoundCallback(static_cast<OwnBound::Kind>(part.variant), node);
        case PartKind::NoBoundCallback:
            return node.setComputeBoundingSphereCallback(nullptr);
        default:
            if (node.asDrawable()) setDrawableCallback(part, *node.asDrawable());
    }
}

void CastingGroup::traverse(osg::NodeVisitor& nv) {
    if (isCull(nv)) {
        osg::NodeVisitor::DatabaseRequestHandler* const handler = nv.getDatabaseRequestHandler();
        if (!dynamic_cast<osgUtil::CullVisitor*>(&nv))
            complaint = "a visitor of type CULL_VISITOR is no CullVisitor";
        else if (handler && !dynamic_cast<osgDB::DatabasePager*>(handler))
            complaint = "the handler of requests is no DatabasePager";
    }
    osg::Group::traverse(nv);
}

void undoMeddling() {
    for (const auto& undo : std::exchange(undoing, {})) undo();
}

std::string takeComplaint() {
    return std::exchange(complaint, {});
}

}  // namespace osgAnalyticBin::test
