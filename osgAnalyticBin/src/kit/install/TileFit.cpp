// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileFit.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "../surface/TilePlates.h"

#include <osgAnalyticBin/TileSurface.h>
#include <osgAnalyticBin/core/mesh/FinerMeshes.h>

#include <osg/Drawable>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

bool hasTerrainTile(osg::Node& mesh) {
    if (dynamic_cast<osgTerrain::TerrainTile*>(&mesh)) return true;
    osg::Group* const group = dynamic_cast<osg::PagedLOD*>(&mesh) ? nullptr : mesh.asGroup();
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        if (hasTerrainTile(*group->getChild(i))) return true;
    }
    return false;
}

bool hasTerrainTile(const FoundTile& tile) {
    return std::any_of(tile.meshes.begin(), tile.meshes.end(),
                       [](const osg::ref_ptr<osg::Node>& mesh) { return hasTerrainTile(*mesh); });
}

AnalyticBin withAltitude(const AnalyticBin& bin, core::Interval altitude, double sag) {
    AnalyticBin result = bin;
    result.setBin(bin.bin().withAltitude(altitude));
    result.setSag(std::max(sag, bin.sag()));
    return result;
}

// What a tile draws by itself, as far as its lowest altitude and its bin tell.
AnalyticBin surfaceAbove(double low, const AnalyticBin& bin) {
    return withAltitude(bin, {low, std::max(low, bin.bin().altitude().upper)}, 0.0);
}

// On a globe that is larger than the earth, or in smaller units, the default heights are scaled accordingly.
core::Interval heightsOn(const core::Ellipsoid& ellipsoid, const core::Interval& heights) {
    if (!(heights == CullOptions::kTerrainOnEarth)) return heights;
    const double scale = std::max(1.0, core::earthScale(ellipsoid));
    return {heights.lower * scale, heights.upper * scale};
}

// Metres by which rounded vertices of finer tiles may leave the extents of the mesh above them.
double roundingOf(const core::Ellipsoid& ellipsoid) {
    return core::earthScale(ellipsoid);
}

// Tolerance when comparing a tile's mesh with its stored bin: bounds of surfaces are rough where meshes are coarse.
struct Tolerance {
    double below, above, aside;
};

Tolerance toleranceFor(const AnalyticBin& bin, double sag, const core::Ellipsoid& ellipsoid) {
    const double metre = core::earthScale(ellipsoid);
    const double mostMargin = 100.0 * metre;  // a stored one may be anything
    constexpr double kShareOfWidth = 1.0 / 32.0;
    const double width =
        ellipsoid.polarRadius() * std::max(bin.bin().latitude().width(), bin.bin().longitude().width());
    const double least = metre + std::min(bin.margin(), mostMargin);
    return {least + sag, least, least + kShareOfWidth * width};
}

// Radians that the bound of a mesh may run beyond an end of the latitudes, poleward of it: in proportion to its sag
// over the distance of the vertices from the axis. Those of a mesh within a right bin are no nearer than the bin's end.
double runBeyond(double polewardLatitude, double sag, const core::Ellipsoid& ellipsoid) {
    constexpr double kNearerChords = 1.25;
    if (polewardLatitude <= 0.0) return 0.0;
    const double nearest = ellipsoid.equatorialRadius() * std::max(std::cos(polewardLatitude), 1e-9);
    return std::min(kNearerChords * sag / nearest, 0.5);
}

// Whether the outer bin holds the inner one but for the tolerance. `sag`: of what is known to be drawn.
bool nearlyHolds(const AnalyticBin& outer, const AnalyticBin& inner, double sag, const core::Ellipsoid& ellipsoid) {
    const Tolerance tolerance = toleranceFor(inner, sag, ellipsoid);
    const double angle = tolerance.aside / ellipsoid.polarRadius();
    // the longitudes of a cap about the pole say little
    const double narrowest = std::max(std::cos(std::abs(inner.bin().center().latitude)), 1e-3);
    const auto grown = [](const core::Interval& range, double below, double above) -> core::Interval {
        return {range.lower - below, range.upper + above};
    };
    const core::GeodeticBin& bin = outer.bin();
    const core::Interval altitude = grown(bin.altitude(), outer.margin(), outer.margin());
    const core::Interval& latitude = bin.latitude();
    return core::GeodeticBin(grown(latitude, std::max(angle, runBeyond(-latitude.lower, sag, ellipsoid)),
                                   std::max(angle, runBeyond(latitude.upper, sag, ellipsoid))),
                             grown(bin.longitude(), angle / narrowest, angle / narrowest),
                             grown(altitude, tolerance.below, tolerance.above))
        .contains(inner.bin());
}

