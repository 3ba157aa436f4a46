// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Random terrain in tiles, an eye above it, and the truth about what the eye sees: rays in long double.

#pragma once

#include "MeshSamples.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/common.hpp>

#include <utility>

namespace osgAnalyticBin::test {

using core::HorizonBuffer;

/// Triangles, sorted into boxes within boxes.
class TriangleTree {
public:
    TriangleTree() = default;
    explicit TriangleTree(std::vector<Triangle> triangles) : _triangles(std::move(triangles)) {
        divide(0, _triangles.size());
    }

    /// Whether `meets` holds for a triangle, of those whose boxes the segment meets, roundings included.
    template <class Meets>
    [[nodiscard]] bool any(const glm::dvec3& from, const glm::dvec3& to, const Meets& meets,
                           std::size_t number = 0) const {
        const Box& box = _boxes[number];
        if (!box.isMet(from, to - from)) return false;
        if (box.second != 0) return any(from, to, meets, number + 1) || any(from, to, meets, box.second);
        return std::any_of(at(box.first), at(box.last), meets);
    }

private:
    struct Box {
        glm::dvec3 least, greatest;
        std::size_t first, last;  // triangles
        std::size_t second;       // the second of the boxes in it, the first one follows it; 0: none

        // a line in a plane of the box gives NaN, which counts as within
        [[nodiscard]] bool isMet(const glm::dvec3& from, const glm::dvec3& along) const {
            constexpr double kRounding = 1e-9;
            double enters = -kRounding, leaves = 1.0 + kRounding;
            for (int axis = 0; axis < 3; ++axis) {
                const double a = (least[axis] - from[axis]) / along[axis];
                const double b = (greatest[axis] - from[axis]) / along[axis];
                if (std::min(a, b) > enters) enters = std::min(a, b);
                if (std::max(a, b) < leaves) leaves = std::max(a, b);
            }
            return !(enters > leaves + kRounding);
        }
    };

    [[nodiscard]] std::vector<Triangle>::const_iterator at(std::size_t i) const {
        return _triangles.begin() + static_cast<std::ptrdiff_t>(i);
    }

    void divide(std::size_t first, std::size_t last) {
        constexpr std::size_t kMost = 4;
        constexpr double kRounding = 1e-12;
        glm::dvec3 least(HUGE_VAL), greatest(-HUGE_VAL);
        for (std::size_t i = first; i < last; ++i) {
            const auto& [a, b, c] = _triangles[i];
            least = glm::min(least, glm::min(a, glm::min(b, c)));
            greatest = glm::max(greatest, glm::max(a, glm::max(b, c)));
        }
        const glm::dvec3 room = kRounding * glm::max(glm::abs(least), glm::abs(greatest));
        const std::size_t number = _boxes.size();
        _boxes.push_back({least - room, greatest + room, first, last, 0});
        if (last - first <= kMost) return;
        const glm::dvec3 size = greatest - least;
        const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        const auto place = [axis](const Triangle& t) { return t.a[axis] + t.b[axis] + t.c[axis]; };
        const auto begin = _triangles.begin();
        const std::size_t middle = (first + last) / 2;
        std::nth_element(begin + std::ptrdiff_t(first), begin + std::ptrdiff_t(middle), begin + std::ptrdiff_t(last),
                         [&](const Triangle& a, const Triangle& b) { return place(a) < place(b); });
        divide(first, middle);
        _boxes[number].second = _boxes.size();
        divide(middle, last);
    }

