// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileCallback.h"

#include "../CallbackChain.h"
#include "../Inverse.h"
#include "../PagedChildren.h"
#include "../cull/InstalledBin.h"
#include "../cull/TileFamily.h"
#include "../database/Database.h"
#include "../tile/Carrier.h"
#include "../tile/EachNode.h"
#include "../tile/InstalledTile.h"
#include "ContentWatch.h"
#include "NoCulling.h"
#include "SetInstaller.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/CoordinateSystemNode>
#include <osg/Group>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

#include <cmath>
#include <vector>

namespace osgAnalyticBin {

namespace {

std::vector<osg::ref_ptr<AnalyticBinCullCallback>> installedCallbacks(const osg::Node& node) {
    std::vector<osg::ref_ptr<AnalyticBinCullCallback>> callbacks;
    for (osg::Callback* at = const_cast<osg::Node&>(node).getCullCallback(); at; at = at->getNestedCallback()) {
        if (auto* const bin = dynamic_cast<AnalyticBinCullCallback*>(at)) callbacks.emplace_back(bin);
    }
    return callbacks;
}

// How long a tile's paged children stay after they were last in view, where nobody has set a time: OSG's own is 0. A
// number that nobody else sets.
double expiryOf(const AnalyticBinCullCallback& callback) {
    return std::nextafter(callback.getCullOptions().expiry, HUGE_VAL);
}

void replaceExpiry(osg::Node& node, double replaced, double seconds) {
    auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
    for (unsigned int i = 0; paged && i < paged->getNumMinimumExpiryTimes(); ++i) {
        if (isPaged(*paged, i) && paged->getMinimumExpiryTime(i) == replaced) paged->setMinimumExpiryTime(i, seconds);
    }
}

void removeCallback(const FoundTile& tile, osg::Node& culled, AnalyticBinCullCallback& ours, NestedCallbacks& nested) {
    const bool isNested = culled.getCullCallback() != &ours;
    if (isNested && !nested.emplace(&culled, &ours).second) return;
    replaceExpiry(*tile.node, expiryOf(ours), 0.0);
    if (!isNested) takeOff(culled, ours);
    InstalledTile* const installed = ours.getInstalledTile();
    if (installed) installed->leaveFamily();
    ContentWatch::remove(culled);
    ContentWatch::remove(*tile.node);
    if (!installed || !installed->isFor(&culled)) return;
    installed->setNode(nullptr);
}

// The most ways from a node up to its globe that are looked at.
constexpr int kMostPaths = 64;

// Whether a way from the node up to a globe leads through other transforms than those of `localToEcef`. Ways that end
// without a globe have no horizon, and do not matter. `nodeToHere`: from the node's frame to that of this ancestor.
bool hasOtherFrame(const osg::Node& ancestor, const osg::Matrixd& nodeToHere, const osg::Matrixd& localToEcef,
                   const osg::Node* root, int& paths) {
    if (&ancestor == root || dynamic_cast<const osg::CoordinateSystemNode*>(&ancestor)) {
        const double reach = nodeToHere.getTrans().length() + localToEcef.getTrans().length();
        return !areNearlyEqual(nodeToHere, localToEcef, reach) || --paths < 0;
    }
    for (const osg::Group* const parent : ancestor.getParents()) {
        osg::Matrixd matrix;
        const osg::Transform* const transform = parent->asTransform();
        const bool isGlobe = dynamic_cast<const osg::CoordinateSystemNode*>(parent) != nullptr;
        if (transform && !isGlobe) transform->computeLocalToWorldMatrix(matrix, nullptr);
        if (hasOtherFrame(*parent, nodeToHere * matrix, localToEcef, root, paths)) return true;
    }
    return false;
}

}  // namespace

bool isInstanced(const osg::Node& node, const TileFrame& frame, const osg::Node* root) {
    if (!frame.isKnown()) return false;
    const osg::Node* shared = &node;
    while (shared->getNumParents() == 1) shared = shared->getParent(0);
    if (shared->getNumParents() == 0) return false;
    int paths = kMostPaths;
    return hasOtherFrame(node, osg::Matrixd(), frame.localToEcef, root, paths);
}

bool isOfOtherTerrain(const FoundTile& tile, const Database& database) {
    bool is = false;
    const auto look = [&](osg::Node& node) {
        const auto* const part = node.asGroup() ? dynamic_cast<osgTerrain::TerrainTile*>(&node) : nullptr;
        is = is || (part && part->getTerrain() && !database.follows(part->getTerrain()));
    };
    for (const osg::ref_ptr<osg::Node>& mesh : tile.meshes) forEachNode(*mesh, look);
    return is;
}

InstalledTile* recordOf(osg::Node& tile) {
    for (const osg::Node* const at : {&tile, static_cast<osg::Node*>(carrierOf(tile))}) {
        InstalledTile* const record = at ? installedTileOf(*at) : nullptr;
        if (record && record->isFor(at)) return record;
    }
    return nullptr;
}

// OSG enters the frame of a transform before it asks the transform's callbacks, which costs more than the bin's test:
// in files of tiles a transform gets a group above it, while no application has seen it.
osg::Node& culledNode(const FoundTile& tile, bool isNew) {
    osg::Node& node = *tile.node;
    if (!node.asTransform() || !tile.frame.isBelowTile || node.getNumParents() != 1) return node;
    if (Carrier* const carrier = carrierOf(node)) return *carrier;
    if (!isNew) return node;
    osg::Group& parent = *node.getParent(0);
    const osg::ref_ptr<Carrier> carrier = new Carrier;
    carrier->addChild(&node);
    parent.replaceChild(&node, carrier);
    return *carrier;
}

osg::Matrixd culledFrame(const FoundTile& tile, osg::Node& culled) {
    const osg::Transform* transform = culled.asTransform();
    return transform ? frameInside(*transform, tile.frame) : tile.frame.localToEcef;
}

void placeCallback(const FoundTile& tile, osg::Node& culled, AnalyticBinCullCallback& callback, InstalledTile& record) {
    record.setNode(&culled);
    callback.setInstalledTile(&record);
    // In front: what is nested runs when the tile is kept.
    putInFront(culled, callback);
    if (callback.getCullOptions().expiry > 0.0) replaceExpiry(*tile.node, 0.0, expiryOf(callback));
    const bool isCarried = &culled != tile.node;
    if (isCarried) ContentWatch::place(culled, {}, record.parent, &record);
    ContentWatch::place(*tile.node, tile.meshes, isCarried ? &record : record.parent.get(), &record);
}

void removeCallbacksBelow(osg::Node& subgraph, NestedCallbacks& nested) {
    forEachNode(subgraph, [&nested](osg::Node& node) {
        const auto* const bin = findCallback<const AnalyticBinCullCallback>(node.getCullCallback());
        // an installer made it, in this scene or before the scene was saved
        if (bin && bin->isInstalled()) removeCallbacks({&node, {}, {}, 0, {}}, nested);
        TileFamily::remove(node);
        takeOffFirst<NoCulling>(node);
        removeFromLod(node);
    });
}

void removeCallbacks(const FoundTile& tile, NestedCallbacks& nested) {
    for (osg::Node* const culled : {tile.node.get(), static_cast<osg::Node*>(carrierOf(*tile.node))}) {
        if (!culled) continue;
        for (const auto& ours : installedCallbacks(*culled)) removeCallback(tile, *culled, *ours, nested);
    }
}

void takeOff(NestedCallbacks& nested) {
    for (const auto& [node, callback] : nested) takeOff(*node, *callback);
    nested.clear();
}

}  // namespace osgAnalyticBin
