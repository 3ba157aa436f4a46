// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Random terrain in tiles, an eye above it, and the truth about what the eye sees: rays in long double.

#pragma once

#include "MeshSamples.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <functional>

namespace osgAnalyticBin::test {

/// Triangles, sorted into boxes within boxes.
class TriangleTree {
public:
    TriangleTree() = default;
    explicit TriangleTree(std::vector<Triangle> triangles);

    [[nodiscard]] const std::vector<Triangle>& triangles() const { return _triangles; }

    /// Whether `meets` holds for a triangle, of those whose boxes the segment meets, roundings included.
    [[nodiscard]] bool any(const glm::dvec3& from, const glm::dvec3& to,
                           const std::function<bool(const Triangle&)>& meets) const;

private:
    struct Box {
        glm::dvec3 least, greatest;
        std::size_t first, last;  // triangles
        std::size_t second;       // the second of the boxes in it, the first one follows it; 0: none
    };
    void divide(std::size_t first, std::size_t last);

    std::vector<Triangle> _triangles;
    std::vector<Box> _boxes;
};

/// One of core::EarthColumns.
struct EarthColumn {
    std::array<glm::dvec3, 4> top, bottom;
    double error = 0.0;
};
[[nodiscard]] EarthColumn columnOf(const core::EarthColumns& columns, std::size_t i);
[[nodiscard]] core::EarthColumns columnsOf(const EarthColumn& column);

/// A tile of the terrain.
struct GroundTile {
    core::EcefMesh mesh;
    core::GeodeticBin bin;
};

/// Tiles side by side. Where neighbours have different posts their edges differ, and skirts hang from all of them.
struct OcclusionScene {
    /// `hasSpikes`: needles and pits in some scenes. `isMap`: in the plane of a map, else on a globe.
    explicit OcclusionScene(Random& random, bool hasSpikes = true, bool isMap = false);

    /// Whether the surface or a skirt is between the eye and the point.
    [[nodiscard]] bool isBlocked(const RealVector& point) const;
    /// A point of the tile's bin, often of its mesh.
    [[nodiscard]] RealVector pointIn(Random& random, const GroundTile& tile) const;
    /// A point on the top of the tile's bin.
    [[nodiscard]] RealVector topOf(Random& random, const GroundTile& tile) const;

    core::Ellipsoid ellipsoid;
    std::vector<GroundTile> tiles;
    TriangleTree triangles;  // of all tiles, skirts included
    glm::dvec3 eye, forward, up;
};

/// What the camera sees, in units of the picture.
constexpr core::Interval kAcross{-1.0, 1.0};

/// Of the camera: right, forward, up.
[[nodiscard]] core::Frame frameOf(const OcclusionScene& scene);

/// A buffer for the camera, without earth. `eyes`: metres that the eye may be away from its place, along each axis.
[[nodiscard]] core::HorizonBuffer bufferOf(const OcclusionScene& scene, const glm::dvec3& eyes = glm::dvec3(0.0));

/// How far eyes may be away from the scene's place, along each axis of the camera: farther ahead than aside, as of a
/// camera that flies on.
[[nodiscard]] glm::dvec3 randomEyes(Random& random, const OcclusionScene& scene);

/// Moves the eye to a random place in such a box about the frame's origin, often to one of its sides. Returns: whether
/// it is above the ground there; an eye below it looks through the backs of faces.
[[nodiscard]] bool moveEye(OcclusionScene& scene, Random& random, const core::Frame& frame, const glm::dvec3& eyes);

/// Adds the columns of cells of the tile, `cells` a side. Their depth is a share of the distance from the eye.
void addTile(core::HorizonBuffer& buffer, const OcclusionScene& scene, const GroundTile& tile, std::size_t cells,
             std::uint32_t owner = 0);

/// A quarter of a tile, or a part of one, with its outline in the buffer's picture.
struct OutlinedPart {
    GroundTile part;  ///< without a mesh
    core::HorizonBuffer::Outline outline;
};

/// The quarters of all tiles and their parts, up to the tops of their meshes, the nearest first: so the buffer has to
/// be asked.
[[nodiscard]] std::vector<OutlinedPart> frontToBack(const OcclusionScene& scene, const core::HorizonBuffer& buffer);

[[nodiscard]] bool isBeforeTheCamera(const OcclusionScene& scene, const RealVector& point);

/// Whether a line from one point to another meets the triangle between them.
[[nodiscard]] bool meets(const Triangle& triangle, const RealVector& from, const RealVector& to);

}  // namespace osgAnalyticBin::test