class Fitting {
public:
    Fitting(const FoundTile& tile, const FitSources& from, const TerrainShape& shape)
        : _tile(tile),
          _from(from),
          _shape(shape),
          _ellipsoid(toCore(from.ellipsoid)),
          _heights(heightsOn(_ellipsoid, from.options.heights)),
          _isLeaf(tile.pagedFiles.empty()),
          _above(from.parent ? from.parent->stored : AnalyticBin()) {
        _fit.stored = _above;
    }

    [[nodiscard]] TileFit result() && {
        if (!_shape.isKnown() && hasTerrainTile(_tile)) {
            fitUnknown();
            return std::move(_fit);
        }
        hasStoredBin(*_tile.node) ? fitStored() : fitUnstored();
        if (_drawn.valid() && (_from.hasNewContent || leavesHeights() || hangsLower())) report(Finding::Larger, _drawn);
        if (leavesExtents())
            report(Finding::Larger, _fit.extents.isMeasured ? _drawn : _fit.bin.withSkirts(_fit.skirt));
        noteDepth();
        if (_shape.areBoundariesEqual && _fit.isScalable) {
            _fit.bin = withHeights(_fit.bin);
            _fit.surface = withHeights(_fit.surface);
        }
        if (_fit.isScalable && _shape.techniqueMargin > 0.0) {
            _fit.isInPlace = false;
            for (AnalyticBin* const bin : {&_fit.bin, &_fit.surface})
                bin->setMargin(bin->margin() + _shape.techniqueMargin);
        }
        return std::move(_fit);
    }

private:
    void report(Finding finding, const AnalyticBin& drawn = {}) { _fit.findings.emplace_back(finding, drawn); }
    [[nodiscard]] bool isHeld(const AnalyticBin& outer, const AnalyticBin& inner, double sag) const {
        return !outer.valid() || !inner.valid() || nearlyHolds(outer, inner, sag, _ellipsoid);
    }

    // Meshes of one tile are its levels of detail: any of them may be shown.
    [[nodiscard]] TileSurface meshSurface() const {
        TileSurface surface;
        surface.isEmpty = true;
        for (const osg::ref_ptr<osg::Node>& mesh : _tile.meshes) {
            const TileSurface own = tileSurface(*mesh, _from.ellipsoid, _tile.frame.localToEcef, _shape.sampleRatio,
                                                _from.options.techniqueMargin.has_value());
            if (own.isEmpty) continue;
            if (!own.bin.valid()) return {};
            surface.isEmpty = false;
            surface.bin.expandBy(own.bin);
            surface.skirt = std::max(surface.skirt, own.skirt);
            surface.isScalable = surface.isScalable || own.isScalable;
        }
        return surface;
    }

    // The bin of a tile with finer ones of which no more is known than its surface and the declared heights.
    [[nodiscard]] AnalyticBin rangedBin(const TileSurface& surface) const {
        const core::GeodeticBin& extents = surface.bin.bin();
        const double sag = core::sagOfFinerMeshes(_ellipsoid, extents, surface.isScalable);
        const core::Interval altitude{std::min(extents.altitude().lower, _heights.lower - sag),
                                      std::max(extents.altitude().upper, _heights.upper)};
        AnalyticBin bin = withAltitude(surface.bin, altitude, sag);
        // in latitude, in longitude and by the lengths of skirts
        bin.setMargin(bin.margin() + 2.0 * roundingOf(_ellipsoid));
        return bin;
    }

