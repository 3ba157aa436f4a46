// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseWalk.h"

#include <glm/geometric.hpp>
#include <osg/MatrixTransform>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <cmath>
#include <stdexcept>

namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

void readMesh(LoadedTile& tile) {
    auto& transform = dynamic_cast<osg::MatrixTransform&>(*tile.node->asGroup()->getChild(0));
    tile.geometry = dynamic_cast<osg::Geometry*>(transform.getChild(0));
    if (!tile.geometry) throw std::runtime_error("a tile has no geometry");
    for (const osg::Vec3& v : dynamic_cast<osg::Vec3Array&>(*tile.geometry->getVertexArray())) {
        const osg::Vec3d ecef = osg::Vec3d(v) * transform.getMatrix();
        tile.vertices.emplace_back(ecef.x(), ecef.y(), ecef.z());
    }
    tile.cells = static_cast<int>(std::lround(std::sqrt(static_cast<double>(tile.vertices.size()) + 4.0))) - 3;
    tile.bin = osgAnalyticBin::storedBin(*tile.node);
}

LoadedTile loadTile(osg::Node& node, int level, int x, int y) {
    LoadedTile tile;
    tile.level = level;
    tile.x = x;
    tile.y = y;
    tile.node = &node;
    readMesh(tile);
    if (osg::PagedLOD* lod = tile.lod()) {
        const osg::ref_ptr<osg::Node> file = osgDB::readRefNodeFile(lod->getDatabasePath() + lod->getFileName(1));
        if (!file || file->asGroup() == nullptr || file->asGroup()->getNumChildren() != 4) {
            throw std::runtime_error("no four children in " + lod->getFileName(1));
        }
        for (unsigned int i = 0; i < 4; ++i) {
            tile.children.push_back(loadTile(*file->asGroup()->getChild(i), level + 1, 2 * x + static_cast<int>(i % 2),
                                             2 * y + static_cast<int>(i / 2)));
        }
    }
    return tile;
}

void visitAll(const LoadedTile& tile, const std::function<void(const LoadedTile&)>& visit) {
    visit(tile);
    for (const LoadedTile& child : tile.children) visitAll(child, visit);
}

}  // namespace

Rect LoadedTile::rect() const {
    const double size = std::ldexp(22.5, -level);
    return {-180.0 + x * size, -90.0 + y * size, -180.0 + (x + 1) * size, -90.0 + (y + 1) * size};
}

osgAnalyticBin::core::Ellipsoid LoadedDatabase::ellipsoid() const {
    return {root->getEllipsoidModel()->getRadiusEquator(), root->getEllipsoidModel()->getRadiusPolar()};
}

void LoadedDatabase::forEach(const std::function<void(const LoadedTile&)>& visit) const {
    for (const LoadedTile& tile : tiles) visitAll(tile, visit);
}

int LoadedDatabase::deepestLevel() const {
    int deepest = 0;
    forEach([&deepest](const LoadedTile& tile) { deepest = std::max(deepest, tile.level); });
    return deepest;
}

const LoadedTile& LoadedDatabase::leafAt(double latitudeDeg, double longitudeDeg) const {
    const LoadedTile* found = nullptr;
    forEach([&](const LoadedTile& tile) {
        const Rect r = tile.rect();
        if (tile.children.empty() && latitudeDeg >= r.south && latitudeDeg <= r.north && longitudeDeg >= r.west &&
            longitudeDeg <= r.east) {
            found = &tile;
        }
    });
    if (found == nullptr) throw std::runtime_error("no tile there");
    return *found;
}

double LoadedDatabase::altitudeAt(double latitudeDeg, double longitudeDeg) const {
    const LoadedTile& tile = leafAt(latitudeDeg, longitudeDeg);
    const auto target = ellipsoid().toEcef({latitudeDeg * kRadiansPerDegree, longitudeDeg * kRadiansPerDegree, 0.0});
    double nearest = HUGE_VAL;
    double altitude = 0.0;
    for (std::size_t i = 0; i < tile.surfaceCount(); ++i) {
        const auto position = ellipsoid().toGeodetic(tile.vertices[i]);
        const double distance = glm::distance(target, ellipsoid().toEcef({position.latitude, position.longitude, 0.0}));
        if (distance >= nearest) continue;
        nearest = distance;
        altitude = position.altitude;
    }
    return altitude;
}

LoadedDatabase loadDatabase(const std::string& rootFile) {
    osgDB::Registry::instance()->getLibraryFilePathList().push_front(OSGBINDEM_LIBRARY_FOLDER);
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(rootFile);
    LoadedDatabase database;
    database.root = dynamic_cast<osg::CoordinateSystemNode*>(node.get());
    if (!database.root || database.root->getNumChildren() == 0) throw std::runtime_error("no database in " + rootFile);
    for (unsigned int i = 0; i < database.root->getNumChildren(); ++i) {
        osg::Node& start = *database.root->getChild(i);
        const auto bin = osgAnalyticBin::storedBin(start).bin();
        const int level = static_cast<int>(
            std::lround(std::log2(22.5 * kRadiansPerDegree / (bin.latitude().upper - bin.latitude().lower))));
        const double size = std::ldexp(22.5 * kRadiansPerDegree, -level);
        const int columns = 16 << level;
        const int x = static_cast<int>(std::floor((bin.longitude().middle() + 8.0 * 22.5 * kRadiansPerDegree) / size));
        const int y = static_cast<int>(std::floor((bin.latitude().middle() + 4.0 * 22.5 * kRadiansPerDegree) / size));
        database.tiles.push_back(loadTile(start, level, (x + columns) % columns, y));
    }
    return database;
}
