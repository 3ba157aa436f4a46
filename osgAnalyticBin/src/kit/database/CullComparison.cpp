// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullComparison.h"

#include "../cull/InstalledBin.h"

#include <osg/ApplicationUsage>
#include <osg/Camera>
#include <osg/FrameStamp>
#include <osg/Notify>
#include <osg/Stats>
#include <osgUtil/CullVisitor>

#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

namespace osgAnalyticBin {

namespace {

constexpr const char* kVariable = "OSGANALYTICBIN_COMPARE";

const osg::ApplicationUsageProxy usage(
    osg::ApplicationUsage::ENVIRONMENTAL_VARIABLE, std::string(kVariable) + " <seconds>",
    "analytic bins and stock OSG take turns of that many seconds in culling; the "
    "tiles drawn and the cull time of both are printed, and set in the camera's stats");

/// The tiles of a database that have something in the render graph.
class DrawnTiles {
public:
    explicit DrawnTiles(const osg::Node& root) : _root(root) {}

    void add(const osgUtil::StateGraph& graph) {
        for (const auto& leaf : graph._leaves) {
            if (const osg::Node* const tile = leaf->getDrawable() ? tileOf(*leaf->getDrawable()) : nullptr)
                _tiles.insert(tile);
        }
        for (const auto& child : graph._children) add(*child.second);
    }
    [[nodiscard]] std::size_t count() const { return _tiles.size(); }

private:
    // Null: the drawable is not in a tile of this database.
    [[nodiscard]] const osg::Node* tileOf(const osg::Node& drawable) const {
        const osg::Node* tile = nullptr;
        for (const osg::Node* node = &drawable; node != &_root; node = node->getParent(0)) {
            if (!tile && installedBinOf(*node)) tile = node;
            if (node->getNumParents() == 0) return nullptr;
        }
        return tile;
    }

    const osg::Node& _root;
    std::set<const osg::Node*> _tiles;
};

}  // namespace

std::unique_ptr<CullComparison> CullComparison::fromEnvironment() {
    const char* const text = std::getenv(kVariable);
    const double seconds = text ? std::atof(text) : 0.0;
    return seconds > 0.0 ? std::make_unique<CullComparison>(seconds) : nullptr;
}

// All cameras of a frame have the same time, and so the same turn.
CullComparison::View::View(CullComparison* comparison, const osg::Node& root, osg::NodeVisitor& visitor)
    : _comparison(visitor.asCullVisitor() && visitor.getFrameStamp() ? comparison : nullptr),
      _root(root),
      _visitor(visitor.asCullVisitor()) {
    if (!_comparison) return;
    _turn = static_cast<std::uint64_t>(visitor.getFrameStamp()->getReferenceTime() / _comparison->_seconds);
    _begin = std::chrono::steady_clock::now();
}

CullComparison::View::~View() {
    if (!_comparison) return;
    const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - _begin;
    DrawnTiles tiles(_root);
    tiles.add(*_visitor->getRootStateGraph());
    osg::Camera* const camera = _visitor->getCurrentCamera();
    if (osg::Stats* const stats = camera ? camera->getStats() : nullptr) {
        const std::string whose = isStock() ? "Stock OSG " : "Bins ";
        const unsigned int frame = _visitor->getFrameStamp()->getFrameNumber();
        stats->setAttribute(frame, whose + "database cull ms", passed.count());
        stats->setAttribute(frame, whose + "tiles drawn", static_cast<double>(tiles.count()));
    }
    _comparison->add(_turn, tiles.count(), passed.count());
}

void CullComparison::add(std::uint64_t turn, std::size_t tiles, double ms) {
    const std::lock_guard<std::mutex> lock(_mutex);
    Sums& sums = _sums[turn % 2];
    if (turn != _turn) {
        print();
        _turn = turn;
        sums = {};
    }
    ++sums.views;
    sums.tiles += tiles;
    sums.ms += ms;
}

void CullComparison::print() const {
    const Sums &bins = _sums[0], &stock = _sums[1];
    // one line after each turn, from the first turn of the second on
    if (bins.views == 0 || stock.views == 0) return;
    const auto mean = [](double sum, const Sums& of) { return sum / static_cast<double>(of.views); };
    char text[160];
    std::snprintf(text, sizeof text, "with bins %.0f tiles, cull %.3f ms; with stock OSG %.0f tiles, cull %.3f ms",
                  mean(static_cast<double>(bins.tiles), bins), mean(bins.ms, bins),
                  mean(static_cast<double>(stock.tiles), stock), mean(stock.ms, stock));
    OSG_NOTICE << "osgAnalyticBin: a view " << text << std::endl;
}

}  // namespace osgAnalyticBin
