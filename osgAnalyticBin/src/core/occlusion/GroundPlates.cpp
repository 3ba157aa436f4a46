// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../FloatRounding.h"
#include "../LocalFrame.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>
#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace osgAnalyticBin::core {

namespace {

constexpr float kUnknown = -std::numeric_limits<float>::infinity();
// The rim on each side of a cell, as a share of its width. Triangles that reach only into its outer half do not count
// for the cell; columns keep out of all of it.
constexpr double kRim = 1.0 / 64.0;

constexpr std::array<std::size_t, 4> kCellsOfGrids{1, 2, 4, 8};

std::size_t firstNumber(std::size_t cells) {
    return (cells * cells - 1) / 3;  // 0, 1, 5, 21
}

std::size_t numberOf(std::size_t cells, std::size_t row, std::size_t column) {
    return firstNumber(cells) + row * cells + column;
}

// The cells of a grid along one axis that an interval meets, first to last; first > last: none.
struct CellRange {
    std::ptrdiff_t first, last;
};

CellRange cellsIn(const Interval& extents, std::size_t cells, const Interval& met) {
    const double width = extents.width() / static_cast<double>(cells);
    const double half = 0.5 * kRim * width;
    const auto most = static_cast<double>(cells);
    // a cell counts where its used part, half a rim within its edges, is met
    const double from = std::floor((met.lower - extents.lower + half) / width);
    const double to = std::floor((met.upper - extents.lower - half) / width);
    return {static_cast<std::ptrdiff_t>(std::clamp(from, 0.0, most)),
            static_cast<std::ptrdiff_t>(std::clamp(to, -1.0, most - 1.0))};
}

}  // namespace

// Goes over the triangles of a mesh. Source: doc/occlusion.md, section 3.
class GroundPlates::Builder {
public:
    Builder(GroundPlates& plates, const EcefMesh& mesh) : _plates(plates), _mesh(mesh) {
        _isCovered.fill(false);
        _isDoubted.fill(false);
        plates._least.fill(std::numeric_limits<float>::infinity());
        findMiddles();
        mergeVertices();
        _sense = sense();
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) addTriangle(&mesh.triangles[i]);
        addBorders();
        for (std::size_t i = 0; i < kNumbers; ++i)
            if (!_isCovered[i] || _isDoubted[i]) plates._least[i] = kUnknown;
    }