    void fitSurface() {
        const TileSurface surface = meshSurface();
        _fit.isTerrain = surface.bin.valid();
        if (!_fit.isTerrain && !surface.isEmpty && _above.valid()) report(Finding::Unverifiable);
        if (!_fit.isTerrain) return;
        _fit.extents.bin = surface.bin.bin();
        _fit.extents.isMeasured = true;
        _fit.surface = surface.bin;
        _fit.isScalable = surface.isScalable;
        const bool isScaled = surface.isScalable && _shape.verticalScale != 1.0;
        const bool isDrawnAsRead = !isScaled && !_shape.areBoundariesEqual;
        _fit.isDeclared = isDrawnAsRead && !_isLeaf;
        _fit.skirt = surface.skirt;
        _fit.bin = _isLeaf ? surface.bin : rangedBin(surface);
        _drawn = surface.bin.withSkirts(surface.skirt);
    }

    // Returns: nullptr when the index does not know the tile as it is.
    [[nodiscard]] const BinIndex::Entry* indexEntry() const {
        const BinIndex::Entry* const entry = _from.index ? _from.index->find(_tile.frame.file, _tile.ordinal) : nullptr;
        return entry && entry->fingerprint == tileFingerprint(_tile) ? entry : nullptr;
    }

    void fitIndexed(const BinIndex::Entry& entry) {
        _fit.isTerrain = true;
        _fit.isScalable = hasTerrainTile(_tile);
        _fit.extents.bin = entry.bin.bin();
        _fit.surface = surfaceAbove(entry.ownLow, entry.bin);
        _fit.bin = _drawn = entry.bin;
        _isIndexed = true;
    }

    // Edges that lie half way to a neighbour's heights are anywhere in the heights that the options declare.
    [[nodiscard]] AnalyticBin withHeights(const AnalyticBin& bin) const {
        if (!bin.valid()) return bin;
        const core::Interval& own = bin.bin().altitude();
        const core::Interval all{std::min(own.lower, _heights.lower - bin.sag()), std::max(own.upper, _heights.upper)};
        return withAltitude(bin, all, 0.0);
    }

    // A terrain tile whose technique is not OSG's own and may draw anything.
    void fitUnknown() {
        report(Finding::UnknownTechnique);
        const TileSurface surface = meshSurface();
        if (surface.bin.valid()) _fit.extents.bin = surface.bin.bin();
        _fit.isScalable = true;
        _fit.isTerrain = true;
    }

    // A bin that is stored with a tile also stands for what is paged below it and not loaded yet. Content that turns
    // out to be larger expands it and its ancestors. Returns: the tile's own surface, where it is known.
    [[nodiscard]] AnalyticBin checkStored(const TileSurface& own) {
        // other sample ratios make other meshes than those that the bin was made of
        const AnalyticBin surface = own.isScalable && _shape.sampleRatio != 1.0 ? AnalyticBin() : own.bin;
        const bool isWithinBin = isHeld(_fit.bin, surface, surface.sag());
        if (!isWithinBin) {
            // a mesh that stands elsewhere may leave the place of the stored bin empty
            const AnalyticBin column(_fit.bin.bin().withAltitude(surface.bin().altitude()), _fit.bin.margin());
            if (!nearlyHolds(column, surface, surface.sag(), _ellipsoid)) report(Finding::MovedTile);
        }
        if (!isWithinBin || (_from.hasNewContent && surface.valid())) _fit.bin.expandBy(surface);
        const AnalyticBin& drawn = _fit.bin.valid() ? _fit.bin : surface;
        const double sag = surface.valid() ? std::min(surface.sag(), drawn.sag()) : 0.0;
        if (!isWithinBin || !isHeld(_above, drawn, sag)) report(Finding::LargerThanStored, drawn.withSkirts(own.skirt));
        return surface;
    }

    // The same for a tile without a stored bin, below a tile that has one.
    void checkUnstored(const AnalyticBin& shown, double sag) {
        if (!isHeld(_above, shown, sag)) report(Finding::LargerThanStored, shown);
    }

