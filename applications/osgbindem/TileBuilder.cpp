// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileBuilder.h"

#include "Interruption.h"
#include "NodeFile.h"
#include "TileGeometry.h"
#include "TileMesh.h"
#include "TileNode.h"
#include "TileTopology.h"

namespace osgbindem {

using osgAnalyticBin::support::throwIfStopRequested;

using osgAnalyticBin::AnalyticBin;
using osgAnalyticBin::core::GeodeticBin;

TileBuilder::TileBuilder(const Settings& settings, const TileLayout& layout, const DatabaseFolder& folder)
    : _settings(settings),
      _layout(layout),
      _folder(folder),
      _mosaic(settings, layout.spacingDeg(layout.deepestLevel())),
      _depths(_mosaic, layout),
      _skirts(_mosaic, layout, _depths),
      _triangles(tileTriangles(layout.cells())) {
    if (!settings.image.empty()) _image = std::make_unique<ImageSource>(settings.image, settings.isWgs84);
}

std::unique_ptr<BuiltTile> TileBuilder::build(const TileId& tile, BuiltTiles& ahead) {
    const auto found = ahead.find(tile);
    if (found != ahead.end()) {
        std::unique_ptr<BuiltTile> built = std::move(found->second);
        ahead.erase(found);
        return built;
    }
    throwIfStopRequested();
    auto built = std::make_unique<BuiltTile>(BuiltTile{HeightGrid(tile, _layout), {}, {}, {}, {}});
    // The border is for the ring around the heights; the subtree of the first tile that fits is served from memory.
    _mosaic.prefetch(tile.rect().grownBy(_layout.spacingDeg(tile.level)));
    const bool hasChildren = _depths.hasChildren(tile);
    if (hasChildren) {
        buildChildren(*built, ahead);
    } else {
        built->heights.sample(_mosaic, _layout);
        built->range = _mosaic.range(tile.rect());
    }
    finish(*built, hasChildren);
    if (!hasChildren && _leafDone) _leafDone(tile);
    return built;
}

void TileBuilder::buildChildren(BuiltTile& tile, BuiltTiles& ahead) {
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    std::vector<osg::Geometry*> geometries;
    for (const TileId& id : tile.heights.tile().children()) {
        const std::unique_ptr<BuiltTile> child = build(id, ahead);
        tile.heights.takeFrom(child->heights);
        tile.range.include(child->range);
        tile.bin.expandBy(child->bin);
        file->addChild(child->node);
        geometries.push_back(child->geometry);
    }
    finishFile(geometries, tile.heights.tile().level + 1);
    _folder.writeChildren(tile.heights.tile(), nodeFileBytes(*file, _settings.compress));
}

AnalyticBin TileBuilder::sourceBin(const TileId& tile, const HeightRange& range) const {
    const RectDeg rect = tile.rect();
    return AnalyticBin(
        GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, {range.lower, range.upper}));
}

void TileBuilder::finish(BuiltTile& tile, bool hasChildren) {
    const TileId& id = tile.heights.tile();
    tile.heights.sampleRing(_mosaic, _layout);
    const TileMesh mesh(tile.heights, _skirts.measure(tile.heights), _layout);
    AnalyticBin bin = sourceBin(id, tile.range);
    bin.expandBy(tile.bin);
    const MeshExtent extent = extentOf(mesh, _triangles, id, _layout);
    bin.expandBy(extent.bin);
    // What is stored is text, which may round outward: the tiles above have to hold that.
    tile.bin = AnalyticBin::fromText(bin.toText());

    const osg::ref_ptr<osg::Image> image = _image ? _image->texture(tile.heights) : nullptr;
    tile.geometry = makeGeometry(mesh, tile.heights, image);
    const osg::ref_ptr<osg::Node> placed = makePlaced(*tile.geometry, mesh.originEcef);
    const TileFacts facts{tile.bin, extent.surfaceLow, _layout, _settings.lodFactor,
                          hasChildren ? _folder.childrenFile(id) : ""};
    tile.node = makeTileNode(id, *placed, facts);
}

void TileBuilder::finishFile(const std::vector<osg::Geometry*>& geometries, int level) {
    const SharedParts shared(_triangles, _layout.cells(), _image ? _image->textureSize(level) : 0);
    for (osg::Geometry* geometry : geometries) shared.addTo(*geometry);
}

}  // namespace osgbindem
