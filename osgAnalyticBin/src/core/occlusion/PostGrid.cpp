// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PostGrid.h"

#include "../Constants.h"
#include "../EarthScale.h"
#include "PlateCells.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr double kTolerance = 1e-3;  // of the spacing

// Takes the first vertices for posts, row by row, and compares them with the places of such posts.
class GridSearch {
public:
    GridSearch(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GeodeticBin& extents)
        : _ellipsoid(ellipsoid), _mesh(mesh), _extents(extents), _middle(extents.longitude().middle()) {
        findSizes();
    }

    [[nodiscard]] std::optional<PostGrid> run() {
        if (_rows < 2 || _columns < 2 || !findPosts() || !findTriangles()) return std::nullopt;
        return std::move(_found);
    }

private:
    [[nodiscard]] Corners triangle(std::size_t first) const {
        return {_mesh.triangles[first], _mesh.triangles[first + 1], _mesh.triangles[first + 2]};
    }
    // The longitude from the middle.
    [[nodiscard]] Geodetic placeOf(std::size_t vertex) const {
        Geodetic place = _ellipsoid.toGeodetic(_mesh.vertex(vertex));
        place.longitude = std::remainder(place.longitude - _middle, 2.0 * kPi);
        return place;
    }
    [[nodiscard]] bool hasArea(const Corners& c) const {
        const glm::dvec3 a = _mesh.vertex(c[0]), b = _mesh.vertex(c[1]), d = _mesh.vertex(c[2]);
        return a != b && b != d && d != a;
    }

    // From the size of the first triangle.
    void findSizes() {
        std::size_t first = 0;
        while (first + 2 < _mesh.triangles.size() && !hasArea(triangle(first))) first += 3;
        if (first + 2 >= _mesh.triangles.size()) return;
        const Corners corners = triangle(first);
        const Geodetic a = placeOf(corners[0]), b = placeOf(corners[1]), c = placeOf(corners[2]);
        const auto [south, north] = std::minmax({a.latitude, b.latitude, c.latitude});
        const auto [west, east] = std::minmax({a.longitude, b.longitude, c.longitude});
        const double rows = std::round(_extents.latitude().width() / (north - south)) + 1.0;
        const double columns = std::round(_extents.longitude().width() / (east - west)) + 1.0;
        if (!(rows * columns <= static_cast<double>(_mesh.size()))) return;
        _rows = static_cast<std::size_t>(rows);
        _columns = static_cast<std::size_t>(columns);
    }

    [[nodiscard]] bool findPosts() {
        const Geodetic first = placeOf(0), last = placeOf(_rows * _columns - 1);
        const Interval latitude{first.latitude, last.latitude}, longitude{first.longitude, last.longitude};
        if (!(latitude.width() > 0.0) || !(longitude.width() > 0.0)) return false;
        _found.grid = {latitude, {_middle + longitude.lower, _middle + longitude.upper}, _columns, _rows};
        const double along = latitude.width() / static_cast<double>(_rows - 1);
        const double across = longitude.width() / static_cast<double>(_columns - 1);
        findAltitudes(along, across);
        const double smallest = smallestCurvatureRadius(_ellipsoid);
        return _found.error <= kTolerance * smallest * std::min(along, std::cos(latitude.upper) * across);
    }

    // Of the posts above their places, and how far vertices are beside these.
    void findAltitudes(double along, double across) {
        std::vector<glm::dvec2> meridians;
        for (std::size_t column = 0; column < _columns; ++column) {
            const double at = _found.grid.longitude.lower + across * static_cast<double>(column);
            meridians.emplace_back(std::cos(at), std::sin(at));
        }
        double aside2 = 0.0;
        for (std::size_t row = 0; row < _rows; ++row) {
            const double at = _found.grid.latitude.lower + along * static_cast<double>(row);
            const double sinLat = std::sin(at), cosLat = std::cos(at);
            const double radius = _ellipsoid.primeVerticalRadius(sinLat, cosLat);
            for (std::size_t column = 0; column < _columns; ++column) {
                const glm::dvec2 meridian = meridians[column];
                glm::dvec3 up(cosLat * meridian.x, cosLat * meridian.y, sinLat);
                glm::dvec3 foot(radius * up.x, radius * up.y, _ellipsoid.squaredRatio() * radius * up.z);
                if (_ellipsoid.isPlane()) {
                    foot = _ellipsoid.toEcef(
                        {at, _found.grid.longitude.lower + across * static_cast<double>(column), 0.0});
                    up = {0.0, 0.0, 1.0};
                }
                const glm::dvec3 fromFoot = _mesh.vertex(row * _columns + column) - foot;
                const double altitude = glm::dot(fromFoot, up);
                const glm::dvec3 aside = fromFoot - altitude * up;
                aside2 = std::max(aside2, glm::dot(aside, aside));
                _found.altitudes.push_back(altitude);
            }
        }
        _found.error = std::sqrt(aside2);
    }

