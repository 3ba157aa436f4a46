// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PlanarFit.h"

#include "../surface/PlanarSurface.h"
#include "../surface/TerrainTileSurface.h"

#include <osgTerrain/TerrainTile>

#include <algorithm>

namespace osgAnalyticBin {

namespace {

// Map units: feet hold metres too.
constexpr core::Interval kTerrainInFeet{-38000.0, 30000.0};

core::Interval heightsOf(const CullOptions& options) {
    return options.heights == CullOptions::kTerrainOnEarth ? kTerrainInFeet : options.heights;
}

// Whether the tile's own word is that it stands in a map.
bool saysPlanar(const FoundTile& tile, bool withAnyTechnique) {
    return std::all_of(tile.meshes.begin(), tile.meshes.end(), [&](const osg::ref_ptr<osg::Node>& mesh) {
        auto* terrainTile = dynamic_cast<osgTerrain::TerrainTile*>(mesh.get());
        if (!terrainTile) return tile.frame.isProjected;
        return isPlanar(*terrainTile) && (withAnyTechnique || isDrawnByOsg(*terrainTile));
    });
}

// Meshes of one tile are its levels of detail: any of them may be shown.
PlanarSurface planarSurfaceOf(const FoundTile& tile, double sampleRatio) {
    PlanarSurface all;
    for (const osg::ref_ptr<osg::Node>& mesh : tile.meshes) {
        const PlanarSurface own = planarSurface(*mesh, tile.frame.localToEcef, sampleRatio);
        if (!own.box.valid() || (all.box.valid() && own.isScalable != all.isScalable)) return {};
        all.expandBy(own);
    }
    return all;
}

core::Interval scaled(core::Interval heights, double scale) {
    return {std::min(heights.lower * scale, heights.upper * scale),
            std::max(heights.lower * scale, heights.upper * scale)};
}

// Skirts of an osgTerrain tile do not follow the vertical scale; those of a mesh are in its box.
osg::BoundingBoxd boxOf(const PlanarSurface& surface, const TerrainShape& shape, const core::Interval* descendants) {
    const double scale = surface.isScalable ? shape.verticalScale : 1.0;
    const double ownSkirt = surface.isScalable ? surface.skirt : 0.0;
    const core::Interval own = scaled({surface.box.zMin(), surface.box.zMax()}, scale);
    osg::BoundingBoxd box = surface.box;
    box.zMin() = own.lower - ownSkirt;
    box.zMax() = own.upper + surface.raised;
    if (descendants) {
        const core::Interval theirs = scaled(*descendants, scale);
        box.zMin() = std::min(box.zMin(), theirs.lower - surface.skirt);
        box.zMax() = std::max(box.zMax(), theirs.upper + surface.raised);
    }
    const double most = surface.margin + (surface.isScalable ? shape.techniqueMargin : 0.0);
    const osg::Vec3d margin(most, most, most);
    box._min -= margin;
    box._max += margin;
    return box;
}

}  // namespace

PlanarFit fitPlanarTile(const FoundTile& tile, const CullOptions& options, const TerrainShape& shape) {
    PlanarFit fit;
    if (!saysPlanar(tile, shape.techniqueMargin > 0.0)) return fit;
    const PlanarSurface surface = planarSurfaceOf(tile, shape.sampleRatio);
    if (!surface.box.valid()) return fit;
    fit.kind = tile.frame.ellipsoid && !surface.isScalable ? PlanarFit::Contradictory : PlanarFit::Planar;
    fit.isScalable = surface.isScalable;
    const core::Interval heights = heightsOf(options);
    fit.box = boxOf(surface, shape, tile.pagedFiles.empty() ? nullptr : &heights);
    return fit;
}

}  // namespace osgAnalyticBin