    std::vector<Triangle> _triangles;
    std::vector<Box> _boxes;
};

/// One of core::EarthColumns.
struct EarthColumn {
    std::array<glm::dvec3, 4> top, bottom;
    double error = 0.0;
};

/// A tile of the terrain.
struct GroundTile {
    EcefMesh mesh;
    GeodeticBin bin;
};

/// What the camera sees, in units of the picture.
constexpr Interval kAcross{-1.0, 1.0};

/// A quarter of a tile, or a part of one, with its outline in the buffer's picture.
struct OutlinedPart {
    GroundTile part;  ///< without a mesh
    HorizonBuffer::Outline outline;
};

constexpr int kTilesAcross = 6;
constexpr std::uint32_t kMostCells = 16;  // of a tile, at most

// Where the tiles lie, and how rough they are.
struct Land {
    double size, width;          // of a tile, in latitude and longitude, radians
    double southmost, westmost;  // radians
    double metres, height;       // of a tile's side; of the hills
    double spikes;               // the share of posts that are needles or pits
};

// Heights everywhere, of any roughness.
class Relief {
public:
    Relief(Random& random, double size, double height) {
        const double roughness = random.uniform(0.3, 0.7);
        for (std::size_t i = 0; i < kWaves; ++i) {
            const double wave = size * std::pow(roughness, static_cast<double>(i / 3));
            const double bearing = random.uniform(0.0, 6.283);
            _waves[i] = {6.283 / wave * std::sin(bearing), 6.283 / wave * std::cos(bearing), random.uniform(0.0, 6.283),
                         height * std::pow(roughness, static_cast<double>(i / 3))};
        }
    }
    [[nodiscard]] double at(double latitude, double longitude) const {
        double sum = 0.0;
        for (const auto& [north, east, phase, height] : _waves)
            sum += height * std::sin(north * latitude + east * longitude + phase);
        return sum;
    }

private:
    static constexpr std::size_t kWaves = 15;
    struct Wave {
        double north, east, phase, height;
    };
    std::array<Wave, kWaves> _waves{};
};

inline GroundTile makeTile(Random& random, const Ellipsoid& ellipsoid, const Land& land, const Relief& relief, int row,
                           int column, std::uint32_t cells) {
    const double south = land.southmost + row * land.size, west = land.westmost + column * land.width;
    const Interval latitude{south, south + land.size}, longitude{west, west + land.width};
    GroundTile tile;
    tile.mesh = gridMesh(random, ellipsoid, GeodeticBin(latitude, longitude, {0.0, 0.0}), cells);
    for (std::size_t i = 0; i < tile.mesh.size(); ++i) {
        const auto at = static_cast<std::uint32_t>(i);
        const double p = south + land.size * (at / (cells + 1)) / cells;
        const double l = west + land.width * (at % (cells + 1)) / cells;
        double h = relief.at(p, l);
        if (random.chance(land.spikes)) h += random.sign() * land.height * random.uniform(0.0, 5.0);
        const glm::dvec3 v = ellipsoid.toEcef({p, l, h});
        tile.mesh.x[i] = v.x, tile.mesh.y[i] = v.y, tile.mesh.z[i] = v.z;
    }
    tile.bin = thoroughBounds(ellipsoid, tile.mesh, longitude.middle(), 0.0);
    return tile;
}

inline void addSkirt(std::vector<Triangle>& triangles, const glm::dvec3& a, const glm::dvec3& b,
                     const glm::dvec3& down) {
    triangles.push_back({a, b, a + down});
    triangles.push_back({b, b + down, a + down});
}

// The mesh, and skirts that hang from its edges, `down` from its first post.
inline void addTriangles(std::vector<Triangle>& triangles, const EcefMesh& mesh, std::uint32_t cells,
                         const glm::dvec3& down) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) triangles.push_back(triangleAt(mesh, i));
    const auto post = [&](std::uint32_t y, std::uint32_t x) { return mesh.vertex(y * (cells + 1) + x); };
    for (std::uint32_t i = 0; i < cells; ++i) {
        addSkirt(triangles, post(0, i), post(0, i + 1), down);
        addSkirt(triangles, post(cells, i), post(cells, i + 1), down);
        addSkirt(triangles, post(i, 0), post(i + 1, 0), down);
        addSkirt(triangles, post(i, cells), post(i + 1, cells), down);
    }
}

// Where six by six tiles are.
inline Land landOnGlobe(Random& random, const Ellipsoid& ellipsoid) {
    Land land{};
    land.size = random.logUniform(1e-5, 0.1);
    land.southmost = random.uniform(-1.4, 1.4 - kTilesAcross * land.size);
    land.westmost = random.chance(0.2) ? 3.1415 - 3.0 * land.size : random.uniform(-3.1, 3.1);
    land.width = land.size / std::cos(land.southmost + 0.5 * kTilesAcross * land.size);
    land.metres = land.size * ellipsoid.equatorialRadius();
    land.height = land.metres * random.logUniform(1e-3, 0.3) * std::min(1.0, 0.02 / land.size);
    return land;
}

