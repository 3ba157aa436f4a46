// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileBuilder.h"

#include "Failure.h"
#include "ModuleFolder.h"
#include "Tile.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <ogr_spatialref.h>
#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>

#include <cmath>
#include <sstream>

namespace osgbindem {

using osgAnalyticBin::support::throwIfStopRequested;

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::TerrainGrid;
using osgAnalyticBin::core::GeodeticBin;

namespace {

std::int32_t& heightIn(TerrainGrid& grid, int column, int row) {
    return grid.heights[static_cast<std::size_t>((row + 1) * (grid.cells + 3) + column + 1)];
}

/// Every other post of a child is a post of its parent.
void takePosts(SurveyedTile& parent, SurveyedTile& child) {
    const int half = parent.grid.cells / 2;
    const int firstColumn = child.id.x % 2 == 0 ? 0 : half;
    const int firstRow = child.id.y % 2 == 0 ? 0 : half;
    for (int row = 0; row <= half; ++row)
        for (int column = 0; column <= half; ++column)
            heightIn(parent.grid, firstColumn + column, firstRow + row) = heightIn(child.grid, 2 * column, 2 * row);
}

/// The bytes of an .osgb file with the node. Throws Failure.
std::string nodeFileBytes(const osg::Node& node, bool compress) {
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setPluginStringData("fileType", "Binary");
    options->setPluginStringData("WriteImageHint", "IncludeData");
    if (compress) options->setPluginStringData("Compressor", "zlib");
    osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
    if (writer == nullptr)
        throw Failure("OpenSceneGraph's plugin for .osgb is missing; install it or set OSG_LIBRARY_PATH");
    std::ostringstream stream;
    const osgDB::ReaderWriter::WriteResult result = writer->writeNode(node, stream, options);
    if (!result.success() || !stream) throw Failure("OpenSceneGraph cannot store a tile: " + result.message());
    return stream.str();
}

}  // namespace

TileBuilder::TileBuilder(const Settings& settings, const TileLayout& layout, const TileFiles& files)
    : _settings(settings),
      _layout(layout),
      _files(files),
      _mosaic(settings, &layout),
      _skirts(_mosaic, layout),
      _images(settings),
      _triangles(osgAnalyticBin::trianglesOf(layout.cells())) {}

SurveyedTile TileBuilder::survey(const TileId& tile) {
    if (auto found = _finished ? _finished(tile) : std::nullopt) return std::move(*found);
    throwIfStopRequested();
    if (!_skirts.hasChildren(tile)) {
        SurveyedTile leaf = surveyLeaf(tile);
        if (_leafDone) _leafDone(tile);
        return leaf;
    }
    SurveyedTile surveyed = begun(tile);
    buildChildren(surveyed);
    finishSurvey(surveyed);
    return surveyed;
}

SurveyedTile TileBuilder::surveyLeaf(const TileId& tile) {
    SurveyedTile surveyed = begun(tile);
    // Tiles beside a region are there to surround it.
    const bool isCounted = _layout.isInRegion(tile);
    const RectDeg rect = tile.rect();
    const int cells = _layout.cells();
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const auto found = samplePost(surveyed, column, row);
            if (row == cells || column == cells || !isCounted) continue;
            ++surveyed.tally.posts;
            if (!found) ++surveyed.tally.missing;
            if (found && found->isFilled) ++surveyed.tally.filled;
        }
    }
    surveyed.range = _mosaic.range(rect);
    finishSurvey(surveyed);
    return surveyed;
}

SurveyedTile TileBuilder::begun(const TileId& tile) const {
    SurveyedTile surveyed;
    surveyed.id = tile;
    surveyed.tally.tiles = 1.0;
    surveyed.tally.deepest = tile.level;
    TerrainGrid& grid = surveyed.grid;
    grid = gridWithoutHeights(_layout, tile);
    grid.heights.resize(static_cast<std::size_t>((grid.cells + 3) * (grid.cells + 3)));
    return surveyed;
}

std::optional<FoundHeight> TileBuilder::samplePost(SurveyedTile& tile, int column, int row) {
    TerrainGrid& grid = tile.grid;
    const auto found = _mosaic.find(_layout.position({tile.id.level, grid.firstColumn + column, grid.firstRow + row}));
    // Posts that tiles share are rounded alike.
    heightIn(grid, column, row) =
        static_cast<std::int32_t>(std::nearbyint((found ? found->metres : 0.0) / TerrainGrid::kStep));
    return found;
}

