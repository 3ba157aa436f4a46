// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TestRaster.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>
#include <osg/CoordinateSystemNode>
#include <osg/Geometry>
#include <osg/PagedLOD>

/// One tile of a database as OpenSceneGraph loads it.
struct LoadedTile {
    int level = 0;
    int x = 0;
    int y = 0;
    osg::ref_ptr<osg::Node> node;
    osg::ref_ptr<osg::Geometry> geometry;
    osgAnalyticBin::AnalyticBin bin;
    int cells = 0;
    /// In ECEF; the surface row by row from the south-west, then the skirts: south, north, west, east.
    std::vector<glm::dvec3> vertices;
    std::vector<LoadedTile> children;

    [[nodiscard]] Rect rect() const;
    [[nodiscard]] osg::PagedLOD* lod() const { return dynamic_cast<osg::PagedLOD*>(node.get()); }
    [[nodiscard]] const osgAnalyticBin::core::Interval& altitude() const { return bin.bin().altitude(); }
    [[nodiscard]] const glm::dvec3& post(int column, int row) const {
        return vertices[static_cast<std::size_t>(row * (cells + 1) + column)];
    }
    /// The lower end of the western skirt below a post.
    [[nodiscard]] const glm::dvec3& westHem(int row) const {
        return vertices[surfaceCount() + static_cast<std::size_t>(2 * (cells + 1) + row)];
    }
    [[nodiscard]] std::size_t surfaceCount() const { return static_cast<std::size_t>((cells + 1) * (cells + 1)); }
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

/// The heights that the bin of a tile has to hold.
using SourceRange = std::function<Range(const Rect&)>;

/// Everything that holds for every database; failures are reported as GoogleTest failures.
void checkDatabase(const LoadedDatabase& database, const SourceRange& source);
void checkDatabase(const LoadedDatabase& database, const TestRaster& source);

/// Tiles of one level draw their common posts at the same points, round the globe; children draw their parent's posts.
void checkSharedPosts(const LoadedDatabase& database);

/// The nodes are those that a database is made of, and OpenSceneGraph's own bounds hold.
void checkNodes(const LoadedDatabase& database);
