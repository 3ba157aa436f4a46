// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterCulling.h"

#include "ClusterRemover.h"
#include "CullMethod.h"
#include "DepthRaster.h"
#include "GlmBridge.h"
#include "TileOccluder.h"

#include <osg/ClusterCullingCallback>
#include <osg/PagedLOD>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <array>
#include <optional>
#include <typeinfo>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {

namespace {

// Of the grids, along an edge of a tile.
constexpr std::array<int, 3> kCells{4, 8, 16};
// Of a cell; smaller ones cost more than they hide.
constexpr float kPixels = 6.0F;

/// On a tile, in front of its other callbacks: what the walk needs to know, and what it has found.
class RasterTile final : public osg::Callback {
public:
    RasterTile(std::vector<OccluderGrid> occluders, const std::optional<std::array<glm::dvec3, 8>>& corners,
               osg::ClusterCullingCallback* cluster)
        : grids(std::move(occluders)), box(corners), _cluster(cluster) {}

    bool run(osg::Object* node, osg::Object* data) override {
        return data->asNodeVisitor()->getTraversalNumber() == _hiddenIn || traverse(node, data);
    }

    void hide(const osg::NodeVisitor& visitor) { _hiddenIn = visitor.getTraversalNumber(); }
    void show() { _hiddenIn = 0; }

    [[nodiscard]] bool isBehindGlobe(osg::NodeVisitor& visitor) const {
        return _cluster && _cluster->cull(&visitor, nullptr, nullptr);
    }

    const std::vector<OccluderGrid> grids;  // coarse ones first
    const std::optional<std::array<glm::dvec3, 8>> box;

private:
    osg::ref_ptr<osg::ClusterCullingCallback> _cluster;
    unsigned int _hiddenIn = 0;  // the traversal's number; the first is 1
};

RasterTile* rasterTileOf(osg::Node& node) {
    osg::Callback* const callback = node.getCullCallback();
    return callback && typeid(*callback) == typeid(RasterTile) ? static_cast<RasterTile*>(callback) : nullptr;
}

std::vector<OccluderGrid> gridsOf(const FoundTile& tile, const core::Ellipsoid& ellipsoid) {
    const auto surface = surfaceOf(verticesOf(tile), ellipsoid);
    if (!surface) return {};
    std::vector<OccluderGrid> grids;
    for (const int cells : kCells)
        if (std::optional<OccluderGrid> grid = occluderOf(surface->vertices, surface->middle, ellipsoid, cells))
            grids.push_back(std::move(*grid));
    return grids;
}

bool prepare(const FoundTile& tile) {
    if (rasterTileOf(*tile.node)) return false;
    const core::Ellipsoid ellipsoid = toCore(*tile.frame.ellipsoid);
    std::optional<std::array<glm::dvec3, 8>> box;
    const AnalyticBin bin = hasStoredBin(*tile.node) ? storedBin(*tile.node) : AnalyticBin();
    if (bin.valid()) box = boxCorners(bin, ellipsoid);
    const osg::ref_ptr<RasterTile> prepared =
        new RasterTile(gridsOf(tile, ellipsoid), box, clusterCallbackOf(*tile.node));
    prepared->setNestedCallback(tile.node->getCullCallback());
    tile.node->setCullCallback(prepared);
    return true;
}

/// From ECEF to the picture. Numbers near the eye are floats: they are relative to a point that is transformed first.
class Projection {
public:
    explicit Projection(const osg::Matrixd& worldToClip) : _toClip(worldToClip) {
        for (std::size_t k = 0; k < kClip.size(); ++k)
            for (int i = 0; i < 3; ++i) _columns[k][i] = static_cast<float>(worldToClip(i, kClip[k]));
    }

    [[nodiscard]] ClipPoint at(const glm::dvec3& ecef) const {
        std::array<float, 3> clip;
        for (std::size_t k = 0; k < 3; ++k)
            clip[k] = static_cast<float>(ecef.x * _toClip(0, kClip[k]) + ecef.y * _toClip(1, kClip[k]) +
                                         ecef.z * _toClip(2, kClip[k]) + _toClip(3, kClip[k]));
        return {clip[0], clip[1], clip[2]};
    }

    /// Pixels of the depth buffer that a length takes at that length's distance.
    [[nodiscard]] float scale() const { return 0.5F * kRasterWidth * glm::length(_columns[0]); }

    [[nodiscard]] ClipPoint from(const ClipPoint& origin, const glm::vec3& offset) const {
        return {origin.x + glm::dot(_columns[0], offset), origin.y + glm::dot(_columns[1], offset),
                origin.w + glm::dot(_columns[2], offset)};
    }

private:
    static constexpr std::array<int, 3> kClip{0, 1, 3};  // x, y, w

    osg::Matrixd _toClip;
    std::array<glm::vec3, 3> _columns;
};

/// One walk before one cull traversal.
class Walk {
public:
    Walk(osgUtil::CullVisitor& visitor, DepthRaster& raster)
        : _visitor(visitor),
          _raster(raster),
          _eye(visitor.getEyeLocal()),
          _projection(*visitor.getModelViewMatrix() * *visitor.getProjectionMatrix()) {}

