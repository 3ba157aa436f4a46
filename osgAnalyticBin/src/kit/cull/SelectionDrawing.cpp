// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Draws what was selected.

#include "../Classes.h"
#include "CullScopes.h"
#include "CullTraversal.h"
#include "DrawnState.h"
#include "SelectionWalk.h"
#include "TileSelection.h"

#include <osgUtil/CullVisitor>

#include <optional>
#include <vector>

namespace osgAnalyticBin {

namespace {

// The states and the node path of places, pushed on a visitor as they are needed.
class Places {
    using Number = TileSelection::Number;
    static constexpr Number kNone = TileSelection::kNone;

public:
    Places(const TileSelection& selection, osg::NodeVisitor& visitor)
        : _selection(selection), _visitor(visitor), _cullVisitor(visitor.asCullVisitor()) {}
    ~Places() { enter(kNone); }
    Places(const Places&) = delete;
    Places& operator=(const Places&) = delete;

    void setState(Number place) {
        if (!_cullVisitor) return;
        const Number wanted = place == kNone ? kNone : _selection.places()[place].withState;
        if (wanted == (_states.empty() ? kNone : _states.back())) return;
        const auto above = [this](Number at) {
            const Number outer = _selection.places()[at].above;
            return outer == kNone ? kNone : _selection.places()[outer].withState;
        };
        change(
            _states, wanted, above, [this](Number at) { _cullVisitor->pushStateSet(_selection.places()[at].state); },
            [this] { _cullVisitor->popStateSet(); });
    }

    void enter(Number place) {
        setState(place);
        if (place == (_path.empty() ? kNone : _path.back())) return;
        change(
            _path, place, [this](Number at) { return _selection.places()[at].above; },
            [this](Number at) { _visitor.pushOntoNodePath(_selection.places()[at].node); },
            [this] { _visitor.popFromNodePath(); });
    }

private:
    // Numbers of places grow from the outside inward.
    template <class Above, class Push, class Pop>
    void change(std::vector<Number>& entered, Number wanted, const Above& above, const Push& push, const Pop& pop) {
        while (!entered.empty() && (wanted == kNone || wanted < entered.back())) {
            entered.pop_back();
            pop();
        }
        if (wanted == (entered.empty() ? kNone : entered.back())) return;
        change(entered, above(wanted), above, push, pop);
        entered.push_back(wanted);
        push(wanted);
    }

    const TileSelection& _selection;
    osg::NodeVisitor& _visitor;
    osgUtil::CullVisitor* const _cullVisitor;
    std::vector<Number> _states, _path;
};

// Enters a node as osgUtil::CullVisitor does it, without its test of the sphere: for nodes that were tested together
// with their siblings. `callback`: what is nested in that of a bin; null: none. Requires: a visitor of this very type,
// and a node that it enters by apply(osg::LOD&) or apply(osg::Group&).
void enterWithoutTest(osg::Node& node, osgUtil::CullVisitor& visitor, osg::Callback* callback) {
    if (!visitor.validNodeMask(node)) return;
    osg::StateSet* const state = node.getStateSet();
    visitor.pushOntoNodePath(&node);
    if (state) visitor.pushStateSet(state);
    if (callback) {
        callback->run(&node, &visitor);
    } else {
        node.traverse(visitor);
    }
    if (state) visitor.popStateSet();
    visitor.popFromNodePath();
}

class SelectionDrawing {
    using Number = TileSelection::Number;
    using Way = TileSelection::Way;

public:
    explicit SelectionDrawing(const DatabaseView& view)
        : _selection(*view.selection),
          _visitor(view.visitor),
          _traversal(view.traversal),
          _pager(view.pager),
          _gain(view.gain),
          _cullVisitor(isExactly<osgUtil::CullVisitor>(_visitor) ? _visitor.asCullVisitor() : nullptr),
          _cullStack(view.cullStack),
          _canDraw(_cullVisitor && FamilyTile::canDraw(*_cullVisitor)) {}

    void draw(Number number) {
        const TileSelection::Segment segment = _selection.segment(number);
        stamp(number, segment);
        BinCounts counts = segment.counts;
        _limit = frustum().getCurrentMask();
        {
            Places places(_selection, _visitor);
            Number end = 0;
            for (Number i = segment.firstKept; i < segment.endOfKept; i = end) {
                // the list may grow while a node is entered
                const TileSelection::Kept kept = _selection.kept()[i];
                end = kept.end;
                kept.isOccluded ? countOccluded(kept, counts) : draw(kept, places);
            }
        }
        setUndecided(frustum(), _limit);
        if (_visitor.getVisitorType() != osg::NodeVisitor::CULL_VISITOR) return;
        if (_gain) {
            _gain->saved += counts.occluded;
            _gain->direct += _direct;
        }
        counts.frame = static_cast<unsigned int>(_visitor.getTraversalNumber());
        _traversal.statistics().add(counts);
    }

private:
    // OSG's stack of culling sets may move while a node is entered.
    [[nodiscard]] osg::Polytope& frustum() { return _cullStack.getCurrentCullingSet().getFrustum(); }

