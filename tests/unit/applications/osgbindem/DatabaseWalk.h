// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TestRaster.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>
#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/PagedLOD>

#include <array>
#include <functional>
#include <string>
#include <vector>

/// One tile of a database as OpenSceneGraph loads it.
struct LoadedTile {
    int level = 0;
    int x = 0;
    int y = 0;
    osg::ref_ptr<osg::Node> node;
    osg::ref_ptr<osg::Geometry> geometry;
    osgAnalyticBin::AnalyticBin bin;
    int cells = 0;
    /// In ECEF; the surface row by row from the south-west, then the skirts.
    std::vector<glm::dvec3> vertices;
    std::vector<LoadedTile> children;

    [[nodiscard]] Rect rect() const;
    [[nodiscard]] osg::PagedLOD* lod() const { return dynamic_cast<osg::PagedLOD*>(node.get()); }
    [[nodiscard]] const glm::dvec3& post(int column, int row) const {
        return vertices[static_cast<std::size_t>(row * (cells + 1) + column)];
    }
    [[nodiscard]] std::size_t surfaceCount() const { return static_cast<std::size_t>((cells + 1) * (cells + 1)); }
    [[nodiscard]] bool touchesPole() const { return y == 0 || y == (8 << level) - 1; }
};

struct LoadedDatabase {
    osg::ref_ptr<osg::CoordinateSystemNode> root;
    std::vector<LoadedTile> tiles;

    [[nodiscard]] osgAnalyticBin::core::Ellipsoid ellipsoid() const;
    void forEach(const std::function<void(const LoadedTile&)>& visit) const;
    [[nodiscard]] int deepestLevel() const;

    /// The tiles without children whose area has the position.
    [[nodiscard]] const LoadedTile& leafAt(double latitudeDeg, double longitudeDeg) const;

    /// Altitude of the drawn post nearest to the position.
    [[nodiscard]] double altitudeAt(double latitudeDeg, double longitudeDeg) const;
};

/// Loads all levels, by the file names that the PagedLODs would ask the pager for.
[[nodiscard]] LoadedDatabase loadDatabase(const std::string& rootFile);
