// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstallRivals.h"

#include "Nodes.h"
#include "RivalCullCallback.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>

#include <osg/Geode>
#include <osg/NodeCallback>

namespace osgAnalyticBin::rivals {

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

std::size_t installRivals(osg::Node& root, const RivalOptions& options) {
    const osg::ref_ptr<TileByTile> tileByTile = new TileByTile;
    setTraversesAlways(*tileByTile);
    tileByTile->setNestedCallback(root.getCullCallback());
    root.setCullCallback(tileByTile);
    root.addUpdateCallback(new Follower(options));
    return placeAll(root, options);
}

}  // namespace osgAnalyticBin::rivals
