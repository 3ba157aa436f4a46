// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"
#include "../PerThread.h"
#include "KeyNumbers.h"
#include "VerticalPassage.h"

#include <osgAnalyticBin/core/mesh/MeshCover.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace osgAnalyticBin::core {

namespace {

// Triangles whose normal is this far from level at least are surface for sure.
constexpr double kGentle = 0.2;
constexpr double kSkirtRoom = MeshCover::kSkirtRoom;

class CoverSearch {
    using Corners = std::array<std::uint32_t, 3>;
    using Edge = std::array<std::uint64_t, 1>;  // of two vertices, the smaller number first
    struct Triangle {
        Corners corners;
        bool isGentle, isSurface;
    };

public:
    // Kept from mesh to mesh: to get so much anew from the system takes longer than the search.
    struct Memory {
        KeyNumbers<std::array<std::uint64_t, 3>> positions;
        KeyNumbers<Edge> edges;
        std::vector<int> balance;            // of the edges
        std::vector<std::uint32_t> firstAt;  // the first vertex at each position
        std::vector<std::uint32_t> merged;   // the vertex that stands for each
        std::vector<std::optional<Geodetic>> places;
        std::vector<Triangle> triangles;
    };

    CoverSearch(const Ellipsoid& ellipsoid, const EcefMesh& mesh, double error, Memory& memory)
        : _ellipsoid(ellipsoid),
          _mesh(mesh),
          _memory(memory),
          _metre(1.0 / (ellipsoid.isPlane() ? Ellipsoid::kMapUnitsInRadian : smallestCurvatureRadius(ellipsoid))),
          _error(error * _metre) {
        _merged.clear();
        _triangles.clear();
        _places.assign(mesh.size(), std::nullopt);
    }

    [[nodiscard]] MeshCover run() {
        MeshCover cover;
        if (!mergeVertices() || !findTriangles()) return cover;
        findEnds();
        if (_ends.empty() && _ellipsoid.isPlane()) return cover;
        if (!findPlace()) return cover;
        // what is steep within the place is surface, too
        if (addSteep()) findEnds();
        cover.isFilled = endsAtBorders() && facesUpInTheMiddle();
        cover.ends = _ends;
        cover.place =
            GeodeticBin(_latitude, {_longitude + _longitudes.lower, _longitude + _longitudes.upper}, {0.0, 0.0});
        if (_ends.empty()) cover.place = GeodeticBin({-0.5 * kPi, 0.5 * kPi}, {-kPi, kPi}, {0.0, 0.0});
        return cover;
    }

private:
    // Vertices at one position count as one: triangles that share an edge may have vertices of their own. Returns:
    // false where a coordinate is not finite.
    [[nodiscard]] bool mergeVertices() {
        KeyNumbers<std::array<std::uint64_t, 3>>& positions = _memory.positions;
        std::vector<std::uint32_t>& firstAt = _memory.firstAt;
        positions.begin(_mesh.size());
        firstAt.clear();
        for (std::size_t i = 0; i < _mesh.size(); ++i) {
            const glm::dvec3 v = _mesh.vertex(i);
            if (!std::isfinite(v.x + v.y + v.z)) return false;
            const std::uint32_t number = positions.numberOf({bitsOf(v.x), bitsOf(v.y), bitsOf(v.z)});
            if (number == firstAt.size()) firstAt.push_back(static_cast<std::uint32_t>(i));
            _merged.push_back(firstAt[number]);
        }
        return true;
    }

