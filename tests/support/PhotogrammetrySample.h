// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/PagedLOD>
#include <osgDB/WriteFile>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <filesystem>
#include <string>
#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

/// A set of oblique photogrammetry as ContextCapture lays it out, made by a formula: hills with towers.
class PhotogrammetrySample {
public:
    /// `hasFalseSpheres`: two nodes have spheres that do not hold their vertices: a root, and one two levels below. The
    /// others hold those of all levels.
    PhotogrammetrySample(std::filesystem::path folder, bool hasFalseSpheres)
        : _folder(std::move(folder)), _hasFalseSpheres(hasFalseSpheres) {}

    /// Writes the tiles into the folder, which exists. Returns: false when they cannot be written.
    [[nodiscard]] bool write() {
        constexpr int kTilesPerSide = 3;
        std::error_code problem;
        for (int row = 0; row < kTilesPerSide; ++row) {
            for (int column = 0; column < kTilesPerSide; ++column) {
                _tile = "Tile_+00" + std::to_string(column) + "_+00" + std::to_string(row);
                std::filesystem::create_directories(_folder / "Data" / _tile, problem);
                const double west = (column - 0.5 * kTilesPerSide) * kTileMetres;
                const double south = (row - 0.5 * kTilesPerSide) * kTileMetres;
                if (problem || !writeFile({0, 0, west, south, kTileMetres})) return false;
            }
        }
        return true;
    }

private:
    static constexpr double kTileMetres = 200.0;
    // Levels of detail of a tile. The finest are below a chain of single children, then four children each.
    static constexpr int kLast = 3;
    static constexpr int kChain = 2;  // levels with a single child
    static constexpr unsigned int kCells = 12;
    // A node is refined when its sphere is wider than this on the screen.
    static constexpr float kRefinePixels = 220.0F;

    // A part of a tile, at one level: its file is named for the level and the number in it.
    struct Part {
        int level = 0;
        int number = 0;
        double west = 0.0, south = 0.0, side = 0.0;
    };

    [[nodiscard]] std::string fileName(int level, int number) const {
        if (level == 0) return _tile + ".osgb";
        return _tile + "_L" + std::to_string(level) + "_" + std::to_string(number) + ".osgb";
    }

    // All parts of a file, in a group where there are several, and the files below. `area`: what the file covers.
    bool writeFile(const Part& area) {
        std::vector<Part> parts{area};
        if (area.level >= kChain) {
            parts.clear();
            const double half = area.side / 2.0;
            for (int i = 0; i < 4; ++i)
                parts.push_back(
                    {area.level, 4 * area.number + i, area.west + (i % 2) * half, area.south + (i / 2) * half, half});
        }
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        for (const Part& part : parts) group->addChild(nodeOf(part));
        const osg::Node& root = parts.size() == 1 ? *group->getChild(0) : *group;
        const std::string path = (_folder / "Data" / _tile / fileName(area.level, area.number)).string();
        return osgDB::writeNodeFile(root, path) && std::all_of(parts.begin(), parts.end(), [this](Part part) {
                   return ++part.level > kLast || writeFile(part);
               });
    }

    osg::ref_ptr<osg::Node> nodeOf(const Part& part) {
        const osg::ref_ptr<osg::PagedLOD> node = new osg::PagedLOD;
        const unsigned int cells = part.level < kChain ? kCells : 2 * kCells;
        const osg::ref_ptr<osg::Geode> mesh = new osg::Geode;
        mesh->addDrawable(makeGeometry(pointsOf(part, cells), gridTriangles<osg::DrawElementsUShort>(cells + 1)));
        node->addChild(mesh);
        const osg::BoundingSphere sphere = sphereOf(part);
        node->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        node->setCenter(sphere.center());
        node->setRadius(sphere.radius());
        node->setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
        node->setRange(0, 0.0F, part.level == kLast ? FLT_MAX : kRefinePixels);
        if (part.level == kLast) return node;
        node->setRange(1, kRefinePixels, FLT_MAX);
        node->setFileName(1, fileName(part.level + 1, part.number));
        return node;
    }

    // About the vertices of all levels, which are among those of the finest. A false sphere holds those in its middle.
    [[nodiscard]] osg::BoundingSphere sphereOf(const Part& part) const {
        constexpr double kFinest = kTileMetres / (8 * kCells);
        const auto points = pointsOf(part, static_cast<unsigned int>(std::lround(part.side / kFinest)));
        osg::BoundingBox box;
        for (const osg::Vec3& point : *points) box.expandBy(point);
        const bool isFalseRoot = _tile == "Tile_+001_+001" && part.level == 0;
        const bool isFalsePart = _tile == "Tile_+000_+001" && part.level == 2 && part.number == 0;
        return {box.center(), (_hasFalseSpheres && (isFalseRoot || isFalsePart) ? 0.35F : 1.0F) * box.radius()};
    }

    // The height field: hills, and towers, which are steep slopes in it.
    [[nodiscard]] static osg::ref_ptr<osg::Vec3Array> pointsOf(const Part& part, unsigned int cells) {
        constexpr double kTower = 90.0, kTowerSide = 12.0, kTowerSpacing = 160.0;  // metres
        const auto isInTower = [](double at) {
            const double inCell = at - kTowerSpacing * std::floor(at / kTowerSpacing);
            return inCell > 70.0 && inCell < 70.0 + kTowerSide;
        };
        const osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
        for (unsigned int row = 0; row <= cells; ++row) {
            for (unsigned int column = 0; column <= cells; ++column) {
                const double x = part.west + column * part.side / cells, y = part.south + row * part.side / cells;
                const double ground = 12.0 * std::sin(x / 90.0) * std::cos(y / 120.0) + 15.0;
                points->push_back(osg::Vec3d(x, y, isInTower(x) && isInTower(y) ? ground + kTower : ground));
            }
        }
        return points;
    }

    const std::filesystem::path _folder;
    const bool _hasFalseSpheres;
    std::string _tile;
};

}  // namespace osgAnalyticBin::test