    // Each triangle leaves out one of four posts. Two that leave out opposite ones fill the place between the posts.
    [[nodiscard]] bool findTriangles() {
        std::vector<std::uint8_t> leftOut((_rows - 1) * (_columns - 1), 0);
        for (std::size_t i = 0; i + 2 < _mesh.triangles.size(); i += 3) {
            const Corners corners = triangle(i);
            // the ends of lines
            if (corners[0] == corners[1] && corners[1] == corners[2]) return false;
            const bool hasOthers = *std::max_element(corners.begin(), corners.end()) >= _rows * _columns;
            // skirts may be folded up
            if (!hasOthers && !hasArea(corners)) continue;
            if (hasOthers) {
                if (!isSkirt(corners)) return false;
                continue;
            }
            std::array<std::ptrdiff_t, 3> row{}, column{};
            for (std::size_t k = 0; k < 3; ++k) {
                row[k] = static_cast<std::ptrdiff_t>(corners[k] / _columns);
                column[k] = static_cast<std::ptrdiff_t>(corners[k] % _columns);
            }
            const std::ptrdiff_t turn =
                (column[1] - column[0]) * (row[2] - row[0]) - (column[2] - column[0]) * (row[1] - row[0]);
            const auto [south, north] = std::minmax({row[0], row[1], row[2]});
            const auto [west, east] = std::minmax({column[0], column[1], column[2]});
            if (turn != 1 || north - south != 1 || east - west != 1) return false;
            unsigned int left = 0xf;
            for (std::size_t k = 0; k < 3; ++k) left &= ~(1U << (2 * (row[k] - south) + (column[k] - west)));
            std::uint8_t& here =
                leftOut[static_cast<std::size_t>(south) * (_columns - 1) + static_cast<std::size_t>(west)];
            if (here & left) return false;
            here = static_cast<std::uint8_t>(here | left);
        }
        return std::all_of(leftOut.begin(), leftOut.end(),
                           [](std::uint8_t left) { return left == 0b1001 || left == 0b0110; });
    }

    // Whether a triangle stays at one border of the extents. Its bounds are those of GroundPlates, with its longest
    // side for those along the horizon and along the vertical.
    [[nodiscard]] bool isSkirt(const Corners& corners) {
        if (_places.empty()) _places.resize(_mesh.size());
        Interval latitude, longitude, altitude;
        double longest2 = 0.0, nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            std::optional<Geodetic>& place = _places[corners[k]];
            if (!place) place = placeOf(corners[k]);
            const auto joined = [k](const Interval& range, double value) {
                if (k == 0) return Interval{value, value};
                return Interval{std::min(range.lower, value), std::max(range.upper, value)};
            };
            latitude = joined(latitude, place->latitude);
            longitude = joined(longitude, place->longitude);
            altitude = joined(altitude, place->altitude);
            const glm::dvec3 v = _mesh.vertex(corners[k]), side = _mesh.vertex(corners[(k + 1) % 3]) - v;
            longest2 = std::max(longest2, glm::dot(side, side));
            nearest = std::min(nearest, axisDistanceOf(_ellipsoid, v));
        }
        const double radius = 0.9 * smallestCurvatureRadius(_ellipsoid), axisDistance = 0.95 * nearest;
        const double longest = std::sqrt(longest2);
        const TriangleSides sides = TriangleSides::atAnyPoint(longest, longest, longest, radius);
        const TriangleReach reach(sides, _ellipsoid, radius, axisDistance);
        const Interval lowered{altitude.lower - reach.sag, altitude.upper};
        if (!TriangleReach::holdsFor(sides, radius, axisDistance, longitude.width(), lowered)) return false;
        forEachQuarter(_extents.latitude(), _extents.longitude(),
                       {latitude.lower - reach.aside, latitude.upper + reach.aside},
                       {_middle + longitude.lower - reach.around, _middle + longitude.upper + reach.around},
                       [&](std::size_t quarter) {
                           _found.skirtTops[quarter] = std::max(_found.skirtTops[quarter], altitude.upper);
                       });
        const auto isAtBorder = [](const Interval& met, double around, const Interval& of, double middle) {
            const double room = kBorder * of.width() - around;
            return middle + met.upper <= of.lower + room || middle + met.lower >= of.upper - room;
        };
        return isAtBorder(latitude, reach.aside, _extents.latitude(), 0.0) ||
               isAtBorder(longitude, reach.around, _extents.longitude(), _middle);
    }

    const Ellipsoid& _ellipsoid;
    const EcefMesh& _mesh;
    const GeodeticBin& _extents;
    const double _middle;
    std::vector<std::optional<Geodetic>> _places;  // of skirts
    std::size_t _rows = 0, _columns = 0;
    PostGrid _found;
};

}  // namespace

std::optional<PostGrid> postGridOf(const Ellipsoid& ellipsoid, const EcefMesh& mesh, const GeodeticBin& extents) {
    return GridSearch(ellipsoid, mesh, extents).run();
}

}  // namespace osgAnalyticBin::core
