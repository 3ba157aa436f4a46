// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileCounter.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinStatistics.h>

#include <osg/PagedLOD>

namespace osgAnalyticBin::flight {

namespace {

class StoredBinFinder : public osg::NodeVisitor {
public:
    StoredBinFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        _found = _found || hasStoredBin(node);
        if (!_found) traverse(node);
    }
    [[nodiscard]] bool found() const { return _found; }

private:
    bool _found = false;
};

}  // namespace

TileCounts TileCounter::count(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    StoredBinFinder finder;
    camera.accept(finder);
    osg::ref_ptr<TileCounter> counter = new TileCounter(finder.found());
    counter->watch(camera, frameStamp);
    return counter->result();
}

TileCounts TileCounter::result() const {
    TileCounts counts = _counts;
    counts.wanted = wanted();
    if (const BinStatistics* const statistics = BinStatistics::find(*this)) {
        const BinCounts bins = statistics->getCounts();
        counts.binsTested = bins.tested;
        counts.binsOutside = bins.outside;
        counts.binsInside = bins.inside;
        counts.binsStraddling = bins.straddling;
    }
    return counts;
}

void TileCounter::enter(osg::Node& node) {
    if (!_openTiles.empty()) _openTiles.back().kept = true;
    if (isTile(node)) _openTiles.emplace_back();
}

void TileCounter::leave(osg::Node& node) {
    if (!isTile(node)) return;
    const Tile tile = _openTiles.back();
    _openTiles.pop_back();
    ++_counts.tested;
    if (tile.kept) ++_counts.kept;
    if (tile.drawn) ++_counts.drawn;
}

void TileCounter::draw(osg::Drawable& drawable) {
    if (!_openTiles.empty()) _openTiles.back().drawn = true;
    ++_counts.drawables;
    _counts.triangles += trianglesOf(drawable);
}

bool TileCounter::isTile(const osg::Node& node) const {
    if (node.asDrawable()) return false;
    return _binsAreStored ? hasStoredBin(node) : dynamic_cast<const osg::PagedLOD*>(&node) != nullptr;
}

}  // namespace osgAnalyticBin::flight
