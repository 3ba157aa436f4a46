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
struct PhotogrammetrySample {
    /// The level from which on the meshes have the towers.
    int towersFrom = 0;
    /// Two nodes have spheres that do not hold their vertices: a root, and one two levels below. The others hold those
    /// of all levels.
    bool hasFalseSpheres = true;
};

inline constexpr int kTilesPerSide = 3;
inline constexpr double kTileMetres = 200.0;
// Levels of detail of a tile. The finest are below a chain of single children, then four children each.
inline constexpr int kLevelsOfSet = 4;
inline constexpr int kChain = 2;  // levels with a single child
inline constexpr unsigned int kCells = 12;
inline constexpr double kTower = 90.0;  // metres above the ground
inline constexpr double kTowerSide = 12.0;
inline constexpr double kTowerSpacing = 160.0;
// A node is refined when its sphere is wider than this on the screen.
inline constexpr float kRefinePixels = 220.0F;

// Metres above the ground of the set's frame, at a place in it: towers are steps.
inline double heightAt(double x, double y, bool hasTowers) {
    const double ground = 12.0 * std::sin(x / 90.0) * std::cos(y / 120.0) + 15.0;
    const auto isInTower = [](double at) {
        const double inCell = at - kTowerSpacing * std::floor(at / kTowerSpacing);
        return inCell > 70.0 && inCell < 70.0 + kTowerSide;
    };
    return hasTowers && isInTower(x) && isInTower(y) ? ground + kTower : ground;
}

// A part of a tile, at one level: its file is named for the level and the number in it.
struct Part {
    int level = 0;
    int number = 0;
    double west = 0.0, south = 0.0, side = 0.0;
};

class SampleWriter {
public:
    SampleWriter(std::filesystem::path folder, const PhotogrammetrySample& sample)
        : _folder(std::move(folder)), _sample(sample) {}

    bool write() {
        std::error_code problem;
        for (int row = 0; row < kTilesPerSide; ++row) {
            for (int column = 0; column < kTilesPerSide; ++column) {
                _tile = tileName(column, row);
                std::filesystem::create_directories(_folder / "Data" / _tile, problem);
                const double west = (column - 0.5 * kTilesPerSide) * kTileMetres;
                const double south = (row - 0.5 * kTilesPerSide) * kTileMetres;
                if (problem || !writeFile({0, 0, west, south, kTileMetres})) return false;
            }
        }
        return true;
    }

private:
    static std::string tileName(int column, int row) {
        char name[32];
        std::snprintf(name, sizeof name, "Tile_+%03d_+%03d", column, row);
        return name;
    }

    [[nodiscard]] std::string fileName(const Part& part) const {
        if (part.level == 0) return _tile + ".osgb";
        return _tile + "_L" + std::to_string(part.level) + "_" + std::to_string(part.number) + ".osgb";
    }

    [[nodiscard]] bool isLast(const Part& part) const { return part.level + 1 >= kLevelsOfSet; }

    // The parts that are in one file with this one: itself and its siblings.
    [[nodiscard]] static std::vector<Part> partsOfFile(const Part& first) {
        if (first.level < kChain) return {first};
        std::vector<Part> parts;
        const double half = first.side / 2.0;
        for (int i = 0; i < 4; ++i)
            parts.push_back(
                {first.level, 4 * first.number + i, first.west + (i % 2) * half, first.south + (i / 2) * half, half});
        return parts;
    }

    // All parts of a file, in a group where there are several, and the files below. `area`: what the file covers.
    bool writeFile(const Part& area) {
        const std::vector<Part> parts = partsOfFile(area);
        osg::ref_ptr<osg::Node> root;
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        for (const Part& part : parts) group->addChild(nodeOf(part));
        root = parts.size() == 1 ? group->getChild(0) : group.get();
        const std::string path = (_folder / "Data" / _tile / fileName(area)).string();
        if (!osgDB::writeNodeFile(*root, path)) return false;
        return std::all_of(parts.begin(), parts.end(),
                           [this](const Part& part) { return isLast(part) || writeFile(below(part)); });
    }

    static Part below(const Part& part) { return {part.level + 1, part.number, part.west, part.south, part.side}; }

    osg::ref_ptr<osg::Node> nodeOf(const Part& part) {
        const osg::ref_ptr<osg::PagedLOD> node = new osg::PagedLOD;
        const osg::ref_ptr<osg::Geode> mesh = meshOf(part);
        node->addChild(mesh);
        const osg::BoundingSphere sphere = sphereOf(part);
        node->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        node->setCenter(sphere.center());
        node->setRadius(sphere.radius());
        node->setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
        node->setRange(0, 0.0F, isLast(part) ? FLT_MAX : kRefinePixels);
        if (isLast(part)) return node;
        node->setRange(1, kRefinePixels, FLT_MAX);
        node->setFileName(1, fileName(below(part)));
        return node;
    }

    // About the vertices of all levels, which are among those of the finest. A false sphere holds those in its middle.
    [[nodiscard]] osg::BoundingSphere sphereOf(const Part& part) const {
        const int steps = int(2 * kCells) << std::max(0, kLevelsOfSet - 1 - std::max(part.level, kChain));
        const int all = part.level < kChain ? 2 * steps : steps;
        osg::BoundingBox box;
        for (int row = 0; row <= all; ++row) {
            for (int column = 0; column <= all; ++column) {
                const double x = part.west + column * part.side / all;
                const double y = part.south + row * part.side / all;
                for (const bool hasTowers : {false, true}) box.expandBy(osg::Vec3d(x, y, heightAt(x, y, hasTowers)));
            }
        }
        const bool isFalseRoot = _tile == "Tile_+001_+001" && part.level == 0;
        const bool isFalsePart = _tile == "Tile_+000_+001" && part.level == 2 && part.number == 0;
        const float share = _sample.hasFalseSpheres && (isFalseRoot || isFalsePart) ? 0.35F : 1.0F;
        return {box.center(), share * box.radius()};
    }

    // The height field, finer along the chain; towers are steep slopes in it.
    osg::ref_ptr<osg::Geode> meshOf(const Part& part) {
        const unsigned int cells = kCells << std::max(0, std::min(part.level, kChain) - 1);
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        const double step = part.side / cells;
        for (unsigned int row = 0; row <= cells; ++row) {
            for (unsigned int column = 0; column <= cells; ++column) {
                const double x = part.west + column * step;
                const double y = part.south + row * step;
                vertices->push_back(osg::Vec3d(x, y, heightAt(x, y, part.level >= _sample.towersFrom)));
            }
        }
        const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(makeGeometry(vertices, gridTriangles<osg::DrawElementsUShort>(cells + 1)));
        return geode;
    }

    const std::filesystem::path _folder;
    const PhotogrammetrySample& _sample;
    std::string _tile;
};

/// Writes the tiles of the set into a folder that exists. Returns: false when they cannot be written.
[[nodiscard]] inline bool writePhotogrammetrySample(const std::string& folder,
                                                    const PhotogrammetrySample& sample = {}) {
    return SampleWriter(folder, sample).write();
}

}  // namespace osgAnalyticBin::test
