// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxFamily.h"

#include "../CallbackChain.h"
#include "../cull/BinCulling.h"
#include "BoxCullCallback.h"

#include <osg/PagedLOD>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

// A plain LOD without callbacks is entered as osgUtil::CullVisitor does it, but for the test of its sphere, which is
// switched off.
void enter(osg::Node& child, const BoxSlots::Slot& slot, osg::NodeVisitor& nv) {
    const bool isAsUsual = slot.isPlain && !child.getCullCallback() && !child.getCullingActive();
    if (!isAsUsual || typeid(nv) != typeid(osgUtil::CullVisitor)) return child.accept(nv);
    enterWithoutTest(child, static_cast<osgUtil::CullVisitor&>(nv));
}

// Whether what is in view is culled all the same: as a small feature.
bool isCulledInView(const BoxTest& test, const osg::Node& node, osg::CullStack& cullStack) {
    return test.isTested && isSmall(cullStack.getCurrentCullingSet(), test.sphereOf(node));
}

}  // namespace

BoxFamily::BoxFamily(const BoxFamily& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}

BoxFamily::BoxFamily(osg::Group& group, BoxSet& set, const std::function<BoxTile*(const osg::Node&)>& tileOf)
    : _group(&group), _set(&set), _slots(new BoxSlots(group.getNumChildren())) {
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
        osg::Node& child = *group.getChild(i);
        BoxTile* const tile = tileOf(child);
        if (!tile) continue;
        const bool isPlain = typeid(child) == typeid(osg::PagedLOD) || typeid(child) == typeid(osg::LOD);
        _slots->slots[i] = {{}, &child, isPlain, child.getCullingActive()};
        tile->join(*_slots, i);
        child.setCullingActive(false);
    }
}

void BoxFamily::place(osg::Group& group, BoxSet& set, const std::function<BoxTile*(const osg::Node&)>& tileOf) {
    const osg::ref_ptr<BoxFamily> family = new BoxFamily(group, set, tileOf);
    const auto isTile = [](const BoxSlots::Slot& slot) { return slot.node != nullptr; };
    const std::vector<BoxSlots::Slot>& slots = family->_slots->slots;
    if (std::any_of(slots.begin(), slots.end(), isTile)) group.addCullCallback(family);
}

void BoxFamily::remove(osg::Group& group) {
    const osg::ref_ptr<BoxFamily> family = findCallback<BoxFamily>(group.getCullCallback());
    if (!family) return;
    takeOff(group, *family);
    for (unsigned int i = 0; family->_slots && i < group.getNumChildren(); ++i) {
        osg::Node& child = *group.getChild(i);
        for (const BoxSlots::Slot& slot : family->_slots->slots) {
            if (slot.node == &child) child.setCullingActive(slot.wasCullingActive);
        }
    }
}

bool BoxFamily::culls(const osg::Node& group, osg::CullStack& cullStack) const {
    const osg::CullingSet::Mask mask = cullStack.getCurrentCullingSet().getCullingMask();
    return &group == _group && !getNestedCallback() && !_set->isRemoved() &&
           (mask & osg::CullingSet::VIEW_FRUSTUM_CULLING);
}

void BoxFamily::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* const cullStack = nv->asCullStack();
    if (!cullStack || !culls(*node, *cullStack)) {
        traverse(node, nv);
        return;
    }
    cullChildren(*node->asGroup(), *nv, *cullStack);
}

void BoxFamily::cullChildren(osg::Group& group, osg::NodeVisitor& nv, osg::CullStack& cullStack) const {
    const core::PlaneMask before = cullStack.getCurrentCullingSet().getFrustum().getCurrentMask();
    const std::vector<BoxSlots::Slot>& slots = _slots->slots;
    BinCounts counts;
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
        osg::Node& child = *group.getChild(i);
        if (i >= slots.size() || slots[i].node != &child) {
            child.accept(nv);
            continue;
        }
        // OSG's stack of culling sets may move while a child is entered
        osg::Polytope& frustum = cullStack.getCurrentCullingSet().getFrustum();
        core::PlaneMask undecided = before;
        const core::Side side = slots[i].test.sideOf(frustum.getPlaneList(), undecided, child);
        if (side == core::Side::Outside || isCulledInView(slots[i].test, child, cullStack)) {
            ++counts.outside;
            continue;
        }
        ++(side == core::Side::Inside ? counts.inside : counts.straddling);
        setUndecided(frustum, undecided);
        enter(child, slots[i], nv);
        setUndecided(cullStack.getCurrentCullingSet().getFrustum(), before);
    }
    countBoxes(nv, counts);
}

}  // namespace osgAnalyticBin
