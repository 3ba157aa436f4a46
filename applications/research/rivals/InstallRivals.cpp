// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstallRivals.h"

#include "RivalCullCallback.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>

#include <osg/Geode>
#include <osg/NodeCallback>
#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin::rivals {

namespace {

RivalCullCallback* rivalOf(osg::Node& node) {
    for (osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback())
        if (auto* const rival = dynamic_cast<RivalCullCallback*>(at)) return rival;
    return nullptr;
}

void removeRival(osg::Node& node, RivalCullCallback& rival) {
    const osg::ref_ptr<RivalCullCallback> kept(&rival);
    const osg::ref_ptr<osg::Callback> nested = rival.getNestedCallback();
    if (node.getCullCallback() != &rival) return node.removeCullCallback(&rival);
    node.setCullCallback(nested);
    rival.setNestedCallback(nullptr);
}

/// Puts the rule in front of the kit's callbacks that have none, or an older bin's.
class RivalPlacer final : public osg::NodeVisitor {
public:
    explicit RivalPlacer(const RivalOptions& options) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _options(options) {
        setNodeMaskOverride(~0U);
    }

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        place(node);
        // one that is traversed before its first update never finds its Terrain
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

    void apply(osg::Geode& node) override { place(node); }

    std::size_t placed = 0;

private:
    void place(osg::Node& node) {
        RivalCullCallback* const old = rivalOf(node);
        osg::Callback* const first = node.getCullCallback();
        auto* const tile =
            dynamic_cast<AnalyticBinCullCallback*>(old && old == first ? first->getNestedCallback() : first);
        if (tile && old && old == first && old->isFor(*tile)) return;
        if (old) removeRival(node, *old);
        if (!tile || !tile->shownBin().valid()) return;
        node.setCullCallback(new RivalCullCallback(*tile, _options));
        node.setCullingActive(false);
        ++placed;
    }

    const RivalOptions& _options;
};

/// Follows what is paged in.
class Follower final : public osg::NodeCallback {
public:
    explicit Follower(const RivalOptions& options) : _options(options) {}

    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        // the kit may renew its callbacks meanwhile
        traverse(node, visitor);
        RivalPlacer placer(_options);
        node->accept(placer);
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
    RivalPlacer placer(options);
    root.accept(placer);
    return placer.placed;
}

}  // namespace osgAnalyticBin::rivals
