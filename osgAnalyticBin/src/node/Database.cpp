// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Database.h"

#include <osg/Notify>
#include <osgTerrain/GeometryTechnique>

#include <typeinfo>

namespace osgAnalyticBin {

TerrainShape Database::shape() const {
    osg::ref_ptr<osgTerrain::Terrain> terrain;
    if (!_terrain.lock(terrain)) return {};
    // tiles get copies of it
    const osgTerrain::TerrainTechnique* technique = terrain->getTerrainTechniquePrototype();
    const bool isKnown = !technique || typeid(*technique) == typeid(osgTerrain::GeometryTechnique);
    return {terrain->getVerticalScale(), terrain->getSampleRatio(), terrain->getEqualizeBoundaries(), isKnown};
}

bool Database::takeShapeChange() {
    const TerrainShape present = shape();
    const bool hasChanged = !(present == _fittedShape);
    _fittedShape = present;
    return _isRefitWanted.exchange(false, std::memory_order_relaxed) || hasChanged;
}

void Database::noteGap(const std::string& where) {
    if (_hasGap.exchange(true, std::memory_order_relaxed)) return;
    OSG_INFO << "osgAnalyticBin: the tiles of \"" << where
             << "\" do not cover the tile that they are paged below, or the globe; the horizon is not used."
             << std::endl;
}

void Database::noteUnknownTechnique() {
    if (_hasUnknownTechnique.exchange(true, std::memory_order_relaxed)) return;
    OSG_INFO << "osgAnalyticBin: the Terrain has a technique that is not osgTerrain::GeometryTechnique; its tiles are "
                "not culled."
             << std::endl;
}

void Database::reportMisfit(const ParentTile& tile, const AnalyticBin& bin) {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_hasWarned) {
        _hasWarned = true;
        OSG_WARN << "osgAnalyticBin: \"" << tile.file
                 << "\" is not as the index knows it; tiles are kept visible there. Run osgbinconv --index again."
                 << std::endl;
    }
    for (const ParentTile* at = &tile; at; at = at->parent.get()) {
        _corrections[{at->file, at->ordinal}].expandBy(bin);
        _toWiden.emplace_back(at->callback, bin);
    }
}

AnalyticBin Database::correction(const std::string& file, std::size_t ordinal) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto known = _corrections.find({file, ordinal});
    return known == _corrections.end() ? AnalyticBin() : known->second;
}

void Database::update() {
    std::vector<std::pair<osg::observer_ptr<AnalyticBinCullCallback>, AnalyticBin>> toWiden;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        toWiden.swap(_toWiden);
    }
    for (const auto& [observed, bin] : toWiden) {
        osg::ref_ptr<AnalyticBinCullCallback> callback;
        if (!observed.lock(callback)) {
            // paged out, or fitted anew while the tile was on its way
            requestRefit();
            continue;
        }
        AnalyticBin wider = callback->bin();
        wider.expandBy(bin);
        callback->setBin(wider);
    }
}

}  // namespace osgAnalyticBin