inline Land landInMap(Random& random) {
    constexpr double kUnits = Ellipsoid::kMapUnitsInRadian;
    Land land{};
    land.metres = random.logUniform(10.0, 3e5);
    land.height = land.metres * random.logUniform(1e-3, 0.3);
    land.size = land.metres / kUnits;
    land.width = land.size * random.uniform(0.5, 2.0);
    land.southmost = random.sign() * random.logUniform(1.0, 1e7) / kUnits;
    land.westmost = random.sign() * random.logUniform(1.0, 6e7) / kUnits;
    return land;
}

inline Ellipsoid anyGlobe(Random& random) {
    if (random.chance(0.7)) return wgs84();
    const double radius = random.logUniform(1e3, 1e8);
    return {radius, radius * random.uniform(0.996, 1.004)};
}

/// Whether a line from one point to another meets the triangle between them.
[[nodiscard]] inline bool meets(const Triangle& triangle, const RealVector& from, const RealVector& to) {
    const RealVector a = real(triangle.a) - from, b = real(triangle.b) - from, c = real(triangle.c) - from;
    const RealVector ray = to - from;
    const Real ab = dot(ray, cross(a, b)), bc = dot(ray, cross(b, c)), ca = dot(ray, cross(c, a));
    const bool isThrough = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    if (!isThrough) return false;
    const RealVector normal = cross(b - a, c - a);
    const Real along = dot(normal, ray);
    if (along == 0) return false;
    const Real t = dot(normal, a) / along;
    return t > 0 && t < 1 - 1e-12L;
}

/// Tiles side by side. Where neighbours have different posts their edges differ, and skirts hang from all of them.
struct OcclusionScene {
    /// `hasSpikes`: needles and pits in some scenes. `isMap`: in the plane of a map, else on a globe.
    explicit OcclusionScene(Random& random, bool hasSpikes = true, bool isMap = false)
        : ellipsoid(isMap ? Ellipsoid::plane() : anyGlobe(random)) {
        Land land = isMap ? landInMap(random) : landOnGlobe(random, ellipsoid);
        const Relief relief(random, land.size * random.logUniform(0.3, 3.0), land.height);
        const bool areAlike = random.chance(0.5);
        std::vector<Triangle> drawn;
        land.spikes = hasSpikes && random.chance(0.3) ? random.uniform(0.0, 0.1) : 0.0;
        for (int row = 0; row < kTilesAcross; ++row) {
            for (int column = 0; column < kTilesAcross; ++column) {
                const std::uint32_t cells = areAlike ? kMostCells : kMostCells >> random.integer(0, 3);
                tiles.push_back(makeTile(random, ellipsoid, land, relief, row, column, cells));
                const glm::dvec3 post = tiles.back().mesh.vertex(0);
                const glm::dvec3 below = isMap ? glm::dvec3(0.0, 0.0, -1.0) : -glm::normalize(post);
                addTriangles(drawn, tiles.back().mesh, cells, (30.0 * land.height + 0.01 * land.metres) * below);
            }
        }
        triangles = TriangleTree(std::move(drawn));
        placeEye(random, land, relief);
    }

