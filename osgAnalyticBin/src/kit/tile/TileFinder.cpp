// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../PagedChildren.h"
#include "../Scoped.h"
#include "../surface/MapGround.h"
#include "../surface/SurfaceWalk.h"
#include "Carrier.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osg/Drawable>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <array>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

// The globe of tiles with stored bins that no CoordinateSystemNode stands above, and of what is below them.
const osg::ref_ptr<const osg::EllipsoidModel>& wgs84() {
    // never destroyed: a pager that an application never deletes may still read
    static const auto& ellipsoid = *new osg::ref_ptr<const osg::EllipsoidModel>(new osg::EllipsoidModel);
    return ellipsoid;
}

bool isTerrainTile(osg::Node& node) {
    return dynamic_cast<osgTerrain::TerrainTile*>(&node) != nullptr;
}

// Whether a subgraph is geometry that stays where it is, without tiles in it.
class IsFixedMesh : public osg::NodeVisitor {
public:
    IsFixedMesh() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

    void apply(osg::Node& node) override {
        const bool isTile = isTerrainTile(node) || hasStoredBin(node);
        osg::Transform* transform = node.asTransform();
        // what a callback on a group changes is noticed like any other change
        const bool isAnimated = node.getUpdateCallback() && !node.asGroup();
        if (isTile || isAnimated || (transform && !hasFixedPlace(*transform))) result = false;
        hasDrawable = hasDrawable || node.asDrawable();
        if (result) traverse(node);
    }
    void apply(osg::PagedLOD&) override { result = false; }

    bool result = true;
    bool hasDrawable = false;
};

bool isFixedMesh(osg::Node& node) {
    IsFixedMesh check;
    node.accept(check);
    return check.result && check.hasDrawable;
}

std::vector<osg::ref_ptr<osg::Node>> ownMeshes(osg::Node& node) {
    auto* paged = dynamic_cast<osg::PagedLOD*>(&node);
    if (!paged) return {&node};
    std::vector<osg::ref_ptr<osg::Node>> meshes;
    for (unsigned int i = 0; i < paged->getNumChildren(); ++i) {
        if (!isPaged(*paged, i)) meshes.emplace_back(paged->getChild(i));
    }
    return meshes;
}

std::vector<std::string> filesBelow(const osg::Node& node, const std::string& file) {
    std::vector<std::string> files;
    if (const auto* paged = dynamic_cast<const osg::PagedLOD*>(&node)) {
        for (unsigned int i = 0; i < paged->getNumFileNames(); ++i) {
            if (isPaged(*paged, i)) files.push_back(pagedFilePath(file, paged->getFileName(i)));
        }
    }
    return files;
}

bool startsWith(const std::string& text, const char* start) {
    return text.rfind(start, 0) == 0;
}

// Whether a coordinate system declares its coordinates as those of a map: in well-known text, alone or
// with a vertical one, or in the parameters of PROJ.
bool isProjected(const osg::CoordinateSystemNode& node) {
    const std::string& text = node.getCoordinateSystem();
    if (startsWith(text, "PROJCS") || startsWith(text, "PROJCRS")) return true;
    if (startsWith(text, "COMPD_CS")) return text.find("PROJCS") != std::string::npos;
    const std::string key = "+proj=";
    const std::size_t at = text.find(key);
    if (node.getFormat() != "PROJ4" || at == std::string::npos) return false;
    const std::size_t begin = at + key.size();
    const std::string name = text.substr(begin, text.find_first_of(" \t\n", begin) - begin);
    const std::array<const char*, 6> others{"longlat", "latlong", "lonlat", "latlon", "geocent", ""};
    return std::none_of(others.begin(), others.end(), [&](const char* other) { return name == other; });
}

}  // namespace

TileFinder::TileFinder(const TileFrame& frame, const std::string& ground)
    : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _frame(frame), _ground(ground) {
    setNodeMaskOverride(~0u);
}

void TileFinder::apply(osg::Node& node) {
    visit(node, isTile(node));
}

TileFrame TileFinder::frameInside(const osg::CoordinateSystemNode& node) const {
    TileFrame inside = _frame;
    inside.localToEcef.makeIdentity();
    inside.ellipsoid = node.getEllipsoidModel();
    inside.isProjected = isProjected(node);
    const bool isBroken = inside.ellipsoid && !hasValidRadii(*inside.ellipsoid);
    if (!inside.isKnown()) inside.ellipsoid = new osg::EllipsoidModel;
    if (isBroken) inside.ellipsoid = nullptr;
    return inside;
}