    // By what was found of the tile before. That may have been in another place, below other tiles.
    void correct() {
        const Widening& correction = _from.correction;
        if (correction.isBoundless && _above.valid()) report(Finding::Unverifiable);
        checkUnstored(correction.bin, 0.0);
        if (correction.any()) _fit.bin = correction.widened(_fit.bin);
    }

    // A stored lowest altitude is closer than the bound of a mesh's sag; it is used where the mesh's vertices allow it.
    [[nodiscard]] AnalyticBin shownSurface(const AnalyticBin& surface) const {
        const auto low = storedSurfaceLow(*_tile.node);
        if (!low) return surface;
        const bool isPossible = !surface.valid() || *low <= surface.bin().altitude().lower + surface.sag() +
                                                                surface.margin() + roundingOf(_ellipsoid);
        return isPossible ? surfaceAbove(*low, _fit.bin) : surface;
    }

    void fitStored() {
        const TileSurface own = meshSurface();
        if (!own.bin.valid() && !own.isEmpty) return report(Finding::Unverifiable);
        _fit.bin = storedBin(*_tile.node);
        _fit.isScalable = hasTerrainTile(_tile);
        _fit.isTerrain = true;
        const AnalyticBin surface = checkStored(own);
        if (!_fit.bin.valid()) return;
        _fit.surface = shownSurface(surface);
        _fit.extents.bin = _fit.bin.bin();
        // its maker need not have counted them
        _fit.skirt = own.skirt;
        _drawn = _fit.surface.withSkirts(own.skirt);
        correct();
        _fit.stored = _fit.bin;
    }

    void fitUnstored() {
        // an index does not know meshes of other sample ratios
        const bool isIndexFit = _shape.sampleRatio == 1.0;
        const BinIndex::Entry* const entry = isIndexFit ? indexEntry() : nullptr;
        if (entry && entry->bin.valid()) {
            fitIndexed(*entry);
            checkUnstored(_fit.bin, _fit.bin.sag());
        } else {
            fitSurface();
            if (isIndexFit && _fit.isTerrain && !_isLeaf && !_shape.areBoundariesEqual) report(Finding::IndexWanted);
            if (isIndexFit && _fit.isTerrain && _from.index && !entry)
                report(Finding::OtherThanIndexed, _fit.bin.withSkirts(_fit.skirt));
            if (!_fit.isScalable || _shape.sampleRatio == 1.0) checkUnstored(_fit.surface, _fit.surface.sag());
        }
        if (_fit.bin.valid()) correct();
    }

    // Whether tiles above it whose bins hold the declared heights may be too low for what it draws, or not deep enough.
    [[nodiscard]] bool leavesHeights() const {
        const core::Interval& altitude = _drawn.bin().altitude();
        return altitude.upper > _heights.upper || altitude.lower + _drawn.sag() < _heights.lower;
    }

    // The tile above that has a bin; null: none.
    [[nodiscard]] const InstalledTile* tileAbove() const {
        const InstalledTile* above = _from.parent;
        while (above && !above->ordinal) above = above->parent.get();
        return above;
    }

    [[nodiscard]] InstalledTile::Depth depthAbove() const {
        const InstalledTile* const above = tileAbove();
        return above ? above->extents.depth : InstalledTile::Depth();
    }

    // Whether its skirts may hang out of the bins above it. In a bin of an index they are a part of the sag. A vertical
    // scale moves bins that hold each other apart, but not the lengths of skirts.
    [[nodiscard]] bool hangsLower() const {
        const InstalledTile::Depth above = depthAbove();
        const double skirt = _isIndexed ? _drawn.sag() : _fit.skirt;
        return skirt > above.skirt + roundingOf(_ellipsoid) &&
               (_fit.isScalable || _drawn.bin().altitude().lower < above.low);
    }

    void noteDepth() {
        InstalledTile::Depth& depth = _fit.extents.depth;
        depth = depthAbove();
        if (!_fit.bin.valid()) return;
        if (!_isIndexed) depth.skirt = std::min(depth.skirt, _fit.skirt);
        depth.low = std::max(depth.low, _fit.bin.bin().altitude().lower - _fit.skirt);
    }

