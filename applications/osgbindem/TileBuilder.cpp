// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileBuilder.h"

#include "Interruption.h"
#include "TileFiles.h"
#include "TileMesh.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <ogr_spatialref.h>
#include <osg/CoordinateSystemNode>
#include <osg/LightModel>
#include <osg/Material>

#include <algorithm>
#include <cmath>
#include <string>

namespace osgbindem {

using osgAnalyticBin::support::throwIfStopRequested;

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::core::GeodeticBin;

TileBuilder::TileBuilder(const Settings& settings, const TileLayout& layout, const TileFiles& files)
    : _settings(settings),
      _layout(layout),
      _files(files),
      _mosaic(settings, &layout),
      _depths(_mosaic, layout),
      _skirts(_mosaic, layout, _depths),
      _images(settings),
      _triangles(osgAnalyticBin::trianglesOf(layout.cells())) {}

SurveyedTile TileBuilder::survey(const TileId& tile) {
    if (_finished) {
        if (auto found = _finished(tile)) return std::move(*found);
    }
    throwIfStopRequested();
    prefetch(tile);
    if (!_depths.hasChildren(tile)) {
        SurveyedTile leaf = surveyAlone(tile);
        leaf.range = _mosaic.range(tile.rect());
        if (_leafDone) _leafDone(tile);
        return leaf;
    }
    SurveyedTile surveyed{HeightGrid(tile, _layout), {}, {}, {}, {}};
    buildChildren(surveyed);
    finishSurvey(surveyed);
    return surveyed;
}

SurveyedTile TileBuilder::surveyAlone(const TileId& tile) {
    prefetch(tile);
    SurveyedTile surveyed{HeightGrid(tile, _layout), {}, {}, {}, {}};
    const Tally tally = surveyed.heights.sample(_mosaic, _layout);
    // Tiles beside a region are there to surround it.
    if (_layout.isInRegion(tile)) surveyed.tally = tally;
    surveyed.tally.tiles = 1.0;
    surveyed.tally.deepest = tile.level;
    finishSurvey(surveyed);
    return surveyed;
}

void TileBuilder::prefetch(const TileId& tile) {
    // The border is for the ring around the heights; the subtree of the first tile that fits is served from memory.
    _mosaic.prefetch(tile.rect().grownBy(_layout.spacingDeg(tile.level)));
}

void TileBuilder::finishSurvey(SurveyedTile& tile) {
    tile.heights.sampleRing(_mosaic, _layout);
    tile.skirt = _skirts.measure(tile.heights);
}

std::unique_ptr<BuiltTile> TileBuilder::build(const TileId& tile) {
    return meshed(survey(tile));
}

void TileBuilder::buildChildren(SurveyedTile& tile) {
    const TileId& id = tile.heights.tile();
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    SharedParts shared = sharedParts();
    for (const TileId& childId : id.children()) {
        const std::unique_ptr<BuiltTile> child = build(childId);
        tile.heights.takeFrom(child->heights);
        tile.range.include(child->range);
        tile.tally.add(child->tally);
        tile.below.expandBy(child->bin);
        file->addChild(child->node);
        child->add(shared);
    }
    const std::string bytes = nodeFileBytes(*file, _settings.compress);
    _files.writeChildren(id, bytes);
    _written.add(id, bytes);
    ++tile.tally.tiles;
    ++tile.tally.files;
    tile.tally.bytes += static_cast<double>(bytes.size());
}

std::unique_ptr<BuiltTile> TileBuilder::meshed(SurveyedTile tile) {
    const TileId id = tile.heights.tile();
    osgAnalyticBin::TerrainGrid grid = gridOf(tile.heights, tile.skirt, _layout);
    const RectDeg rect = id.rect();
    AnalyticBin bin(GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east},
                                             {tile.range.lower, tile.range.upper}));
    bin.expandBy(tile.below);
    MeshExtent extent = extentOf(grid, _triangles, id, _layout);
    // Where a packed tile is read, vertices may be rounded to the next step, for sines differ in their last bits.
    if (_settings.packed) extent.bin.setMargin(extent.bin.margin() + 2.0 * grid.quantum);
    bin.expandBy(extent.bin);
    // What is stored is text, which may round outward: the tiles above have to hold that.
    bin = AnalyticBin::fromText(bin.toText());

    colour(grid, _images.textureSize(id, grid.cells));
    const osg::ref_ptr<osg::Image> image = grid.textureSize > 0 ? _images.texture(id, grid) : nullptr;
    const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(grid, image, _settings.packed);
    const osg::ref_ptr<osg::Node> placed = makePlaced(*geometry, grid.origin);
    const TileFacts facts{bin, extent.surfaceLow, _layout, _settings.lodFactor,
                          tile.below.valid() ? _files.childrenFile(id) : ""};
    const osg::ref_ptr<osg::Node> node = makeTileNode(id, *placed, facts);
    return std::make_unique<BuiltTile>(
        BuiltTile{std::move(tile.heights), tile.range, tile.tally, bin, node, geometry, grid.textureSize});
}