void TileBuilder::finishSurvey(SurveyedTile& tile) {
    TerrainGrid& grid = tile.grid;
    for (int i = -1; i <= grid.cells + 1; ++i) {
        samplePost(tile, i, -1);
        samplePost(tile, i, grid.cells + 1);
        samplePost(tile, -1, i);
        samplePost(tile, grid.cells + 1, i);
    }
    placeOrigin(grid, _layout, tile.id.level);
    _skirts.measure(tile.id, grid);
}

void TileBuilder::buildChildren(SurveyedTile& tile) {
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    SharedParts shared(_layout.cells(), _settings.packed);
    for (const TileId& childId : tile.id.children()) {
        BuiltTile child = build(childId);
        takePosts(tile, child.survey);
        tile.range = tile.range.united(child.survey.range);
        tile.tally.add(child.survey.tally);
        tile.below.expandBy(child.bin);
        tile.checksum += child.survey.checksum;
        file->addChild(child.node);
        shared.addTo(*child.geometry, child.survey.grid.textureSize);
    }
    const std::string bytes = nodeFileBytes(*file, _settings.compress);
    _files.writeChildren(tile.id, bytes);
    tile.checksum += fileChecksum(tile.id, bytes);
    ++tile.tally.files;
    tile.tally.bytes += static_cast<double>(bytes.size());
}

BuiltTile TileBuilder::build(const TileId& id) {
    BuiltTile built;
    built.survey = survey(id);
    const SurveyedTile& tile = built.survey;
    TerrainGrid& grid = built.survey.grid;
    const RectDeg rect = id.rect();
    AnalyticBin bin(GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, tile.range));
    bin.expandBy(tile.below);
    MeshExtent extent = extentOf(grid, _triangles);
    // Where a packed tile is read, vertices may be rounded to the next step, for sines differ in their last bits.
    if (_settings.packed) extent.bin.setMargin(extent.bin.margin() + 2.0 * grid.quantum);
    bin.expandBy(extent.bin);
    // What is stored is text, which may round outward: the tiles above have to hold that.
    built.bin = AnalyticBin::fromText(bin.toText());

    colour(grid, _images.textureSize(id, grid.cells));
    const osg::ref_ptr<osg::Image> image = grid.textureSize > 0 ? _images.texture(id, grid) : nullptr;
    built.geometry = makeGeometry(grid, image, _settings.packed);
    const TileFacts facts{built.bin, extent.surfaceLow, _layout, _settings.lodFactor,
                          tile.below.valid() ? _files.childrenFile(id, id.level == _layout.startLevel()) : ""};
    built.node = makeTileNode(id, *makePlaced(*built.geometry, grid.origin), facts);
    return built;
}

void prepareNodeFiles() {
    osgAnalyticBin::addModuleFolder();
    for (const char* name : {"osg::Group", "osgAnalyticBin::InstallBinsCallback", "osgAnalyticBin::PackedTerrain"}) {
        if (osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper(name) == nullptr)
            throw Failure(std::string("OpenSceneGraph finds no serializer for ") + name +
                          "; install this library's modules or set OSG_LIBRARY_PATH");
    }
    (void)nodeFileBytes(*osg::ref_ptr<osg::Node>(new osg::Group), true);
}

std::string rootFileBytes(const std::vector<BuiltTile>& startTiles, const Settings& settings,
                          const TileLayout& layout) {
    OGRSpatialReference reference;
    if (settings.isWgs84) reference.importFromEPSG(4326);
    const osg::ref_ptr<osg::CoordinateSystemNode> root =
        makeRoot(settings.ellipsoid, settings.isWgs84 ? wktOf(reference) : std::string());
    SharedParts shared(layout.cells(), settings.packed);
    for (const BuiltTile& tile : startTiles) {
        root->addChild(tile.node);
        shared.addTo(*tile.geometry, tile.survey.grid.textureSize);
    }
    // Where the horizon of a region can be used is found out when it is shown.
    layout.isRegional() ? root->setUpdateCallback(new osgAnalyticBin::InstallBinsCallback) : declareHorizon(*root);
    return nodeFileBytes(*root, settings.compress);
}

}  // namespace osgbindem
