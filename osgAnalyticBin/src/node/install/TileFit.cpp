// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileFit.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "../surface/TilePlates.h"

#include <osgAnalyticBin/TileSurface.h>

#include <osg/Drawable>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
#include <typeinfo>

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

// Meshes of one tile are its levels of detail: any of them may be shown.
TileSurface surfaceOf(const FoundTile& tile, const osg::EllipsoidModel& ellipsoid, const TerrainShape& shape) {
    TileSurface surface;
    surface.isEmpty = true;
    for (const osg::ref_ptr<osg::Node>& mesh : tile.meshes) {
        const TileSurface own =
            tileSurface(*mesh, ellipsoid, tile.frame.localToEcef, shape.sampleRatio, shape.techniqueMargin > 0.0);
        if (own.isEmpty) continue;
        if (!own.bin.valid()) return {};
        surface.isEmpty = false;
        surface.bin.expandBy(own.bin);
        surface.skirt = std::max(surface.skirt, own.skirt);
        surface.isScalable = surface.isScalable || own.isScalable;
    }
    return surface;
}

void linkTo(const core::GeodeticBin& extents, ParentTile& link) {
    link.extents = extents;
    const ParentTile* parent = link.parent.get();
    link.edges = core::TileEdges::of(extents, parent ? &parent->extents : nullptr, parent ? &parent->edges : nullptr);
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
core::Interval heightsIn(const Database& database) {
    const core::Interval heights = database.options().heights;
    if (!(heights == CullOptions::kTerrainOnEarth)) return heights;
    const double scale = std::max(1.0, core::earthScale(toCore(*database.ellipsoid())));
    return {heights.lower * scale, heights.upper * scale};
}

// Metres by which rounded vertices of finer tiles may leave the extents of the mesh above them.
double roundingOf(const core::Ellipsoid& ellipsoid) {
    return core::earthScale(ellipsoid);
}

// The bin of a tile of which no more is known than its surface and the declared heights.
AnalyticBin rangedBin(const TileSurface& surface, bool hasDescendants, const Database& database,
                      const ParentTile& link) {
    const core::Ellipsoid ellipsoid = toCore(*database.ellipsoid());
    const core::GeodeticBin& extents = surface.bin.bin();
    const core::Interval heights = heightsIn(database);
    double sag = core::crackDepth(ellipsoid, extents, link.edges);
    core::Interval altitude = extents.altitude();
    if (hasDescendants) {
        sag = std::max(sag, core::sagOfFinerMeshes(ellipsoid, extents, surface.isScalable));
        altitude.upper = std::max(altitude.upper, heights.upper);
    }
    altitude.lower = std::min(altitude.lower, heights.lower - sag);
    AnalyticBin bin = withAltitude(surface.bin, altitude, sag);
    // in latitude and in longitude
    if (hasDescendants) bin.setMargin(bin.margin() + 2.0 * roundingOf(ellipsoid));
    return bin;
}

void fitSurface(const FoundTile& tile, Database& database, const TerrainShape& shape, ParentTile& link, TileFit& fit) {
    const TileSurface surface = surfaceOf(tile, *tile.frame.ellipsoid, shape);
    fit.isTerrain = surface.bin.valid();
    if (!fit.isTerrain && !surface.isEmpty && link.stored.valid()) Database::reportUnverifiable(link);
    if (!fit.isTerrain) return;
    linkTo(surface.bin.bin(), link);
    link.isMeasured = true;
    fit.surface = surface.bin;
    fit.isScalable = surface.isScalable;
    // what is drawn, and nothing else; exaggeration would not treat skirts as heights
    const core::Interval& altitude = surface.bin.bin().altitude();
    const bool isScaled = surface.isScalable && shape.verticalScale != 1.0;
    const bool isDrawnAsRead = !isScaled && !shape.areBoundariesEqual;
    const bool isLeaf = tile.pagedFiles.empty();
    fit.isDeclared = isDrawnAsRead && !isLeaf;
    if (database.options().skirts == SkirtUse::All || link.edges.areOnBorder()) fit.skirt = surface.skirt;
    fit.bin = isLeaf && isDrawnAsRead
                  ? withAltitude(surface.bin, {altitude.lower - surface.skirt + fit.skirt, altitude.upper}, 0.0)
                  : rangedBin(surface, !isLeaf, database, link);
}

// For a tile whose bin says nothing of skirts.
void fitSkirt(const FoundTile& tile, const TerrainShape& shape, TileFit& fit) {
    const TileSurface surface = surfaceOf(tile, *tile.frame.ellipsoid, shape);
    fit.skirt = surface.skirt;
    if (!surface.bin.valid()) fit.bin.init();
}

// The bin of a whole index, lowered where edges may dip below those of neighbours: its floor is that of their edges.
AnalyticBin dippedBin(const AnalyticBin& bin, const Database& database, const ParentTile& link) {
    const double relief = heightsIn(database).width() + bin.sag();
    const double dip = core::dipBehindEdge(toCore(*database.ellipsoid()), bin.bin(), link.edges, relief);
    const core::Interval& altitude = bin.bin().altitude();
    return withAltitude(bin, {altitude.lower - dip, altitude.upper}, bin.sag() + dip);
}

// Returns: whether the index knows the tile as it is, and its bin. `isContradicted`: it knows another tile in its
// place.
bool fitIndexed(const FoundTile& tile, const Database& database, const TerrainShape& shape, ParentTile& link,
                TileFit& fit, bool& isContradicted) {
    const osg::ref_ptr<const BinIndex> index = database.index();
    const BinIndex::Entry* const entry = index ? index->find(tile.frame.file, tile.ordinal) : nullptr;
    const bool isAsKnown = entry && entry->fingerprint == tileFingerprint(tile);
    isContradicted = index && !isAsKnown;
    if (!isAsKnown || !entry->bin.valid()) return false;
    fit.isTerrain = true;
    fit.bin = entry->bin;
    fit.isScalable = hasTerrainTile(tile);
    linkTo(fit.bin.bin(), link);
    fit.surface = surfaceAbove(entry->ownLow, fit.bin);
    fit.bin = dippedBin(fit.bin, database, link);
    if (link.edges.areOnBorder()) fitSkirt(tile, shape, fit);
    return true;
}

// Edges that lie half way to a neighbour's heights are anywhere in the heights that the options declare.
AnalyticBin withHeights(const AnalyticBin& bin, const core::Interval& heights) {
    if (!bin.valid()) return bin;
    const core::Interval& own = bin.bin().altitude();
    const core::Interval all{std::min(own.lower, heights.lower - bin.sag()), std::max(own.upper, heights.upper)};
    return withAltitude(bin, all, 0.0);
}

// A terrain tile whose technique is not OSG's own and may draw anything.
TileFit unknownFit(const FoundTile& tile, Database& database, const TerrainShape& shape, ParentTile& link) {
    database.noteUnknownTechnique();
    const TileSurface surface = surfaceOf(tile, *tile.frame.ellipsoid, shape);
    if (surface.bin.valid()) linkTo(surface.bin.bin(), link);
    TileFit fit;
    fit.isScalable = true;
    fit.isTerrain = true;
    return fit;
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

// A bin that is stored with a tile also stands for what is paged below it and not loaded yet. Content that turns out to
// be larger expands it and its ancestors. Returns: the tile's own surface, where it is known.
AnalyticBin checkStored(const FoundTile& tile, Database& database, const TerrainShape& shape, ParentTile& link,
                        TileFit& fit) {
    const osg::EllipsoidModel& model = tile.frame.ellipsoid ? *tile.frame.ellipsoid : *database.ellipsoid();
    const TileSurface own = surfaceOf(tile, model, shape);
    if (!own.bin.valid() && !own.isEmpty) {
        fit.bin.init();
        fit.isTerrain = false;
        Database::reportUnverifiable(link);
        return {};
    }
    fit.ownSkirt = own.skirt;
    // other sample ratios make other meshes than those that the bin was made of
    const AnalyticBin surface = own.isScalable && shape.sampleRatio != 1.0 ? AnalyticBin() : own.bin;
    const core::Ellipsoid ellipsoid = toCore(model);
    const bool isWithinBin =
        !surface.valid() || !fit.bin.valid() || nearlyHolds(fit.bin, surface, surface.sag(), ellipsoid);
    if (!isWithinBin) {
        // a mesh that stands elsewhere may leave the place of the stored bin empty
        const AnalyticBin column(fit.bin.bin().withAltitude(surface.bin().altitude()), fit.bin.margin());
        if (!nearlyHolds(column, surface, surface.sag(), ellipsoid)) database.noteMovedTile(tile.frame.file);
    }
    if (!isWithinBin || (link.hasNewContent && surface.valid())) fit.bin.expandBy(surface);
    const AnalyticBin& drawn = fit.bin.valid() ? fit.bin : surface;
    const double sag = surface.valid() ? std::min(surface.sag(), drawn.sag()) : 0.0;
    const ParentTile* const parent = link.parent.get();
    const bool isWithinParent =
        !parent || !parent->stored.valid() || !drawn.valid() || nearlyHolds(parent->stored, drawn, sag, ellipsoid);
    if (!isWithinBin || !isWithinParent) Database::reportFalseBin(link, drawn);
    return surface;
}

// The same of a tile that has no bin of its own stored, below one that has.
void checkUnstored(const AnalyticBin& shown, double sag, Database& database, const ParentTile& link) {
    if (!link.stored.valid() || !shown.valid()) return;
    if (!nearlyHolds(link.stored, shown, sag, toCore(*database.ellipsoid()))) Database::reportFalseBin(link, shown);
}

// By what was found of the tile before. That may have been in another place, below other tiles.
void correct(const FoundTile& tile, Database& database, const ParentTile& link, TileFit& fit) {
    const Widening correction = database.correction(tile.frame.file, tile.ordinal);
    if (correction.isBoundless && link.stored.valid()) Database::reportUnverifiable(link);
    checkUnstored(correction.bin, 0.0, database, link);
    if (correction.any()) fit.bin = correction.widened(fit.bin);
}

// A stored lowest altitude is closer than the bound of a mesh's sag; it is used where the mesh's vertices allow it.
AnalyticBin shownSurface(const FoundTile& tile, const AnalyticBin& surface, const AnalyticBin& bin,
                         const core::Ellipsoid& ellipsoid) {
    const double rounding = roundingOf(ellipsoid);
    const auto low = storedSurfaceLow(*tile.node);
    if (!low) return surface;
    const bool isPossible =
        !surface.valid() || *low <= surface.bin().altitude().lower + surface.sag() + surface.margin() + rounding;
    return isPossible ? surfaceAbove(*low, bin) : surface;
}

TileFit fitStored(const FoundTile& tile, Database& database, const TerrainShape& shape, ParentTile& link) {
    TileFit fit;
    fit.bin = storedBin(*tile.node);
    fit.isScalable = hasTerrainTile(tile);
    fit.isTerrain = true;
    const AnalyticBin surface = checkStored(tile, database, shape, link, fit);
    if (!fit.bin.valid()) return fit;
    fit.surface = shownSurface(tile, surface, fit.bin, toCore(*database.ellipsoid()));
    linkTo(fit.bin.bin(), link);
    // makers of bins need not know that nothing stands before the skirts there
    if (database.options().skirts == SkirtUse::All || link.edges.areOnBorder()) fit.skirt = fit.ownSkirt;
    correct(tile, database, link, fit);
    link.stored = fit.bin;
    return fit;
}

TileFit fitKnown(const FoundTile& tile, Database& database, const TerrainShape& shape, ParentTile& link) {
    if (hasStoredBin(*tile.node)) return fitStored(tile, database, shape, link);
    TileFit fit;
    // an index does not know how far skirts hang, nor meshes of other sample ratios
    const bool isIndexFit = database.options().skirts == SkirtUse::Cracks && shape.sampleRatio == 1.0;
    bool isContradicted = false;
    if (!isIndexFit || !fitIndexed(tile, database, shape, link, fit, isContradicted)) {
        fitSurface(tile, database, shape, link, fit);
        const bool isIndexWanted = isIndexFit && fit.isTerrain && !tile.pagedFiles.empty() && !shape.areBoundariesEqual;
        if (isIndexWanted) database.noteIndexWanted();
        if (isContradicted && fit.isTerrain) Database::reportMisfit(link, fit.bin);
        if (!fit.isScalable || shape.sampleRatio == 1.0) checkUnstored(fit.surface, fit.surface.sag(), database, link);
    } else {
        checkUnstored(fit.bin, fit.bin.sag(), database, link);
    }
    if (!fit.bin.valid()) return fit;
    fit.bin.setBin(core::withGaps(toCore(*database.ellipsoid()), fit.bin.bin(), link.edges));
    correct(tile, database, link, fit);
    return fit;
}

// Whether tiles above it whose bins hold the declared heights may be too low for a surface, or not deep enough.
bool leavesHeights(const AnalyticBin& surface, const Database& database) {
    const core::Interval heights = heightsIn(database);
    const core::Interval& altitude = surface.bin().altitude();
    return altitude.upper > heights.upper || altitude.lower + surface.sag() < heights.lower;
}

// Whether a tile leaves the extents of the mesh above it, by more than vertices are rounded.
bool leavesExtents(const TileFit& fit, const Database& database, const ParentTile& link) {
    const ParentTile* above = link.parent.get();
    while (above && !above->isTile) above = above->parent.get();
    const core::GeodeticBin& own = (link.isMeasured ? fit.surface : fit.bin).bin();
    if (!above || !above->isMeasured || own.empty()) return false;
    const core::Ellipsoid ellipsoid = toCore(*database.ellipsoid());
    const core::Interval &latitude = above->extents.latitude(), &longitude = above->extents.longitude();
    const double angle = roundingOf(ellipsoid) / ellipsoid.polarRadius();
    const double eastward =
        angle / std::max(std::cos(std::min(std::abs(latitude.lower), std::abs(latitude.upper))), 1e-3);
    return !core::GeodeticBin({latitude.lower - angle, latitude.upper + angle},
                              {longitude.lower - eastward, longitude.upper + eastward}, own.altitude())
                .contains(own);
}

// Who declares a horizon says that the tiles of the globe have no holes.
bool isVouchedFor(const CullOptions& options, const osg::EllipsoidModel& ellipsoid) {
    return options.horizonUse == HorizonUse::Given && !isMapPlane(ellipsoid);
}

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

TileFit fitTile(const FoundTile& tile, Database& database, const TerrainShape& shape, ParentTile& link) {
    if (!shape.isKnown() && hasTerrainTile(tile)) {
        return unknownFit(tile, database, shape, link);
    }
    TileFit fit = fitKnown(tile, database, shape, link);
    if (fit.surface.valid() && (link.hasNewContent || leavesHeights(fit.surface, database)))
        Database::noteLarger(link, fit.surface);
    if (leavesExtents(fit, database, link)) Database::noteLarger(link, link.isMeasured ? fit.surface : fit.bin);
    if (shape.areBoundariesEqual && fit.isScalable) {
        fit.bin = withHeights(fit.bin, heightsIn(database));
        fit.surface = withHeights(fit.surface, heightsIn(database));
    }
    if (fit.isScalable && shape.techniqueMargin > 0.0) {
        fit.isInPlace = false;
        for (AnalyticBin* const bin : {&fit.bin, &fit.surface}) bin->setMargin(bin->margin() + shape.techniqueMargin);
    }
    return fit;
}

core::MeshCover coverBy(const FoundTile& tile, const Database& database, const TerrainShape& shape,
                        const ParentTile& link) {
    const CullOptions options = database.options();
    const osg::EllipsoidModel& ellipsoid = tile.frame.ellipsoid ? *tile.frame.ellipsoid : *database.ellipsoid();
    if (isVouchedFor(options, ellipsoid)) return {link.extents, true};
    if (options.horizonUse == HorizonUse::Off && options.occlusion == OcclusionUse::Off) return {};
    return coverOf({tile.meshes, ellipsoid, tile.frame.localToEcef, shape});
}

bool isGround(const FoundTile& tile, const ParentTile& link) {
    const osg::Node& node = *tile.node;
    const bool isLeaf = tile.frame.isBelowTile && !hasStoredBin(node) && !dynamic_cast<const osg::PagedLOD*>(&node) &&
                        !dynamic_cast<const osgTerrain::TerrainTile*>(&node);
    if (!isLeaf || !link.parent) return true;
    GroundSearch search(link.parent->extents, link.extents, tile);
    return search.found();
}

}  // namespace osgAnalyticBin