    // Along the ellipsoid's normal at a vertex, or nearly so.
    [[nodiscard]] glm::dvec3 upwards(const glm::dvec3& v) const {
        if (_ellipsoid.isPlane()) return {0.0, 0.0, 1.0};
        return {v.x, v.y, v.z / _ellipsoid.squaredRatio()};
    }
    // 1 for a triangle that is level and faces up, below 0 for one that faces down.
    [[nodiscard]] double levelness(const Corners& c) const {
        const glm::dvec3 a = _mesh.vertex(c[0]);
        const glm::dvec3 normal = glm::cross(_mesh.vertex(c[1]) - a, _mesh.vertex(c[2]) - a), up = upwards(a);
        const double lengths = std::sqrt(glm::dot(normal, normal) * glm::dot(up, up));
        return lengths > 0.0 ? glm::dot(normal, up) / lengths : 0.0;
    }
    // Returns: whether there are gentle ones.
    [[nodiscard]] bool findTriangles() {
        std::size_t gentle = 0;
        for (std::size_t i = 0; i + 2 < _mesh.triangles.size(); i += 3) {
            const Corners c{_merged[_mesh.triangles[i]], _merged[_mesh.triangles[i + 1]],
                            _merged[_mesh.triangles[i + 2]]};
            if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
            const bool isGentle = levelness(c) > kGentle;
            _triangles.push_back({c, isGentle, isGentle});
            if (!isGentle) continue;
            ++gentle;
            _middle += _mesh.vertex(c[0]);
        }
        if (gentle > 0) _middle /= static_cast<double>(gentle);
        return gentle > 0;
    }

    // Finds the edges where the surface ends: those that do not run as often from one vertex to the other as back.
    void findEnds() {
        KeyNumbers<Edge>& edges = _memory.edges;
        std::vector<int>& balance = _memory.balance;
        edges.begin(3 * _triangles.size());
        balance.clear();
        for (const Triangle& triangle : _triangles) {
            if (!triangle.isSurface) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
                const std::uint32_t number = edges.numberOf({std::uint64_t{std::min(a, b)} << 32U | std::max(a, b)});
                if (number == balance.size()) balance.push_back(0);
                balance[number] += a < b ? 1 : -1;
            }
        }
        _ends.clear();
        for (std::size_t i = 0; i < balance.size(); ++i) {
            if (balance[i] == 0) continue;
            const std::uint64_t both = edges.keys()[i][0];
            _ends.push_back({static_cast<std::uint32_t>(both >> 32U), static_cast<std::uint32_t>(both)});
        }
    }

    // The longitude from the middle.
    [[nodiscard]] const Geodetic& placeOf(std::uint32_t vertex) {
        std::optional<Geodetic>& place = _places[vertex];
        if (!place) {
            place = _ellipsoid.toGeodetic(_mesh.vertex(vertex));
            place->longitude = turned(place->longitude);
        }
        return *place;
    }
    [[nodiscard]] double turned(double longitude) const {
        const double from = longitude - _longitude;
        return _ellipsoid.isPlane() ? from : std::remainder(from, 2.0 * kPi);
    }
    // Where longitudes say nothing.
    [[nodiscard]] bool isAtPole(const Geodetic& place, double room) const {
        return !_ellipsoid.isPlane() && 0.5 * kPi - std::abs(place.latitude) <= room;
    }