    /// Whether the surface or a skirt is between the eye and the point.
    [[nodiscard]] bool isBlocked(const RealVector& point) const {
        const glm::dvec3 end(static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z));
        return triangles.any(eye, end, [&](const Triangle& triangle) { return meets(triangle, real(eye), point); });
    }
    /// A point of the tile's bin, often of its mesh.
    [[nodiscard]] RealVector pointIn(Random& random, const GroundTile& tile) const {
        if (!tile.mesh.triangles.empty() && random.chance(0.7)) {
            const auto count = static_cast<int>(tile.mesh.triangles.size() / 3);
            return randomPointOf(random,
                                 triangleAt(tile.mesh, 3 * static_cast<std::size_t>(random.integer(0, count - 1))));
        }
        const auto in = [&](const Interval& i) { return random.uniform(i.lower, i.upper); };
        return real(ellipsoid.toEcef({in(tile.bin.latitude()), in(tile.bin.longitude()), in(tile.bin.altitude())}));
    }
    /// A point on the top of the tile's bin.
    [[nodiscard]] RealVector topOf(Random& random, const GroundTile& tile) const {
        const auto in = [&](const Interval& i) { return random.uniform(i.lower, i.upper); };
        return real(ellipsoid.toEcef({in(tile.bin.latitude()), in(tile.bin.longitude()), tile.bin.altitude().upper}));
    }

    Ellipsoid ellipsoid;
    std::vector<GroundTile> tiles;
    TriangleTree triangles;  // of all tiles, skirts included
    glm::dvec3 eye, forward, up;

private:
    void placeEye(Random& random, const Land& land, const Relief& relief) {
        // by the border, with most of the terrain ahead, or in the middle
        const double north = random.uniform(0.5, random.chance(0.5) ? 1.0 : 5.5), east = random.uniform(0.5, 5.5);
        const double latitude = land.southmost + land.size * north, longitude = land.westmost + land.width * east;
        const GroundTile& below =
            tiles[static_cast<std::size_t>(north) * kTilesAcross + static_cast<std::size_t>(east)];
        const double highest = below.bin.altitude().upper;
        const double altitude = random.chance(0.5)
                                    ? relief.at(latitude, longitude) + land.height * random.uniform(0.5, 1.5)
                                    : highest + land.height * random.logUniform(1e-4, 10.0);
        eye = ellipsoid.toEcef({latitude, longitude, altitude});
        const core::Geodetic place = ellipsoid.toGeodetic(eye);
        up = ellipsoid.up(place.latitude, place.longitude);
        // between posts the mesh may be higher than the relief
        if (isBlocked(real(eye + 100.0 * (land.height + land.metres) * up)))
            eye += (highest + land.height - altitude) * up;
        const glm::dvec3 target =
            ellipsoid.toEcef({land.southmost + land.size * kTilesAcross * random.uniform(),
                              land.westmost + land.width * kTilesAcross * random.uniform(), altitude});
        const glm::dvec3 toward = target - eye;
        forward = glm::normalize(toward - glm::dot(toward, up) * up);
    }
};

/// Of the camera: right, forward, up.
[[nodiscard]] inline core::Frame frameOf(const OcclusionScene& scene) {
    return {scene.eye, glm::cross(scene.forward, scene.up), scene.forward, scene.up};
}

/// A buffer for the camera, without earth. `eyes`: metres that the eye may be away from its place, along each axis.
[[nodiscard]] inline HorizonBuffer bufferOf(const OcclusionScene& scene, const glm::dvec3& eyes = glm::dvec3(0.0)) {
    return {glm::length(scene.eye), kAcross, 0.0, 0.0, eyes};
}

/// How far eyes may be from the scene's place, along each axis of the camera. A camera that flies moves more ahead.
[[nodiscard]] inline glm::dvec3 randomEyes(Random& random, const OcclusionScene& scene) {
    const double altitude = scene.ellipsoid.toGeodetic(scene.eye).altitude;
    const double height = std::abs(altitude - scene.tiles[0].bin.altitude().lower);
    glm::dvec3 eyes(0.0);
    for (const int axis : {0, 1, 2}) eyes[axis] = random.logUniform(1e-3, axis == 1 ? 3.0 : 1.0) * height;
    return eyes;
}

/// Moves the eye to a random place in such a box about the frame's origin, often to one of its sides. Returns: whether
/// it is above the ground there; an eye below it looks through the backs of faces.
[[nodiscard]] inline bool moveEye(OcclusionScene& scene, Random& random, const core::Frame& frame,
                                  const glm::dvec3& eyes) {
    // corners of the box are worst
    const auto share = [&] { return random.chance(0.5) ? 0.999 * random.sign() : random.uniform(-1.0, 1.0); };
    const double right = share() * eyes.x, ahead = share() * eyes.y, up = share() * eyes.z;
    scene.eye = frame.toOuter({right, ahead, up});
    return !scene.isBlocked(real(scene.eye + 0.1 * scene.ellipsoid.polarRadius() * scene.up));
}

