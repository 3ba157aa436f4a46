// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileCallback.h"

#include "../PerThread.h"
#include "../cull/TileFamily.h"
#include "../page/PagingExpiry.h"
#include "../surface/SurfaceMesh.h"
#include "ContentWatch.h"
#include "InstalledTile.h"
#include "MeshCulling.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Drawable>
#include <osg/Group>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <set>
#include <utility>
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

// Finds the nodes above the large parts of a mesh, which are its surface. What else it holds are trees and houses on
// the surface, alone or in groups of any size, of which a kept tile need not show anything.
class SurfacePaths : public osg::NodeVisitor {
public:
    explicit SurfacePaths(osg::Node& mesh) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {
        setNodeMaskOverride(~0u);
        mesh.accept(*this);
        if (_parts.size() < 2 || !areSound()) {
            _nodes.clear();
            return;
        }
        constexpr float kSmallest = 0.25f;
        const float least = kSmallest * mesh.getBound().radius();
        for (const auto& [part, path] : _parts) {
            const osg::BoundingSphere& bound = part->getBound();
            const bool isSmall = bound.valid() && bound.radius() < least;
            if (!isSmall) _nodes.insert(path.begin(), path.end());
        }
    }
    void apply(osg::Node& node) override {
        if (dynamic_cast<osgTerrain::TerrainTile*>(&node)) {
            _nodes.insert(getNodePath().begin(), getNodePath().end());
        } else {
            traverse(node);
        }
    }
    void apply(osg::Drawable& part) override { _parts.emplace_back(&part, getNodePath()); }

    // Where all parts are small, they are the surface.
    [[nodiscard]] bool has(const osg::Node& node) const { return _nodes.empty() || _nodes.count(&node) > 0; }

private:
    // OSG's bounds need vertices for all indices.
    [[nodiscard]] bool areSound() const {
        thread_local PerThread<SurfaceMesh> read;
        return std::all_of(_parts.begin(), _parts.end(),
                           [](const auto& part) { return readMesh(*part.first, osg::Matrixd(), *read); });
    }

    std::vector<std::pair<const osg::Drawable*, osg::NodePath>> _parts;
    std::set<const osg::Node*> _nodes;
};

// The nodes of a tile that have no sphere test while bins cull it, some of them more than once. Drawables keep their
// boxes, and what stands on the surface keeps OSG's own tests.
template <class Action>
void forEachSphere(const FoundTile& tile, osg::Node& culled, const Action& action) {
    action(culled);
    action(*tile.node);
    for (const auto& mesh : tile.meshes) {
        const SurfacePaths surface(*mesh);
        forEachNodeWhere(*mesh, [&](osg::Node& node) {
            if (!surface.has(node)) return false;
            if (!node.asDrawable()) action(node);
            return true;
        });
    }
}

// Of a clone, as the original's were. A scene that was saved with bins does not say where they were on before.
void resumeSpheres(const FoundTile& tile, osg::Node& culled, const InstalledTile* original) {
    std::size_t i = 0;
    forEachSphere(tile, culled, [&](osg::Node& node) {
        if (!original || original->wasActive(i++)) node.setCullingActive(true);
    });
}

void removeCallback(const FoundTile& tile, osg::Node& culled, AnalyticBinCullCallback& ours, NestedCallbacks& nested) {
    const bool isNested = culled.getCullCallback() != &ours;
    if (isNested && !nested.emplace(&culled, &ours).second) return;
    if (auto* paged = dynamic_cast<osg::PagedLOD*>(tile.node.get()))
        restoreExpiry(*paged, ours.getCullOptions().expiry);
    if (!isNested) takeOff(culled, ours);
    InstalledTile* const installed = ours.getInstalledTile();
    if (installed) installed->leaveFamily();
    ContentWatch::remove(culled);
    ContentWatch::remove(*tile.node);
    if (installed && installed->isFor(&culled)) {
        installed->resumeSpheres(culled);
    } else {
        resumeSpheres(tile, culled, installed);
    }
}

}  // namespace

InstalledTile* installedTileOf(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        if (const auto* bin = dynamic_cast<const AnalyticBinCullCallback*>(at)) return bin->getInstalledTile();
    }
    return nullptr;
}

bool hasMoved(osg::Node& tile) {
    const Carrier* const carrier = carrierOf(tile);
    const InstalledTile* const own = installedTileOf(tile);
    const InstalledTile* const installed = own || !carrier ? own : installedTileOf(*carrier);
    return installed && installed->isMoved();
}

const AnalyticBinCullCallback* installedBinOf(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        const auto* const bin = dynamic_cast<const AnalyticBinCullCallback*>(at);
        if (bin && bin->getInstalledTile() && bin->getInstalledTile()->isFor(&node)) return bin;
    }
    return nullptr;
}

void takeOff(osg::Node& node, osg::Callback& callback) {
    if (node.getCullCallback() != &callback) return node.removeCullCallback(&callback);
    const osg::ref_ptr<osg::Callback> nested = callback.getNestedCallback();
    node.setCullCallback(nested.get());
    if (callback.referenceCount() == 1) callback.setNestedCallback(nullptr);
}

Carrier* carrierOf(osg::Node& node) {
    return node.getNumParents() == 1 ? dynamic_cast<Carrier*>(node.getParent(0)) : nullptr;
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

void placeCallback(const FoundTile& tile, osg::Node& culled, AnalyticBinCullCallback& callback, Database& database) {
    const osg::ref_ptr<InstalledTile> installed = new InstalledTile(culled, database);
    callback.setInstalledTile(installed);
    // In front: what is nested runs when the tile is kept.
    callback.setNestedCallback(culled.getCullCallback());
    culled.setCullCallback(&callback);
    forEachSphere(tile, culled, [&](osg::Node& node) { installed->suspendSphere(node); });
    for (const auto& mesh : tile.meshes) {
        if (isSeeThroughMesh(*mesh)) installed->setSeeThrough();
    }
    if (&culled != tile.node) ContentWatch::place(culled, {});
    ContentWatch::place(*tile.node, tile.meshes);
}

void removeCallbacksBelow(osg::Node& subgraph, NestedCallbacks& nested) {
    forEachNode(subgraph, [&nested](osg::Node& node) {
        if (installedTileOf(node)) removeCallbacks({&node, {}, {}, 0, {}}, nested);
        TileFamily::remove(node);
        ContentWatch::remove(node);
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