    // Sets the rectangle about the vertices where the surface ends.
    [[nodiscard]] bool findPlace() {
        const glm::dvec3 first = _mesh.vertex(_triangles.front().corners[0]);
        _longitude = _ellipsoid.isPlane() ? _ellipsoid.toGeodetic(first).longitude : std::atan2(_middle.y, _middle.x);
        std::vector<std::uint32_t> vertices;
        for (const auto& [a, b] : _ends) vertices.insert(vertices.end(), {a, b});
        constexpr double kWide = 3.0, kFar = 0.85;
        const bool isFar = !_ellipsoid.isPlane() && glm::length(_middle) < kFar * _ellipsoid.polarRadius();
        expandBy(vertices);
        if (!_ellipsoid.isPlane() && (isFar || _longitudes.width() > kWide)) {
            for (const Triangle& triangle : _triangles) {
                if (triangle.isSurface)
                    vertices.insert(vertices.end(), triangle.corners.begin(), triangle.corners.end());
            }
            findWidePlace(vertices);
        }
        if (!(_latitude.width() > 0.0) || !(_longitudes.width() > 0.0)) return false;
        const double equatorward = _latitude.lower * _latitude.upper <= 0.0
                                       ? 0.0
                                       : std::min(std::abs(_latitude.lower), std::abs(_latitude.upper));
        _roomAlong = MeshCover::kTolerance * _latitude.width() + _error;
        _roomAcross = MeshCover::kTolerance * _longitudes.width() * squeezed(equatorward) + _error;
        return true;
    }
    [[nodiscard]] double squeezed(double latitude) const {
        return _ellipsoid.isPlane() ? 1.0 : std::max(std::cos(latitude), 1e-9);
    }
    void expandBy(const std::vector<std::uint32_t>& vertices) {
        // farther than float vertices of large tiles are rounded
        constexpr double kAtPole = 2e-6;
        _latitude = _longitudes = Interval::none();
        for (const std::uint32_t vertex : vertices) {
            const Geodetic& place = placeOf(vertex);
            _latitude.expandBy(place.latitude);
            if (!isAtPole(place, kAtPole)) _longitudes.expandBy(place.longitude);
        }
    }
    // Of a surface around much of the globe: it lies beside its widest gap in longitude. Where no gap is much wider
    // than the next one it goes around the whole globe, from a seam at which it ends, if there is one.
    void findWidePlace(const std::vector<std::uint32_t>& vertices) {
        expandBy(vertices);
        std::vector<double> longitudes;
        constexpr double kNearPole = 1e-3;
        for (const std::uint32_t vertex : vertices) {
            if (!isAtPole(placeOf(vertex), kNearPole)) longitudes.push_back(placeOf(vertex).longitude);
        }
        if (longitudes.empty()) return;
        std::sort(longitudes.begin(), longitudes.end());
        double widest = longitudes.front() + 2.0 * kPi - longitudes.back(), second = 0.0;
        double middle = 0.5 * (longitudes.front() + longitudes.back());
        for (std::size_t i = 0; i + 1 < longitudes.size(); ++i) {
            const double gap = longitudes[i + 1] - longitudes[i];
            second = std::max(second, std::min(gap, widest));
            if (gap <= widest) continue;
            widest = gap;
            middle = 0.5 * (longitudes[i] + longitudes[i + 1]) + kPi;
        }
        constexpr double kMuchWider = 0.6;
        const bool isAround = second > kMuchWider * widest;
        if (isAround) middle = seam().value_or(middle - kPi) + kPi;
        _longitude = std::remainder(_longitude + middle, 2.0 * kPi);
        _places.assign(_places.size(), std::nullopt);
        expandBy(vertices);
        if (isAround) _longitudes = {-kPi, kPi};
    }
    [[nodiscard]] std::optional<double> seam() {
        constexpr double kAlongMeridian = 1e-6, kNearPole = 1e-3;
        for (const auto& [a, b] : _ends) {
            const Geodetic p = placeOf(a), q = placeOf(b);
            if (isAtPole(p, kNearPole) || isAtPole(q, kNearPole)) continue;
            if (std::abs(std::remainder(p.longitude - q.longitude, 2.0 * kPi)) < kAlongMeridian) return p.longitude;
        }
        return std::nullopt;
    }

