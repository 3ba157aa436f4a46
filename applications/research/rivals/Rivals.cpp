// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Rivals.h"

#include "FrustumHull.h"
#include "Nodes.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <osg/Geode>
#include <osg/NodeCallback>
#include <osg/Polytope>

#include <map>

namespace osgAnalyticBin::rivals {

using hull::FrustumHull;

namespace {

/// The planes of a frustum in ECEF, prepared once for all tiles that this thread culls by them.
class Frustum {
public:
    void set(const osg::Polytope::PlaneList& list) {
        if (list == _list) return;
        _list = list;
        _planes = planesOf(list, nullptr);
        _hull.reset();
    }

    [[nodiscard]] const core::PlaneSet& planes() const { return _planes; }

    [[nodiscard]] static core::PlaneSet planesOf(const osg::Polytope::PlaneList& list, const osg::Matrixd* fromEcef) {
        core::PlaneSet planes;
        for (osg::Plane plane : list) {
            if (planes.size() == core::kMaxPlanes) break;
            if (fromEcef) plane.transformProvidingInverse(*fromEcef);
            planes.push_back({{plane[0], plane[1], plane[2]}, plane[3]});
        }
        return planes;
    }

    [[nodiscard]] const FrustumHull& hull() {
        if (!_hull) _hull.emplace(_planes, _planes.size());
        return *_hull;
    }

private:
    osg::Polytope::PlaneList _list;
    core::PlaneSet _planes;
    std::optional<FrustumHull> _hull;
};

/// Lets OSG test the undecided planes alone, below the tile and below transforms in it, until the tile is left.
class UndecidedBelow {
public:
    UndecidedBelow(osg::CullStack& cullStack, core::PlaneMask undecided)
        : _cullStack(cullStack), _before(here().getCurrentMask()), _beforeBelow(below().getCurrentMask()) {
        set(undecided);
        if (below().getPlaneList().size() == here().getPlaneList().size()) below().getCurrentMask() &= undecided;
    }
    ~UndecidedBelow() {
        set(_before);
        below().getCurrentMask() = _beforeBelow;
    }
    UndecidedBelow(const UndecidedBelow&) = delete;
    UndecidedBelow& operator=(const UndecidedBelow&) = delete;

private:
    [[nodiscard]] osg::Polytope& here() { return _cullStack.getCurrentCullingSet().getFrustum(); }
    [[nodiscard]] osg::Polytope& below() { return _cullStack.getProjectionCullingStack().back().getFrustum(); }
    void set(core::PlaneMask undecided) {
        here().getCurrentMask() = undecided;
        here().setResultMask(undecided);
    }

