// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RivalCullCallback.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <osg/Polytope>

namespace osgAnalyticBin::rivals {

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
    const core::ParameterBox box = core::parameterBox(bin.bin());
    switch (options.rule) {
        case Rule::Paper:
            return PaperBin(core::GeodeticMapping(ellipsoid), box);
        case Rule::Corners:
            return CornersBin(core::GeodeticMapping(ellipsoid), box);
        case Rule::Box:
            return BoxBin(ellipsoid, bin.bin(), bin.margin());
        case Rule::OrientedBox:
            break;
    }
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

}  // namespace osgAnalyticBin::rivals