    // Which borders a vertex is at, one bit for each, south, north, west and east. `along` and `aside`: radians of
    // latitude and longitude by which it may be beside them.
    [[nodiscard]] unsigned int bordersAt(std::uint32_t vertex, double along, double aside) {
        const Geodetic& at = placeOf(vertex);
        const bool isPole = isAtPole(at, along);
        const bool isWest = isPole || at.longitude <= _longitudes.lower + aside;
        const bool isEast = isPole || at.longitude >= _longitudes.upper - aside;
        return unsigned{at.latitude <= _latitude.lower + along} |
               unsigned{at.latitude >= _latitude.upper - along} << 1U |
               unsigned{isWest || (isAround() && isEast)} << 2U | unsigned{isEast || (isAround() && isWest)} << 3U;
    }
    [[nodiscard]] bool isAround() const { return !_ellipsoid.isPlane() && _longitudes.width() >= 2.0 * kPi; }
    // Adds steep triangles that are no skirts to the surface. Returns: whether there are any.
    [[nodiscard]] bool addSteep() {
        const double along = kSkirtRoom * _latitude.width(), aside = kSkirtRoom * _longitudes.width();
        bool hasSteep = false;
        for (Triangle& triangle : _triangles) {
            if (triangle.isGentle) continue;
            unsigned int borders = ~0U;
            for (const std::uint32_t vertex : triangle.corners) borders &= bordersAt(vertex, along, aside);
            triangle.isSurface = borders == 0;
            hasSteep = hasSteep || triangle.isSurface;
        }
        return hasSteep;
    }
    // Draws the borders of the place in to where the surface ends, because meshes may run over their borders with a
    // part of a cell or a skirt. Returns: false where the surface ends within the place.
    [[nodiscard]] bool endsAtBorders() {
        // of the place's height and width, south, north, west and east
        std::array<double, 4> inward{};
        const double along = kSkirtRoom * _latitude.width();
        const auto bordersOf = [&](std::uint32_t vertex) {
            // a seam is one line
            const double aside =
                isAround() ? _roomAcross / squeezed(placeOf(vertex).latitude) : kSkirtRoom * _longitudes.width();
            return bordersAt(vertex, along, aside);
        };
        for (const auto& [a, b] : _ends) {
            const unsigned int borders = bordersOf(a) & bordersOf(b);
            const std::array<double, 4> from = sharesFromBorders(a), to = sharesFromBorders(b);
            std::size_t nearest = from.size();
            for (std::size_t i = 0; i < from.size(); ++i) {
                const bool isNear = ((borders >> i) & 1U) != 0;
                const bool isNearer =
                    nearest == from.size() || std::max(from[i], to[i]) < std::max(from[nearest], to[nearest]);
                if (isNear && isNearer) nearest = i;
            }
            if (nearest == from.size()) return false;
            const bool isOnSeam = isAround() && nearest >= 2;
            if (!isOnSeam) inward[nearest] = std::max({inward[nearest], from[nearest], to[nearest]});
        }
        const double height = _latitude.width(), width = _longitudes.width();
        _latitude = {_latitude.lower + inward[0] * height, _latitude.upper - inward[1] * height};
        _longitudes = {_longitudes.lower + inward[2] * width, _longitudes.upper - inward[3] * width};
        return true;
    }
    // How far a vertex is within each border.
    [[nodiscard]] std::array<double, 4> sharesFromBorders(std::uint32_t vertex) {
        const Geodetic& at = placeOf(vertex);
        const double south = (at.latitude - _latitude.lower) / _latitude.width();
        const double west = (at.longitude - _longitudes.lower) / _longitudes.width();
        if (isAtPole(at, _roomAlong)) return {south, 1.0 - south, 0.0, 0.0};
        return {south, 1.0 - south, west, 1.0 - west};
    }

    // Counts the faces on the normal through a point of the place, those that face up less those that face down.
    [[nodiscard]] bool facesUpInTheMiddle() const {
        // beside the lines that meshes are symmetric about
        constexpr double kAlong = 0.4871, kAcross = 0.5137;
        const Geodetic at{_latitude.lower + kAlong * _latitude.width(),
                          _longitude + _longitudes.lower + kAcross * _longitudes.width(), 0.0};
        const glm::dvec3 foot = _ellipsoid.toEcef(at), up = _ellipsoid.up(at.latitude, at.longitude);
        const double deepest = _ellipsoid.isPlane() ? HUGE_VAL : 0.5 * smallestCurvatureRadius(_ellipsoid);
        int count = 0;
        for (const Triangle& triangle : _triangles) {
            if (!triangle.isSurface) continue;
            const VerticalPassage passage({_mesh.vertex(triangle.corners[0]), _mesh.vertex(triangle.corners[1]),
                                           _mesh.vertex(triangle.corners[2])},
                                          foot, up);
            if (passage.isWithin() && passage.height() > -deepest) count += passage.facesUp() ? 1 : -1;
        }
        return count > 0;
    }

    const Ellipsoid& _ellipsoid;
    const EcefMesh& _mesh;
    Memory& _memory;
    std::vector<std::uint32_t>& _merged = _memory.merged;
    std::vector<std::optional<Geodetic>>& _places = _memory.places;
    std::vector<Triangle>& _triangles = _memory.triangles;
    const double _metre, _error;  // in radians of great circles
    MeshCover::Ends _ends;
    glm::dvec3 _middle{0.0};          // of gentle triangles
    double _longitude = 0.0;          // of the middle
    Interval _latitude, _longitudes;  // of the place, the longitudes from the middle
    double _roomAlong = 0.0, _roomAcross = 0.0;
};

}  // namespace

MeshCover MeshCover::of(const Ellipsoid& ellipsoid, const EcefMesh& mesh, double error) {
    thread_local PerThread<CoverSearch::Memory> memory;
    return CoverSearch(ellipsoid, mesh, error, *memory).run();
}

}  // namespace osgAnalyticBin::core