    void visitChildren(osg::Group& group) {
        std::vector<std::pair<float, osg::Node*>> children;
        for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
            osg::Node& child = *group.getChild(i);
            const osg::BoundingSphere& bound = child.getBound();
            children.emplace_back((bound.center() - _eye).length() - bound.radius(), &child);
        }
        std::sort(children.begin(), children.end());
        for (const auto& child : children) visit(*child.second);
    }

private:
    void visit(osg::Node& node) {
        if (!_visitor.validNodeMask(node) || _visitor.isCulled(node)) return;
        RasterTile* const tile = rasterTileOf(node);
        if (tile && isHidden(*tile)) return;
        osg::Group* const finer = finerTilesOf(node, tile != nullptr);
        if (finer)
            visitChildren(*finer);
        else if (tile && !tile->grids.empty())
            drawFitting(tile->grids);
    }

    bool isHidden(RasterTile& tile) {
        tile.show();
        if (tile.isBehindGlobe(_visitor)) return true;
        if (!tile.box) return false;
        std::array<ClipPoint, 8> corners;
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = _projection.at((*tile.box)[i]);
        if (!_raster.hides(corners)) return false;
        tile.hide(_visitor);
        return true;
    }

    // What is shown in place of a tile, as osg::PagedLOD chooses; null: the tile itself. Other groups are entered, but
    // not such as stand in other frames.
    osg::Group* finerTilesOf(osg::Node& node, bool isTile) const {
        auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        if (!paged) return isTile || node.asTransform() ? nullptr : node.asGroup();
        if (paged->getRangeMode() != osg::LOD::DISTANCE_FROM_EYE_POINT) return nullptr;
        const float distance = _visitor.getDistanceToViewPoint(paged->getCenter(), true);
        for (unsigned int i = paged->getNumChildren(); i-- > 0;) {
            const bool isInRange = paged->getMinRange(i) <= distance && distance < paged->getMaxRange(i);
            if (isInRange && !paged->getFileName(i).empty()) return paged->getChild(i)->asGroup();
        }
        return nullptr;
    }

    // Cells need not be smaller than some pixels.
    void drawFitting(const std::vector<OccluderGrid>& grids) {
        const ClipPoint origin = _projection.at(grids.front().origin);
        const float length = glm::distance(grids.front().nodes.front(), grids.front().nodes.back());
        const float pixels = _projection.scale() * length / std::max(origin.w, length);
        std::size_t fitting = 0;
        while (fitting + 1 < grids.size() && static_cast<float>(grids[fitting + 1].cells) * kPixels < pixels) ++fitting;
        draw(grids[fitting], origin);
    }

    void draw(const OccluderGrid& grid, const ClipPoint& origin) {
        _nodes.clear();
        for (const glm::vec3& node : grid.nodes) _nodes.push_back(_projection.from(origin, node));
        const auto cells = static_cast<std::size_t>(grid.cells);
        for (std::size_t row = 0; row < cells; ++row) {
            for (std::size_t column = 0; column < cells; ++column) {
                const std::size_t i = row * (cells + 1) + column;
                _raster.draw(_nodes[i], _nodes[i + 1], _nodes[i + cells + 2]);
                _raster.draw(_nodes[i], _nodes[i + cells + 2], _nodes[i + cells + 1]);
            }
        }
    }

    osgUtil::CullVisitor& _visitor;
    DepthRaster& _raster;
    const osg::Vec3f _eye;
    const Projection _projection;
    std::vector<ClipPoint> _nodes;
};

/// On the root: walks before the traversal goes on.
class RasterRoot final : public osg::Callback {
public:
    RasterRoot(int width, int height) : _raster(width, height) {}

    bool run(osg::Object* node, osg::Object* data) override {
        osgUtil::CullVisitor* const visitor = data->asNodeVisitor()->asCullVisitor();
        double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, nearest = 0.0, farthest = 0.0;
        const bool isPerspective =
            visitor && visitor->getProjectionMatrix()->getFrustum(left, right, bottom, top, nearest, farthest);
        if (isPerspective) {
            _raster.clear(static_cast<float>(nearest));
            Walk(*visitor, _raster).visitChildren(*node->asNode()->asGroup());
        }
        return traverse(node, data);
    }

private:
    DepthRaster _raster;
};

}  // namespace

void addPeers() {
    peers() = {prepareRasterTiles, installRaster};
}

std::size_t prepareRasterTiles(osg::Node& graph, const osg::EllipsoidModel* pageOf) {
    const std::vector<FoundTile> tiles = tilesOnGlobe(graph, pageOf);
    return static_cast<std::size_t>(std::count_if(tiles.begin(), tiles.end(), prepare));
}

void installRaster(osg::Node& root, int width, int height) {
    const int rasterHeight = std::max(1, kRasterWidth * height / width);
    if (root.asGroup()) root.addCullCallback(new RasterRoot(kRasterWidth, rasterHeight));
}

}  // namespace osgAnalyticBin::bench
