// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileCensus.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

#include <typeinfo>

namespace osgAnalyticBin::bench {

namespace {

bool isPaged(const osg::PagedLOD& parent, const osg::Node& child) {
    const unsigned int index = parent.getChildIndex(&child);
    return index < parent.getNumFileNames() && !parent.getFileName(index).empty();
}

// What a page may consist of besides tiles.
bool isPlainGroup(const osg::Node& node) {
    return typeid(node) == typeid(osg::Group);
}

}  // namespace

std::set<std::string> Census::keys() const {
    std::set<std::string> keys;
    for (const DrawnTile& tile : tiles) keys.insert(tile.key);
    return keys;
}

Census TileCensus::take(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    const osg::ref_ptr<TileCensus> census = new TileCensus;
    census->watch(camera, frameStamp);
    census->_census.wanted = census->wanted();
    return std::move(census->_census);
}

void TileCensus::enter(osg::Node& node) {
    ++_census.nodes;
    if (!_openTiles.empty()) _openTiles.back().kept = true;
    if (!isTile(node)) return;
    _openTiles.emplace_back();
    _openTiles.back().node = &node;
    _openTiles.back().drawn.key = keyOfPath();
}

void TileCensus::leave(osg::Node& node) {
    if (_openTiles.empty() || _openTiles.back().node != &node) return;
    OpenTile& tile = _openTiles.back();
    ++_census.tested;
    if (tile.kept) ++_census.kept;
    if (tile.kept && dynamic_cast<const osg::PagedLOD*>(&node)) ++_census.pagedLods;
    if (!tile.drawn.meshes.empty()) _census.tiles.push_back(std::move(tile.drawn));
    _openTiles.pop_back();
}

void TileCensus::draw(osg::Drawable& drawable) {
    ++_census.drawables;
    _census.triangles += flight::trianglesOf(drawable);
    if (_openTiles.empty()) return;
    const osg::Matrixd localToWorld =
        *getModelViewMatrix() * osg::Matrixd::inverse(getRenderStage()->getCamera()->getViewMatrix());
    _openTiles.back().drawn.meshes.push_back({&drawable, localToWorld});
}

bool TileCensus::isTile(const osg::Node& node) const {
    if (const_cast<osg::Node&>(node).asDrawable()) return false;
    if (hasStoredBin(node) || dynamic_cast<const osg::PagedLOD*>(&node)) return true;
    return !isPlainGroup(node) && isOnPage();
}

// Whether nothing but plain groups stands between the node and the PagedLOD that had it loaded.
bool TileCensus::isOnPage() const {
    const osg::NodePath& path = const_cast<TileCensus*>(this)->getNodePath();
    for (std::size_t i = path.size(); i-- > 1;) {
        const osg::Node& parent = *path[i - 1];
        if (const auto* const lod = dynamic_cast<const osg::PagedLOD*>(&parent)) return isPaged(*lod, *path[i]);
        if (!isPlainGroup(parent)) return false;
    }
    return false;
}

std::string TileCensus::keyOfPath() const {
    const osg::NodePath& path = const_cast<TileCensus*>(this)->getNodePath();
    std::string key;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const osg::Group* const parent = path[i - 1]->asGroup();
        // a group that stands for its only child is there with bins, and is not without
        if (parent && isPlainGroup(*parent) && parent->getNumChildren() == 1) continue;
        if (!key.empty()) key += '/';
        key += std::to_string(parent ? parent->getChildIndex(path[i]) : 0U);
    }
    return key;
}

}  // namespace osgAnalyticBin::bench