SharedParts TileBuilder::sharedParts() const {
    return _settings.packed ? SharedParts() : SharedParts(_triangles, _layout.cells());
}

namespace {

/// The root node of a database, without tiles.
osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const Settings& settings) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(
        new osg::EllipsoidModel(settings.ellipsoid.equatorialRadius(), settings.ellipsoid.polarRadius()));
    if (settings.isWgs84) {
        OGRSpatialReference reference;
        reference.importFromEPSG(4326);
        root->setFormat("WKT");
        root->setCoordinateSystem(wktOf(reference));
    }
    // Lit, with the vertices' own colours.
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    root->getOrCreateStateSet()->setAttributeAndModes(material);
    // With OSG's light, which stands with the eye: bright enough at grazing angles, and no land too bright from above.
    constexpr float kAmbient = 0.5F;
    const osg::ref_ptr<osg::LightModel> light = new osg::LightModel;
    light->setAmbientIntensity(osg::Vec4(kAmbient, kAmbient, kAmbient, 1.0F));
    root->getOrCreateStateSet()->setAttribute(light);
    return root;
}

/// Declares below what nothing is drawn: a globe is whole, so that what lies behind it is hidden. Of a region nothing
/// is declared: where its horizon can be used is found out when it is shown.
void declareHorizon(osg::Group& root, const TileLayout& layout) {
    if (layout.isRegional()) {
        root.setUpdateCallback(new osgAnalyticBin::InstallBinsCallback);
        return;
    }
    double lowest = 0.0;
    for (unsigned int i = 0; i < root.getNumChildren(); ++i) {
        const osgAnalyticBin::AnalyticBin bin = osgAnalyticBin::storedBin(*root.getChild(i));
        lowest = std::min(lowest, bin.bin().altitude().lower - bin.margin());
    }
    osgAnalyticBin::CullOptions options;
    options.horizonUse = osgAnalyticBin::HorizonUse::Given;
    options.horizon = std::floor(lowest);
    root.setUpdateCallback(new osgAnalyticBin::InstallBinsCallback(options));
}

}  // namespace

void StartTiles::build(TileBuilder& builder) {
    for (std::size_t i = _next++; i < _tiles.size(); i = _next++) {
        if (i == 0) _shared = builder.sharedParts();  // which are the same for all builders
        _tiles[i] = builder.build(_layout.startTiles()[i]);
    }
}

Tally StartTiles::tally() const {
    Tally tally;
    for (const auto& tile : _tiles) tally.add(tile->tally);
    return tally;
}

std::string StartTiles::rootBytes() const {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = makeRoot(_settings);
    SharedParts shared = *_shared;
    for (const auto& tile : _tiles) {
        root->addChild(tile->node);
        tile->add(shared);
    }
    declareHorizon(*root, _layout);
    return nodeFileBytes(*root, _settings.compress);
}

}  // namespace osgbindem