private:
    using Corners = std::array<glm::dvec3, 3>;
    // The place on the ellipsoid in the middle of a cell, and the normal there.
    struct Middle {
        glm::dvec3 foot, up;
    };

    void findMiddles() {
        const auto middle = [](const Interval& extents, std::size_t i, std::size_t cells) {
            return extents.lower + extents.width() * (static_cast<double>(i) + 0.5) / static_cast<double>(cells);
        };
        for (const std::size_t cells : kCellsOfGrids) {
            for (std::size_t i = 0; i < cells * cells; ++i) {
                const double latitude = middle(_plates._latitude, i / cells, cells);
                const double longitude = middle(_plates._longitude, i % cells, cells);
                _middles[firstNumber(cells) + i] = {_plates._ellipsoid.toEcef({latitude, longitude, 0.0}),
                                                    LocalFrame(latitude, longitude).up};
            }
        }
    }

    // Triangles that share an edge may have vertices of their own.
    void mergeVertices() {
        struct Hash {
            std::size_t operator()(const glm::dvec3& p) const {
                const std::hash<double> hash;
                return hash(p.x) ^ (hash(p.y) * 31) ^ (hash(p.z) * 1009);
            }
        };
        std::unordered_map<glm::dvec3, std::uint32_t, Hash> numbers;
        _merged.reserve(_mesh.size());
        for (std::size_t i = 0; i < _mesh.size(); ++i)
            _merged.push_back(numbers.emplace(_mesh.vertex(i), static_cast<std::uint32_t>(i)).first->second);
    }

    [[nodiscard]] Corners cornersOf(const std::uint32_t* triangle) const {
        return {_mesh.vertex(triangle[0]), _mesh.vertex(triangle[1]), _mesh.vertex(triangle[2])};
    }

    // Whether the triangles show their front side upward (1) or downward (-1), by the volumes below them.
    [[nodiscard]] double sense() const {
        double sum = 0.0;
        for (std::size_t i = 0; i + 2 < _mesh.triangles.size(); i += 3) {
            const Corners c = cornersOf(&_mesh.triangles[i]);
            sum += glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), c[0]);
        }
        return sum < 0.0 ? -1.0 : 1.0;
    }

    // Across a triangle the ellipsoid's normal turns by at most the triangle's width over the radius of curvature.
    [[nodiscard]] bool isUpward(const Corners& c) const {
        const glm::dvec3 normal = _sense * glm::cross(c[1] - c[0], c[2] - c[0]);
        const double length = glm::length(normal);
        const double width =
            std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
        const double radius = std::min(_plates._ellipsoid.equatorialRadius(), _plates._ellipsoid.polarRadius());
        const double angle = 2.0 * width / radius;
        const Geodetic place = _plates._ellipsoid.toGeodetic(c[0]);
        const glm::dvec3 up = LocalFrame(place.latitude, place.longitude).up;
        return glm::dot(normal, up) > (angle + 1e-9) * length;
    }

    [[nodiscard]] GeodeticBin boundsOf(const Corners& c) const {
        GeodeticMeshBounds bounds(_plates._ellipsoid, _plates._longitude.middle());
        for (const glm::dvec3& corner : c) bounds.expandByVertex(corner);
        bounds.expandByTriangle(c[0], c[1], c[2]);
        return bounds.bin();
    }

    // Calls visit(number) for the cells that the bounds reach into. Bounds that are not known reach into all, and
    // bounds around the axis into those at all longitudes: they do not count longitudes from where the extents do.
    template <class Visit>
    void forEachCell(const GeodeticBin& met, Visit&& visit) {
        const bool isAround = met.empty() || met.isFullCircle();
        for (const std::size_t cells : kCellsOfGrids) {
            const CellRange rows = cellsIn(_plates._latitude, cells, met.empty() ? _plates._latitude : met.latitude());
            const CellRange columns =
                cellsIn(_plates._longitude, cells, isAround ? _plates._longitude : met.longitude());
            for (std::ptrdiff_t row = rows.first; row <= rows.last; ++row) {
                for (std::ptrdiff_t column = columns.first; column <= columns.last; ++column)
                    visit(numberOf(cells, static_cast<std::size_t>(row), static_cast<std::size_t>(column)));
            }
        }
    }

    void addTriangle(const std::uint32_t* triangle) {
        const std::uint32_t a = _merged[triangle[0]], b = _merged[triangle[1]], c = _merged[triangle[2]];
        if (a == b || b == c || c == a) return;
        const Corners corners = cornersOf(triangle);
        const GeodeticBin bounds = boundsOf(corners);
        if (bounds.empty() || !isUpward(corners)) {
            forEachCell(bounds, [&](std::size_t cell) { _isDoubted[cell] = true; });
            return;
        }
        noteEdges(a, b, c);
        // more than the error that GeodeticMeshBounds allows
        const double room = 2e-14 * std::max(_plates._ellipsoid.equatorialRadius(), _plates._ellipsoid.polarRadius());
        const float low = roundedDown(bounds.altitude().lower - room);
        forEachCell(bounds, [&](std::size_t cell) {
            _plates._least[cell] = std::min(_plates._least[cell], low);
            if (!_isCovered[cell]) _isCovered[cell] = isOnNormal(corners, _middles[cell]);
        });
    }

    // Whether the normal through the middle of a cell meets the triangle.
    [[nodiscard]] bool isOnNormal(const Corners& c, const Middle& middle) const {
        const auto& [foot, up] = middle;
        const glm::dvec3 p = c[0] - foot, q = c[1] - foot, r = c[2] - foot;
        const double pq = _sense * glm::dot(up, glm::cross(p, q));
        const double qr = _sense * glm::dot(up, glm::cross(q, r));
        const double rp = _sense * glm::dot(up, glm::cross(r, p));
        return pq >= 0.0 && qr >= 0.0 && rp >= 0.0;
    }

    void noteEdges(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::array<std::uint32_t, 4> round{a, b, c, a};
        for (std::size_t i = 0; i < 3; ++i) ++_edges[std::uint64_t{round[i]} << 32 | round[i + 1]];
    }

    // Where the mesh, or the part of it that faces one way, ends: at edges that do not have one triangle on each side.
    void addBorders() {
        for (const auto& [edge, count] : _edges) {
            const std::uint32_t from = static_cast<std::uint32_t>(edge >> 32), to = static_cast<std::uint32_t>(edge);
            const auto other = _edges.find(std::uint64_t{to} << 32 | from);
            if (count == 1 && other != _edges.end() && other->second == 1) continue;
            const GeodeticBin bounds = boundsOf({_mesh.vertex(from), _mesh.vertex(to), _mesh.vertex(to)});
            forEachCell(bounds, [&](std::size_t cell) { _isDoubted[cell] = true; });
        }
    }

    GroundPlates& _plates;
    const EcefMesh& _mesh;
    double _sense = 1.0;
    std::vector<std::uint32_t> _merged;
    std::unordered_map<std::uint64_t, int> _edges;
    std::array<Middle, kNumbers> _middles;
    std::array<bool, kNumbers> _isCovered, _isDoubted;
};

