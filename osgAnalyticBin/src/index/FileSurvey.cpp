// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FileSurvey.h"

#include "../kit/surface/SurfaceWalk.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileSurface.h>

#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osgDB/FileNameUtils>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <filesystem>
#include <set>

namespace osgAnalyticBin::indexing {

namespace {

FilePlace placeOf(const TileFrame& frame, bool isBelowTile, double sampleRatio) {
    FilePlace place;
    if (frame.ellipsoid) {
        place.equatorialRadius = frame.ellipsoid->getRadiusEquator();
        place.polarRadius = frame.ellipsoid->getRadiusPolar();
    }
    place.isProjected = frame.isProjected;
    std::copy_n(frame.localToEcef.ptr(), 16, place.localToEcef.begin());
    place.isBelowTile = isBelowTile;
    place.sampleRatio = sampleRatio;
    return place;
}

TileSurface surfaceOf(const FoundTile& tile, double sampleRatio) {
    TileSurface whole;
    if (!tile.frame.ellipsoid) return whole;
    for (const auto& mesh : tile.meshes) {
        const TileSurface part = tileSurface(*mesh, *tile.frame.ellipsoid, tile.frame.localToEcef, sampleRatio);
        if (!part.bin.valid()) return {};
        whole.isInMap = part.isInMap;
        whole.bin.expandBy(part.bin);
        whole.skirt = std::max(whole.skirt, part.skirt);
        whole.isScalable = whole.isScalable || part.isScalable;
    }
    return whole;
}

using Nodes = std::set<const osg::Node*>;

/// Meets what a file draws, or pages, beside its tiles and the links that are known.
class OtherContent : public osg::NodeVisitor {
public:
    OtherContent(const Nodes& tiles, const Nodes& links)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _tiles(tiles), _links(links) {
        setNodeMaskOverride(~0u);
    }
    void apply(osg::Node& node) override {
        if (_tiles.count(&node) > 0) return;
        const bool isTerrain = dynamic_cast<osgTerrain::TerrainTile*>(&node) != nullptr;
        isFound = isFound || isTerrain || drawsByItself(node);
        if (!isTerrain) traverse(node);
    }
    void apply(osg::PagedLOD& node) override {
        isFound = isFound || (_tiles.count(&node) == 0 && _links.count(&node) == 0);
        apply(static_cast<osg::Node&>(node));
    }
    void apply(osg::ProxyNode& node) override {
        isFound = true;
        apply(static_cast<osg::Node&>(node));
    }

    bool isFound = false;

private:
    const Nodes& _tiles;
    const Nodes& _links;
};

class Survey : public TileFinder {
public:
    Survey(const DatabaseFiles& files, const std::string& file, const FilePlace& place)
        : TileFinder(frameOf(place, file)), _files(files), _sampleRatio(place.sampleRatio) {
        record.file = file;
    }

    FileRecord record;
    Nodes tiles;
    Nodes links;

protected:
    void visitTile(FoundTile& tile) override {
        // what is paged is read from its own file
        if (tile.frame.file != record.file) return;
        tiles.insert(tile.node.get());
        const auto ordinal = static_cast<std::int32_t>(record.tiles.size());
        record.tiles.push_back({surfaceOf(tile, _sampleRatio), tileFingerprint(tile), _tile});
        if (const auto* paged = dynamic_cast<const osg::PagedLOD*>(tile.node.get())) link(*paged, ordinal);
        const std::int32_t outer = _tile;
        _tile = ordinal;
        traverseBelow(*tile.node);
        _tile = outer;
    }

    void visitOther(osg::Node& node) override {
        if (frame().file != record.file) return;
        const double outer = _sampleRatio;
        if (const auto* terrain = dynamic_cast<const osgTerrain::Terrain*>(&node)) {
            _sampleRatio = static_cast<double>(terrain->getSampleRatio());
        }
        if (const auto* paged = dynamic_cast<const osg::PagedLOD*>(&node)) link(*paged, _tile);
        traverseBelow(node);
        _sampleRatio = outer;
    }

private:
    void link(const osg::PagedLOD& paged, std::int32_t tile) {
        links.insert(&paged);
        for (unsigned int i = 0; i < paged.getNumFileNames(); ++i) {
            const std::string& name = paged.getFileName(i);
            if (name.empty()) continue;
            requireOwnFolder(paged, name);
            const std::string file = pagedFilePath(record.file, name);
            record.links.push_back({_files.checked(file, record.file), tile,
                                    placeOf(frame(), frame().isBelowTile || tile >= 0, _sampleRatio)});
        }
    }

    /// A path that is stored in the file would send the pager elsewhere.
    void requireOwnFolder(const osg::PagedLOD& paged, const std::string& name) const {
        namespace fs = std::filesystem;
        const std::string own = osgDB::getFilePath(_files.pathOf(record.file));
        const std::string& stored = paged.getDatabasePath();
        if (stored.empty() || stored == own || stored == own + "/") return;
        std::error_code ignored;
        if (!fs::exists(stored + "/" + name, ignored) || fs::equivalent(stored, own.empty() ? "." : own, ignored))
            return;
        throw Failure("\"" + _files.pathOf(record.file) + "\" sends the pager to the folder \"" + stored +
                      "\"; store it without database paths");
    }

    const DatabaseFiles& _files;
    double _sampleRatio;
    std::int32_t _tile = -1;
};

}  // namespace

TileFrame frameOf(const FilePlace& place, const std::string& file) {
    TileFrame frame;
    if (place.equatorialRadius > 0.0) {
        frame.ellipsoid = new osg::EllipsoidModel(place.equatorialRadius, place.polarRadius);
    }
    frame.isProjected = place.isProjected;
    frame.localToEcef.set(place.localToEcef.data());
    frame.file = file;
    frame.isBelowTile = place.isBelowTile;
    return frame;
}

FileRecord surveyFile(osg::Node& scene, const std::string& file, const FilePlace& place, const DatabaseFiles& files) {
    Survey survey(files, file, place);
    scene.accept(survey);
    OtherContent other(survey.tiles, survey.links);
    scene.accept(other);
    survey.record.isRead = true;
    survey.record.hasOtherContent = other.isFound;
    return std::move(survey.record);
}

}  // namespace osgAnalyticBin::indexing