[[nodiscard]] inline EarthColumn columnOf(const core::EarthColumns& columns, std::size_t i) {
    constexpr std::size_t kMost = core::EarthColumns::kMost;
    EarthColumn column;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const double* const x = columns.corners.data() + 3 * corner * kMost + i;
        (corner < 4 ? column.top[corner] : column.bottom[corner - 4]) = {x[0], x[kMost], x[2 * kMost]};
    }
    column.error = columns.error[i];
    return column;
}

[[nodiscard]] inline core::EarthColumns columnsOf(const EarthColumn& column) {
    constexpr std::size_t kMost = core::EarthColumns::kMost;
    core::EarthColumns columns;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3& corner = i < 4 ? column.top[i] : column.bottom[i - 4];
        for (int k = 0; k < 3; ++k) columns.corners[(3 * i + static_cast<std::size_t>(k)) * kMost] = corner[k];
    }
    columns.error[0] = column.error;
    columns.size = 1;
    return columns;
}

/// Adds the columns of cells of the tile, `cells` a side. Their depth is a share of the distance from the eye.
inline void addTile(HorizonBuffer& buffer, const OcclusionScene& scene, const GroundTile& tile, std::size_t cells,
                    std::uint32_t owner = 0) {
    const core::GroundPlates plates = platesOf(scene.ellipsoid, tile.mesh, tile.bin);
    const double depth =
        std::min(0.3 * glm::distance(scene.eye, tile.mesh.vertex(0)), 0.01 * scene.ellipsoid.equatorialRadius());
    core::EarthColumns columns;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        plates.columns(cells, cells, quarter, depth, 0.0, frameOf(scene), columns);
        buffer.add(columns, owner);
    }
}

/// The quarters of all tiles and their parts, up to the tops of their meshes, the nearest first, as the buffer needs.
[[nodiscard]] inline std::vector<OutlinedPart> frontToBack(const OcclusionScene& scene, const HorizonBuffer& buffer) {
    std::vector<OutlinedPart> sorted;
    const core::Frame frame = frameOf(scene);
    for (const GroundTile& tile : scene.tiles) {
        const core::GroundPlates plates = platesOf(scene.ellipsoid, tile.mesh, tile.bin);
        const Interval altitude = tile.bin.altitude();
        const auto add = [&](core::BinHull hull, const GeodeticBin& bin, double top) {
            if (top < altitude.upper) hull.lowerTop(top, altitude);
            const GeodeticBin drawn =
                bin.withAltitude({altitude.lower, std::clamp(top, altitude.lower, altitude.upper)});
            sorted.push_back({{{}, drawn}, buffer.outlineOf(hull)});
        };
        const auto hulls = core::BinBody(scene.ellipsoid, tile.bin, 0.0, frame).quarters();
        const auto bins = tile.bin.quarters();
        for (std::size_t quarter = 0; quarter < 4; ++quarter) {
            add(hulls[quarter], bins[quarter], plates.mostOfQuarter(quarter, tile.bin));
            const auto parts = core::BinBody(scene.ellipsoid, bins[quarter], 0.0, frame).quarters();
            for (std::size_t i = 0; i < 4; ++i)
                add(parts[i], bins[quarter].quarters()[i], plates.most(4 * quarter + i, tile.bin));
        }
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const OutlinedPart& a, const OutlinedPart& b) { return a.outline.nearest < b.outline.nearest; });
    return sorted;
}

[[nodiscard]] inline bool isBeforeTheCamera(const OcclusionScene& scene, const RealVector& point) {
    const RealVector from = point - real(scene.eye);
    const Real ahead = dot(from, real(scene.forward));
    const Real across = dot(from, real(glm::cross(scene.forward, scene.up)));
    return ahead > 0 && across >= kAcross.lower * ahead && across <= kAcross.upper * ahead;
}

}  // namespace osgAnalyticBin::test