    // As osg::PagedLOD::traverse() does it.
    void stamp(Number number, const TileSelection::Segment& segment) {
        const osg::FrameStamp* const now = _visitor.getFrameStamp();
        for (Number i = segment.firstPlace; i < segment.endOfPlaces; ++i) {
            const TileSelection::Place& place = _selection.places()[i];
            if (!place.paged || place.segment != number) continue;
            place.paged->setFrameNumberOfLastTraversal(now->getFrameNumber());
            place.paged->setTimeStamp(place.level, now->getReferenceTime());
            place.paged->setFrameNumber(place.level, now->getFrameNumber());
        }
    }

    static void countOccluded(const TileSelection::Kept& kept, BinCounts& counts) {
        ++counts.occluded;
        ++counts.outside;
        --(kept.undecided == 0 ? counts.inside : counts.straddling);
    }

    void draw(const TileSelection::Kept& kept, Places& places) {
        const core::PlaneMask undecided = kept.undecided & _limit;
        if (_selection.isHeld() && isMasked(kept)) return;
        if (kept.way == Way::Mesh) {
            places.setState(kept.place);
            if (_canDraw && kept.member->draw(*_cullVisitor, undecided)) return static_cast<void>(++_direct);
        }
        if (!isOsgAlone(kept)) _selection.hold();
        places.enter(kept.place);
        setUndecided(frustum(), undecided);
        const PlanesBelow planes(_cullStack, undecided);
        std::optional<NoRequests> withoutFiles;
        if (kept.waits) withoutFiles.emplace(_visitor);
        enter(kept);
    }

    // Whether OSG runs none of the application's code in the node: it draws the tile's mesh and may ask for a file.
    [[nodiscard]] bool isOsgAlone(const TileSelection::Kept& kept) const {
        if (kept.way != Way::Untested || !kept.member->isMeshAlone(*kept.node, *_cullVisitor)) return false;
        return kept.waits || _visitor.getDatabaseRequestHandler() == _pager;
    }

    // A callback of the application's may have set masks since they were asked. Those of places are asked once for all
    // that lies in the same one, as OSG asks them where it comes to a node.
    [[nodiscard]] bool isMasked(const TileSelection::Kept& kept) {
        if (kept.place != _lastPlace) {
            _isLastMasked = false;
            for (Number at = kept.place; at != TileSelection::kNone; at = _selection.places()[at].above)
                _isLastMasked = _isLastMasked || !_visitor.validNodeMask(*_selection.places()[at].node);
        }
        _lastPlace = kept.place;
        return _isLastMasked || !_visitor.validNodeMask(*kept.node);
    }

    void enter(const TileSelection::Kept& kept) {
        const bool isUntested =
            kept.way == Way::Untested || (kept.way == Way::Mesh && kept.member->isEnteredUntested(*_cullVisitor));
        if (isUntested) {
            // that of the bin has nothing left to do
            osg::Callback* const callback = kept.node->getCullCallback();
            const bool isOfBin = callback == kept.member->callback();
            return enterWithoutTest(*kept.node, *_cullVisitor, isOfBin ? callback->getNestedCallback() : nullptr);
        }
        if (kept.way != Way::Tile) return kept.node->accept(_visitor);
        // OSG does not test the sphere in this mask; the tile's callback sets the mask of what is below again
        const osg::CullingSet::Mask mask = _cullStack.getCurrentCullingSet().getCullingMask();
        _cullStack.getCurrentCullingSet().setCullingMask(osg::CullingSet::NO_CULLING);
        _traversal.setKept(kept.node, mask);
        kept.node->accept(_visitor);
        _traversal.setKept(nullptr, mask);
        _cullStack.getCurrentCullingSet().setCullingMask(mask);
    }

    TileSelection& _selection;
    osg::NodeVisitor& _visitor;
    CullTraversal& _traversal;
    const osg::Referenced* const _pager;       // null: another than OSG's is asked for files, or none
    Gain* const _gain;                         // null: not counted
    osgUtil::CullVisitor* const _cullVisitor;  // null: a visitor of another class
    osg::CullStack& _cullStack;
    const bool _canDraw;
    core::PlaneMask _limit = 0;
    unsigned int _direct = 0;  // drawn
    Number _lastPlace = TileSelection::kNone;
    bool _isLastMasked = false;
};

}  // namespace

void TileFamily::draw(osg::Group& group, const DatabaseView& view) const {
    TileSelection& selection = *view.selection;
    const core::PlaneMask undecided = view.cullStack.getCurrentCullingSet().getFrustum().getCurrentMask();
    const bool areSame = selection.conditions() == TileSelection::Conditions::of(view.visitor, view.cullStack);
    const TileSelection::Number found = areSame ? selection.find(*this, undecided) : TileSelection::kNone;
    const bool mayHide = (found == TileSelection::kNone ? view.eye != nullptr : selection.segment(found).hides) &&
                         drawnStateAbove(view.visitor, view.rules, view.states).obeysDepth;
    if (found != TileSelection::kNone && (mayHide || !selection.segment(found).hides))
        return SelectionDrawing(view).draw(found);
    DatabaseView own = view;
    own.selection = &view.traversal.selection();
    own.selection->begin(TileSelection::Conditions::of(view.visitor, view.cullStack));
    {
        const CullTraversal::DatabaseScope scope(view.visitor, view.traversal, &own);
        SelectionWalk walk(own, mayHide ? own.eye : nullptr, nullptr);
        SelectionDrawing(own).draw(walk.selectBelow(group, *this));
    }
    own.selection->clear();
}

}  // namespace osgAnalyticBin