GroundPlates::GroundPlates() noexcept : _ellipsoid(1.0, 1.0) {
    _least.fill(kUnknown);
}

GroundPlates::GroundPlates(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GeodeticBin& extents)
    : _ellipsoid(ellipsoid), _latitude(extents.latitude()), _longitude(extents.longitude()) {
    _least.fill(kUnknown);
    constexpr double kFlattest = 0.01;
    const bool isRound = std::abs(ellipsoid.eccentricitySquared()) <= kFlattest;
    if (extents.empty() || !isRound || !(_latitude.width() > 0.0) || !(_longitude.width() > 0.0)) return;
    if (_longitude.width() < kPi) Builder(*this, mesh);
}

float GroundPlates::least(std::size_t cells, std::size_t row, std::size_t column) const noexcept {
    return _least[numberOf(cells, row, column)];
}

std::optional<EarthColumn> GroundPlates::column(std::size_t cells, std::size_t row, std::size_t column,
                                                double depth) const noexcept {
    const double high = least(cells, row, column);
    if (high == static_cast<double>(kUnknown)) return std::nullopt;
    const double across = _longitude.width() / static_cast<double>(cells);
    const double along = _latitude.width() / static_cast<double>(cells);
    const double inner = 1.0 - 2.0 * kRim;
    // doc/occlusion.md, section 2: how far chords of a parallel leave it toward the pole, in latitude
    const double bulge = 0.55 * (1.0 / std::cos(0.5 * inner * across) - 1.0);
    const double smallest = std::min(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    // longitudes many turns away from zero are rounded coarsely
    const bool isWide = across * kRim > 64.0 * kEpsilon * (1.0 + std::abs(_longitude.lower));
    const bool isShallow = std::abs(high) < 0.1 * smallest && depth >= 0.0 && depth < 0.1 * smallest;
    if (!isWide || !(across * inner < 1.0) || !(bulge < 0.5 * kRim * along) || !isShallow) return std::nullopt;
    EarthColumn earth;
    earth.error = 32.0 * kEpsilon * (_ellipsoid.equatorialRadius() + std::abs(high) + depth);
    for (std::size_t i = 0; i < 4; ++i) {
        const double latitude = _latitude.lower + along * (static_cast<double>(row) + (i < 2 ? kRim : 1.0 - kRim));
        const double longitude =
            _longitude.lower + across * (static_cast<double>(column) + (i % 2 == 0 ? kRim : 1.0 - kRim));
        earth.top[i] = _ellipsoid.toEcef({latitude, longitude, high});
        earth.bottom[i] = _ellipsoid.toEcef({latitude, longitude, high - depth});
    }
    return earth;
}

}  // namespace osgAnalyticBin::core