    // Whether a tile leaves the extents of the mesh above it, by more than vertices are rounded.
    [[nodiscard]] bool leavesExtents() const {
        const InstalledTile* const above = tileAbove();
        const core::GeodeticBin& own = (_fit.extents.isMeasured ? _fit.surface : _fit.bin).bin();
        if (!above || !above->extents.isMeasured || own.empty()) return false;
        const core::Interval &latitude = above->extents.bin.latitude(), &longitude = above->extents.bin.longitude();
        const double angle = roundingOf(_ellipsoid) / _ellipsoid.polarRadius();
        const double eastward =
            angle / std::max(std::cos(std::min(std::abs(latitude.lower), std::abs(latitude.upper))), 1e-3);
        return !core::GeodeticBin({latitude.lower - angle, latitude.upper + angle},
                                  {longitude.lower - eastward, longitude.upper + eastward}, own.altitude())
                    .contains(own);
    }

    const FoundTile& _tile;
    const FitSources& _from;
    const TerrainShape& _shape;
    const core::Ellipsoid _ellipsoid;
    const core::Interval _heights;
    const bool _isLeaf;
    const AnalyticBin _above;  // the nearest bin above that is stored with its tile
    AnalyticBin _drawn;        // skirts included; of a tile in an index with all that is below it
    bool _isIndexed = false;
    TileFit _fit;
};

// Looks for a drawable in a leaf that spans a good part of the tile above it, as ground does. Objects on the ground do
// not, however far they stand apart.
class GroundSearch : public osg::NodeVisitor {
public:
    // `extents`: of the whole leaf.
    GroundSearch(const core::GeodeticBin& above, const core::GeodeticBin& extents, const FoundTile& leaf)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _above(above), _leaf(leaf) {
        setNodeMaskOverride(~0u);
        if (isWide(extents)) leaf.node->accept(*this);
    }
    [[nodiscard]] bool found() const { return _found; }

    void apply(osg::Node& node) override {
        if (!_found) traverse(node);
    }
    void apply(osg::Drawable& drawable) override {
        if (_found) return;
        osg::NodePath path = getNodePath();
        path.pop_back();
        const osg::Matrixd toEcef = osg::computeLocalToWorld(path) * _leaf.frame.localToEcef;
        const AnalyticBin bin = tileSurface(drawable, *_leaf.frame.ellipsoid, toEcef).bin;
        _found = bin.valid() && isWide(bin.bin());
    }

private:
    [[nodiscard]] bool isWide(const core::GeodeticBin& bin) const {
        constexpr double kLeast = 1.0 / 16.0;
        return bin.latitude().width() >= kLeast * _above.latitude().width() &&
               bin.longitude().width() >= kLeast * _above.longitude().width();
    }

    const core::GeodeticBin _above;
    const FoundTile& _leaf;
    bool _found = false;
};

}  // namespace

TileFit fitTile(const FoundTile& tile, const FitSources& from, const TerrainShape& shape) {
    return Fitting(tile, from, shape).result();
}

std::optional<core::MeshCover> coverWithoutMesh(const FitSources& from, const TileFit& fit) {
    if (areVouchedFor(from.options, from.ellipsoid)) return core::MeshCover{fit.extents.bin, true};
    if (from.options.horizonUse == HorizonUse::Off && from.options.occlusion == OcclusionUse::Off)
        return core::MeshCover();
    return std::nullopt;
}

bool isGround(const FoundTile& tile, const InstalledTile* parent, const TileFit& fit) {
    const osg::Node& node = *tile.node;
    const bool isLeaf = tile.frame.isBelowTile && !hasStoredBin(node) && !dynamic_cast<const osg::PagedLOD*>(&node) &&
                        !dynamic_cast<const osgTerrain::TerrainTile*>(&node);
    if (!isLeaf || !parent) return true;
    GroundSearch search(parent->extents.bin, fit.extents.bin, tile);
    return search.found();
}

}  // namespace osgAnalyticBin