    osg::CullStack& _cullStack;
    const core::PlaneMask _before, _beforeBelow;
};

}  // namespace

RivalCullCallback::RivalCullCallback(AnalyticBinCullCallback& tile, const RivalOptions& options)
    : _shown(tile.shownBin()),
      _bin(rivalBin(_shown, tile.ellipsoid(), options)),
      _testsEdges(options.testsEdges),
      _isInEcef(tile.getLocalToEcef().isIdentity()),
      _fromEcef(osg::Matrixd::inverse(tile.getLocalToEcef())) {
    const core::Ellipsoid ellipsoid = tile.ellipsoid();
    const bool isBox = std::holds_alternative<Box>(_bin);
    if (_testsEdges && !isBox && core::ExactGeodeticBin::holds(ellipsoid, _shown.bin()))
        _exact.emplace(ellipsoid, _shown.bin(), _shown.margin());
    if (options.usesHorizon && !ellipsoid.isPlane()) {
        _horizon.emplace(ellipsoid, _shown.bin(), _shown.margin());
        if (isBox) _horizonPoint.emplace(*_horizon);
    }
    // a tile that is culled is out of view, or should be
    setTraversesAlways(*this);
    setNestedCallback(&tile);
}

RivalCullCallback::RivalBin RivalCullCallback::rivalBin(const AnalyticBin& bin, const core::Ellipsoid& ellipsoid,
                                                        const RivalOptions& options) {
    const core::GeodeticMapping mapping(ellipsoid);
    if (options.rule == Rule::Paper) return PaperBin(mapping, core::parameterBox(bin.bin()));
    if (options.rule == Rule::Corners) return CornersBin(mapping, core::parameterBox(bin.bin()));
    if (options.rule == Rule::Box) return BoxBin(ellipsoid, bin.bin(), bin.margin());
    return OrientedBoxBin(ellipsoid, bin.bin(), bin.margin());
}

bool RivalCullCallback::isFor(const AnalyticBinCullCallback& tile) const {
    return getNestedCallback() == &tile && _shown == tile.shownBin();
}

bool RivalCullCallback::isHidden(osg::NodeVisitor& visitor) const {
    const core::HorizonEye* const eye = _horizon ? AnalyticBinCullCallback::horizonEye(visitor) : nullptr;
    return eye && (_horizonPoint ? _horizonPoint->isHiddenFrom(*eye) : eye->hides(*_horizon));
}

core::Side RivalCullCallback::test(osg::NodeVisitor& visitor, osg::CullStack& cullStack,
                                   core::PlaneMask& undecided) const {
    const osg::Polytope::PlaneList& list = cullStack.getCurrentCullingSet().getFrustum().getPlaneList();
    thread_local Frustum frustum;
    core::PlaneSet own;
    if (_isInEcef)
        frustum.set(list);
    else
        own = Frustum::planesOf(list, &_fromEcef);
    const core::PlaneSet& planes = _isInEcef ? frustum.planes() : own;
    const core::Side side = std::visit([&](const auto& bin) { return core::classify(bin, planes, undecided); }, _bin);
    if (side == core::Side::Outside || isHidden(visitor)) return core::Side::Outside;
    if (side == core::Side::Inside || !_testsEdges) return side;
    const auto* const box = std::get_if<Box>(&_bin);
    const bool isApart = !box        ? _exact && core::isSeparated(*_exact, planes, planes.size(), undecided)
                         : _isInEcef ? isSeparated(*box, frustum.hull())
                                     : isSeparated(*box, FrustumHull(own, own.size()));
    return isApart ? core::Side::Outside : side;
}

bool RivalCullCallback::run(osg::Object* object, osg::Object* data) {
    osg::NodeVisitor& visitor = *data->asNodeVisitor();
    const auto goOn = [&] {
        osg::Callback* const next = getNestedCallback()->getNestedCallback();
        if (next) return next->run(object, data);
        visitor.traverse(*object->asNode());
        return true;
    };
    osg::CullStack* const cullStack = visitor.asCullStack();
    if (!cullStack) return goOn();
    osg::CullingSet& cullingSet = cullStack->getCurrentCullingSet();
    core::PlaneMask undecided = cullingSet.getFrustum().getCurrentMask();
    core::Side side = core::Side::Straddling;
    if (cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING)
        side = test(visitor, *cullStack, undecided);
    if (visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR)
        BinStatistics::of(visitor).count(side, visitor.getTraversalNumber());
    if (side == core::Side::Outside) return true;
    const UndecidedBelow planes(*cullStack, undecided);
    return goOn();
}

namespace {

void removeRival(osg::Node& node, RivalCullCallback& rival) {
    const osg::ref_ptr<RivalCullCallback> kept(&rival);
    const osg::ref_ptr<osg::Callback> nested = rival.getNestedCallback();
    if (node.getCullCallback() != &rival) return node.removeCullCallback(&rival);
    node.setCullCallback(nested);
    rival.setNestedCallback(nullptr);
}

// Puts the rule in front of the kit's callback where it has none, or an older bin's. Returns: whether it did.
bool place(osg::Node& node, const RivalOptions& options) {
    auto* const old = support::findCallback<RivalCullCallback>(node.getCullCallback());
    osg::Callback* const first = node.getCullCallback();
    auto* const tile = dynamic_cast<AnalyticBinCullCallback*>(old && old == first ? first->getNestedCallback() : first);
    if (tile && old && old == first && old->isFor(*tile)) return false;
    if (old) removeRival(node, *old);
    if (!tile || !tile->shownBin().valid()) return false;
    node.setCullCallback(new RivalCullCallback(*tile, options));
    node.setCullingActive(false);
    return true;
}

std::size_t placeAll(osg::Node& scene, const RivalOptions& options) {
    std::size_t placed = 0;
    support::visitNodes(scene, [&](osg::Node& node, osg::NodeVisitor&) {
        placed += place(node, options) ? 1U : 0U;
        return !dynamic_cast<osg::Geode*>(&node);
    });
    return placed;
}

/// Follows what is paged in.
class Follower final : public osg::NodeCallback {
public:
    explicit Follower(const RivalOptions& options) : _options(options) {}

    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        // the kit may renew its callbacks meanwhile
        traverse(node, visitor);
        (void)placeAll(*node, _options);
    }

private:
    const RivalOptions _options;
};

/// Has the kit leave each tile to its own callback.
class TileByTile final : public osg::NodeCallback {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        if (!visitor->asCullStack()) {
            traverse(node, visitor);
            return;
        }
        BinStatistics& statistics = BinStatistics::of(*visitor);
        const bool before = statistics.isTileByTile();
        statistics.setTileByTile(true);
        traverse(node, visitor);
        statistics.setTileByTile(before);
    }
};

}  // namespace

Rule ruleNamed(const std::string& name) {
    static const std::map<std::string, Rule> rules{
        {"paper", Rule::Paper}, {"corners", Rule::Corners}, {"box", Rule::Box}, {"orientedbox", Rule::OrientedBox}};
    return rules.at(name);
}

std::size_t installRivals(osg::Node& root, const RivalOptions& options) {
    const osg::ref_ptr<TileByTile> tileByTile = new TileByTile;
    setTraversesAlways(*tileByTile);
    tileByTile->setNestedCallback(root.getCullCallback());
    root.setCullCallback(tileByTile);
    root.addUpdateCallback(new Follower(options));
    return placeAll(root, options);
}

}  // namespace osgAnalyticBin::rivals
