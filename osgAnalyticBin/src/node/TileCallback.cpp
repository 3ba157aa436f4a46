// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileCallback.h"

#include "MeshCulling.h"
#include "PagingExpiry.h"
#include "PlanarBinCullCallback.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Group>
#include <osg/PagedLOD>
#include <osg/Transform>

#include <typeinfo>

namespace osgAnalyticBin {

namespace {

// The options that a callback of ours was made with. Returns: nullptr for any other callback.
const CullOptions* optionsOf(const osg::Callback& callback) {
    if (const auto* geocentric = dynamic_cast<const AnalyticBinCullCallback*>(&callback)) {
        return &geocentric->cullOptions();
    }
    const auto* planar = dynamic_cast<const PlanarBinCullCallback*>(&callback);
    return planar ? &planar->cullOptions() : nullptr;
}

osg::Callback* installedCallback(osg::Node& node) {
    osg::Callback* callback = node.getCullCallback();
    while (callback && !optionsOf(*callback)) callback = callback->getNestedCallback();
    return callback;
}

// Whether a group stands for its only child.
bool isCarrier(const osg::Group& group) {
    return typeid(group) == typeid(osg::Group) && group.getNumChildren() == 1 && !hasStoredBin(group);
}

// The node that carries a tile's callback: it, or the group that was put above it.
osg::Node* installedNode(osg::Node& node) {
    if (installedCallback(node)) return &node;
    if (!node.asTransform() || node.getNumParents() != 1) return nullptr;
    osg::Group& parent = *node.getParent(0);
    return isCarrier(parent) && installedCallback(parent) ? &parent : nullptr;
}

void setSphereCullingOf(const FoundTile& tile, bool active) {
    tile.node->setCullingActive(active);
    for (const auto& mesh : tile.meshes) setSphereCulling(*mesh, active);
}

}  // namespace

// OSG enters the frame of a transform before it asks the transform's callbacks, which costs more than the bin's test:
// in files of tiles a transform gets a group above it.
osg::Node& culledNode(const FoundTile& tile) {
    osg::Node& node = *tile.node;
    if (!node.asTransform() || !tile.frame.isBelowTile || node.getNumParents() != 1) return node;
    osg::Group& parent = *node.getParent(0);
    if (isCarrier(parent)) return parent;
    const osg::ref_ptr<osg::Group> carrier = new osg::Group;
    carrier->addChild(&node);
    parent.replaceChild(&node, carrier);
    return *carrier;
}

osg::Matrixd culledFrame(const FoundTile& tile, osg::Node& culled) {
    const osg::Transform* transform = culled.asTransform();
    return transform ? frameInside(*transform, tile.frame) : tile.frame.localToEcef;
}

void placeCallback(const FoundTile& tile, osg::Node& culled, osg::NodeCallback& callback) {
    // In front: what is nested runs when the tile is kept.
    callback.setNestedCallback(culled.getCullCallback());
    culled.setCullCallback(&callback);
    culled.setCullingActive(false);
    setSphereCullingOf(tile, false);
}

void removeCallbacks(const FoundTile& tile) {
    osg::Node& node = *tile.node;
    bool wasInstalled = false;
    while (osg::Node* culled = installedNode(node)) {
        const osg::ref_ptr<osg::Callback> ours = installedCallback(*culled);
        if (auto* paged = dynamic_cast<osg::PagedLOD*>(&node)) restoreExpiry(*paged, optionsOf(*ours)->expiry);
        culled->removeCullCallback(ours.get());
        culled->setCullingActive(true);
        wasInstalled = true;
    }
    if (wasInstalled) setSphereCullingOf(tile, true);
}

}  // namespace osgAnalyticBin
