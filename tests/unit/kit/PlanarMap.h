// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A small database of a map, built as VirtualPlanetBuilder builds them: a quadtree of four levels, each tile's four
// parts in a file of their own, skirts below the border of every tile.

#pragma once

#include "TileFixture.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>
#include <osgDB/WriteFile>
#include <osgTerrain/Locator>

#include <stdexcept>
#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

inline constexpr const char* kUtm = "PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\"]]";

struct PlanarMap {
    bool isTerrain = true;  // osgTerrain tiles, else geometry below a translation
    osg::Vec3d origin{500000.0, 4600000.0, 0.0};
    double size = 64000.0;
    double heightUnit = 1.0;  // metres in a map unit

    /// Map units, 0 to 2600 metres, at a post of a tile of this width. Only the finest tiles have peaks and pits.
    [[nodiscard]] double height(double x, double y, double width) const {
        const double u = (x - origin.x()) / size;
        const double v = (y - origin.y()) / size;
        // peaks and pits that no coarser tile has a post on
        const long number = std::lround((u + 3.0 * v) * kPostsAcross);
        const bool isFinest = width < 1.5 * size / (1 << (kLevels - 1));
        const double metres = isFinest && number % 2 != 0 ? (number % 4 == 1 ? 2600.0 : 0.0)
                                                          : 1300.0 + 300.0 * std::sin(9.0 * u) * std::cos(7.0 * v);
        return metres / heightUnit;
    }

    /// Writes all files but the root's into the folder. Returns: the root, ready for paging.
    [[nodiscard]] osg::ref_ptr<osg::CoordinateSystemNode> build(const std::string& folder) const {
        osg::ref_ptr<osg::CoordinateSystemNode> root =
            isTerrain ? new osgTerrain::Terrain : new osg::CoordinateSystemNode;
        root->setFormat("WKT");
        root->setCoordinateSystem(kUtm);
        root->addChild(tile(folder, 0, 0, 0));
        return root;
    }

    /// One tile without children.
    [[nodiscard]] osg::ref_ptr<osg::Node> mesh(int level, int x, int y) const {
        const Square square = squareOf(level, x, y);
        return isTerrain ? terrainTile(square) : polygonalTile(square);
    }

private:
    static constexpr int kLevels = 4;
    static constexpr unsigned int kPosts = 9;
    // of the finest level
    static constexpr double kPostsAcross = (kPosts - 1) * (1 << (kLevels - 1));
    static constexpr double kSkirtRatio = 0.02;

    struct Square {
        double x, y, width;

        [[nodiscard]] double postX(unsigned int i) const { return x + width * i / (kPosts - 1); }
        [[nodiscard]] double postY(unsigned int j) const { return y + width * j / (kPosts - 1); }
        [[nodiscard]] double skirt() const { return kSkirtRatio * width * std::sqrt(0.5); }
    };

    [[nodiscard]] Square squareOf(int level, int x, int y) const {
        const double width = size / (1 << level);
        return {origin.x() + width * x, origin.y() + width * y, width};
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> terrainTile(const Square& square) const {
        const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
        locator->setEllipsoidModel(new osg::EllipsoidModel);  // as the builder does
        locator->setCoordinateSystemType(osgTerrain::Locator::PROJECTED);
        locator->setTransformAsExtents(square.x, square.y, square.x + square.width, square.y + square.width);
        const auto tile = makeTerrainTile(*locator, kPosts, kPosts, [&](unsigned int i, unsigned int j) {
            return static_cast<float>(height(square.postX(i), square.postY(j), square.width));
        });
        tile->setLocator(locator);
        heightsOf(*tile).setSkirtHeight(static_cast<float>(square.skirt()));
        return tile;
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> polygonalTile(const Square& square) const {
        const osg::Vec3d middle(square.x + 0.5 * square.width, square.y + 0.5 * square.width, 0.0);
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (unsigned int j = 0; j < kPosts; ++j) {
            for (unsigned int i = 0; i < kPosts; ++i) {
                const double x = square.postX(i);
                const double y = square.postY(j);
                vertices->push_back(osg::Vec3d(x, y, height(x, y, square.width)) - middle);
            }
        }
        const osg::ref_ptr<osg::DrawElementsUInt> skirt = new osg::DrawElementsUInt(GL_QUAD_STRIP);
        std::vector<unsigned int> border = gridBorder(kPosts);
        border.push_back(border.front());
        for (const unsigned int at : border) {
            skirt->push_back(at);
            skirt->push_back(static_cast<unsigned int>(vertices->size()));
            vertices->push_back((*vertices)[at] - osg::Vec3(0.0f, 0.0f, static_cast<float>(square.skirt())));
        }
        const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(vertices, gridTriangles(kPosts));
        geometry->addPrimitiveSet(skirt);
        const osg::ref_ptr<osg::MatrixTransform> transform = placed(geometry, osg::Matrixd::translate(middle));
        transform->setDataVariance(osg::Object::STATIC);
        return transform;
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> tile(const std::string& folder, int level, int x, int y) const {
        const osg::ref_ptr<osg::Node> own = mesh(level, x, y);
        if (level == kLevels - 1) return own;
        const osg::ref_ptr<osg::Group> parts = new osg::Group;
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) parts->addChild(tile(folder, level + 1, 2 * x + i, 2 * y + j));
        const std::string name =
            "L" + std::to_string(level) + "_X" + std::to_string(x) + "_Y" + std::to_string(y) + ".osgb";
        if (!osgDB::writeNodeFile(*parts, folder + "/" + name)) throw std::runtime_error("cannot write " + name);

        const Square square = squareOf(level, x, y);
        const auto cutOff = static_cast<float>(2.0 * square.width);
        const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
        // the tightest sphere about all heights
        const double middle = 1300.0 / heightUnit;
        paged->setCenter(osg::Vec3d(square.x + 0.5 * square.width, square.y + 0.5 * square.width, middle));
        paged->setRadius(static_cast<float>(std::hypot(std::sqrt(0.5) * square.width, middle)));
        paged->addChild(own, cutOff, 1e10f);
        paged->setFileName(1, name);
        paged->setRange(1, 0.0f, cutOff);
        paged->setDatabasePath(folder + "/");
        return paged;
    }
};

}  // namespace osgAnalyticBin::test