void TileFinder::apply(osg::CoordinateSystemNode& node) {
    const Scoped scope(_frame, frameInside(node));
    visit(node, hasStoredBin(node));
}

void TileFinder::apply(osg::Transform& node) {
    const bool hasFrame = _frame.isKnown() || hasStoredBin(node);
    if (hasFrame && !hasFixedPlace(node)) return visitMoving(node);
    visit(node, isTile(node));
}

void TileFinder::apply(osg::PagedLOD& node) {
    visit(node, isTile(node));
}

bool TileFinder::isTile(osg::Node& node) const {
    // OSG culls a drawable after its callbacks, whatever these say
    if (hasStoredBin(node)) return !node.asDrawable();
    if (!_frame.isKnown()) return false;
    if (!_ground.empty()) return node.getName() == _ground && !node.asDrawable() && isFixedMesh(node);
    if (isTerrainTile(node)) return true;
    if (dynamic_cast<osg::PagedLOD*>(&node)) {
        const auto meshes = ownMeshes(node);
        for (const auto& mesh : meshes) {
            if (!isTerrainTile(*mesh) && !isFixedMesh(*mesh)) return false;
        }
        return !meshes.empty();
    }
    const bool isPlainGroup = typeid(node) == typeid(osg::Group) || typeid(node) == typeid(Carrier);
    return _frame.isBelowTile && !isPlainGroup && !node.asDrawable() && isFixedMesh(node);
}

// Scenes may nest groups far deeper than tiles; groups therefore use little stack.
void TileFinder::visit(osg::Node& node, bool isTile) {
    if (!isTile) return visitOther(node);
    if (_depth >= kDeepest) return visitTooDeep(node);
    const Scoped globe(_frame.ellipsoid, _frame.isKnown() ? _frame.ellipsoid : wgs84());
    FoundTile tile{&node, ownMeshes(node), _frame, _ordinal++, filesBelow(node, _frame.file)};
    if (!hasStoredBin(node)) tile.frame.ellipsoid = groundOf(tile);
    const Scoped scope(_tile, static_cast<const osg::Node*>(&node));
    const Scoped depth(_depth, _depth + 1);
    visitTile(tile);
}

void TileFinder::traverseBelow(osg::Node& node) {
    // A terrain tile that is traversed before it has its Terrain never finds it afterwards.
    if (isTerrainTile(node)) return;
    if (auto* paged = dynamic_cast<osg::PagedLOD*>(&node)) return traversePaged(*paged);
    // parts of a leaf are no leaves
    const Scoped below(_frame.isBelowTile, _frame.isBelowTile && _tile != &node);
    if (node.asTransform()) return traverseTransform(*node.asTransform());
    traverse(node);
}

// By itself, and the matrix alone, to leave stack for scenes that are nested deep.
void TileFinder::traverseTransform(osg::Transform& node) {
    const Scoped matrix(_frame.localToEcef, osgAnalyticBin::frameInside(node, _frame));
    traverse(node);
}

void TileFinder::traversePaged(osg::PagedLOD& node) {
    if (_depth >= kDeepest) return visitTooDeep(node);
    const bool isTile = _tile == &node;
    const Scoped depth(_depth, _depth + 1);
    for (unsigned int i = 0; i < node.getNumChildren(); ++i) {
        if (!isPaged(node, i)) {
            // a tile's own mesh is no tile beside it
            if (!isTile) node.getChild(i)->accept(*this);
            continue;
        }
        const Scoped frame(_frame, pagedFrame(_frame, node.getFileName(i), isTile));
        const Scoped<std::size_t> ordinal(_ordinal, 0);
        node.getChild(i)->accept(*this);
    }
}

std::vector<FoundTile> findTiles(osg::Node& node, const TileFrame& frame) {
    class Collector : public TileFinder {
    public:
        using TileFinder::TileFinder;
        std::vector<FoundTile> tiles;

    protected:
        void visitTile(FoundTile& tile) override {
            tiles.push_back(tile);
            traverseBelow(*tile.node);
        }
    };
    Collector collector(frame);
    node.accept(collector);
    return collector.tiles;
}

}  // namespace osgAnalyticBin
