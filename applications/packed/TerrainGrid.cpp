// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainGrid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

struct Turn {
    double sine;
    double cosine;
};

Turn turnOf(double degrees) {
    const double angle = glm::radians(degrees);
    return {std::sin(angle), std::cos(angle)};
}

glm::dvec3 rounded(const glm::dvec3& point, double quantum) {
    return {std::nearbyint(point.x / quantum) * quantum, std::nearbyint(point.y / quantum) * quantum,
            std::nearbyint(point.z / quantum) * quantum};
}

// Part of the format: vertices are rounded to quanta, and an index knows them by their bits. Ellipsoid's own formula
// differs from this one in the last bit.
double squaredEccentricity(const core::Ellipsoid& ellipsoid) {
    const double ratio = ellipsoid.polarRadius() / ellipsoid.equatorialRadius();
    return 1.0 - ratio * ratio;
}

double primeVerticalRadius(const core::Ellipsoid& ellipsoid, double sinLatitude) {
    return ellipsoid.equatorialRadius() / std::sqrt(1.0 - squaredEccentricity(ellipsoid) * sinLatitude * sinLatitude);
}

// The posts of a grid in space; sines and cosines are those of whole rows and columns.
class Posts {
public:
    explicit Posts(const TerrainGrid& grid) : _grid(grid) {
        const double columns = static_cast<double>(grid.columns);
        const std::int64_t rows = grid.columns / 2;
        for (int i = -1; i <= grid.cells + 1; ++i) {
            const std::int64_t row = std::clamp<std::int64_t>(grid.firstRow + i, 0, rows);
            _latitudes.push_back(turnOf(-90.0 + 180.0 * static_cast<double>(row) / static_cast<double>(rows)));
            _radii.push_back(primeVerticalRadius(grid.ellipsoid, _latitudes.back().sine));
            _longitudes.push_back(turnOf(-180.0 + 360.0 * static_cast<double>(grid.firstColumn + i) / columns));
        }
    }

    [[nodiscard]] glm::dvec3 ecef(int column, int row) const {
        const Turn& lat = latitude(row);
        const Turn& lon = longitude(column);
        const double n = _radii[static_cast<std::size_t>(row + 1)];
        const double altitude = _grid.height(column, row);
        const double rho = (n + altitude) * lat.cosine;
        return {rho * lon.cosine, rho * lon.sine,
                (n * (1.0 - squaredEccentricity(_grid.ellipsoid)) + altitude) * lat.sine};
    }
    [[nodiscard]] glm::dvec3 up(int column, int row) const {
        const Turn& lat = latitude(row);
        return {lat.cosine * longitude(column).cosine, lat.cosine * longitude(column).sine, lat.sine};
    }
    [[nodiscard]] glm::dvec3 north(int column, int row) const {
        const Turn& lat = latitude(row);
        return {-lat.sine * longitude(column).cosine, -lat.sine * longitude(column).sine, lat.cosine};
    }

    // In east, north, up.
    [[nodiscard]] glm::dvec3 local(const glm::dvec3& ecef, int column, int row) const {
        const Turn& lat = latitude(row);
        const Turn& lon = longitude(column);
        const double outward = ecef.x * lon.cosine + ecef.y * lon.sine;
        return {ecef.y * lon.cosine - ecef.x * lon.sine, ecef.z * lat.cosine - outward * lat.sine,
                outward * lat.cosine + ecef.z * lat.sine};
    }

private:
    [[nodiscard]] const Turn& latitude(int row) const { return _latitudes[static_cast<std::size_t>(row + 1)]; }
    [[nodiscard]] const Turn& longitude(int column) const { return _longitudes[static_cast<std::size_t>(column + 1)]; }

    const TerrainGrid& _grid;
    std::vector<Turn> _latitudes;
    std::vector<Turn> _longitudes;
    std::vector<double> _radii;
};

// South, north, west, east: the post at a distance along an edge.
struct EdgePost {
    EdgePost(int cells, std::size_t edge, int along)
        : column(edge < 2 ? along : (edge == 2 ? 0 : cells)), row(edge < 2 ? (edge == 0 ? 0 : cells) : along) {}
    int column;
    int row;
};

std::size_t surfaceIndex(int cells, int column, int row) {
    return static_cast<std::size_t>(row * (cells + 1) + column);
}

template <typename Function>
void forSkirtPosts(int cells, const Function& function) {
    for (std::size_t edge = 0; edge < 4; ++edge) {
        for (int along = 0; along <= cells; ++along) {
            const EdgePost post(cells, edge, along);
            function(edge, static_cast<std::size_t>(along), post.column, post.row);
        }
    }
}

// Of a surface's vertices, those of the skirts repeat what stands above them.
template <typename Array>
void repeatAtSkirts(int cells, Array& array) {
    forSkirtPosts(cells, [&](std::size_t, std::size_t, int column, int row) {
        array.push_back(typename Array::value_type(array[surfaceIndex(cells, column, row)]));
    });
}

osg::ref_ptr<osg::Vec3Array> normalsOf(const TerrainGrid& grid, const Posts& posts) {
    const int width = grid.cells + 3;
    std::vector<glm::dvec3> points;
    points.reserve(grid.heights.size());
    for (int row = -1; row <= grid.cells + 1; ++row)
        for (int column = -1; column <= grid.cells + 1; ++column) points.push_back(posts.ecef(column, row));
    const auto point = [&](int column, int row) -> const glm::dvec3& {
        return points[static_cast<std::size_t>((row + 1) * width + column + 1)];
    };
    const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    normals->reserve(static_cast<std::size_t>((grid.cells + 1) * (grid.cells + 5)));
    for (int row = 0; row <= grid.cells; ++row) {
        const bool isSouthPole = grid.firstRow + row == 0;
        const bool isNorthPole = grid.firstRow + row == grid.columns / 2;
        for (int column = 0; column <= grid.cells; ++column) {
            const glm::dvec3 east = point(column + 1, row) - point(column - 1, row);
            const glm::dvec3 north = point(column, row + 1) - point(column, row - 1);
            const glm::dvec3 normal = isSouthPole   ? glm::dvec3(0.0, 0.0, -1.0)
                                      : isNorthPole ? glm::dvec3(0.0, 0.0, 1.0)
                                                    : glm::normalize(glm::cross(east, north));
            normals->push_back(osg::Vec3f(osg::Vec3d(normal.x, normal.y, normal.z)));
        }
    }
    repeatAtSkirts(grid.cells, *normals);
    return normals;
}

struct SnowStop {
    double latitudeDeg;
    double height;
};

// The snow line is highest in the dry belts. The southern hemisphere is colder from the middle latitudes on.
constexpr std::array<SnowStop, 11> kSnow{{{-90.0, -500.0},
                                          {-66.0, -500.0},
                                          {-60.0, 300.0},
                                          {-45.0, 2000.0},
                                          {-30.0, 5200.0},
                                          {-18.0, 5600.0},
                                          {0.0, 4900.0},
                                          {25.0, 5700.0},
                                          {36.0, 5500.0},
                                          {47.0, 2900.0},
                                          {62.0, 1500.0}}};
constexpr std::array<SnowStop, 4> kArcticSnow{{{62.0, 1500.0}, {70.0, 800.0}, {80.0, 200.0}, {90.0, -500.0}}};

template <std::size_t Count>
double between(const std::array<SnowStop, Count>& stops, double latitudeDeg) {
    std::size_t i = 1;
    while (i + 1 < Count && stops[i].latitudeDeg < latitudeDeg) ++i;
    const double share = (latitudeDeg - stops[i - 1].latitudeDeg) / (stops[i].latitudeDeg - stops[i - 1].latitudeDeg);
    return stops[i - 1].height + std::clamp(share, 0.0, 1.0) * (stops[i].height - stops[i - 1].height);
}

// Height in metres above which snow stays, about as on earth; below 0 where all land is white.
double snowLine(double latitudeDeg) {
    return latitudeDeg < kSnow.back().latitudeDeg ? between(kSnow, latitudeDeg) : between(kArcticSnow, latitudeDeg);
}

// Share of snow on the ground, 0 to 1: none in the sea, less on steep ground.
// `normalLocal`: unit length, in east, north, up.
double snowShare(double height, double snowLine, const glm::dvec3& normalLocal) {
    constexpr double kFringe = 700.0;
    if (height <= 0.0 || height <= snowLine - 0.5 * kFringe) return 0.0;
    const double share = glm::smoothstep(0.0, 1.0, (height - snowLine + 0.5 * kFringe) / kFringe);
    return share * (0.4 + 0.6 * glm::smoothstep(0.0, 1.0, (normalLocal.z - 0.5) / 0.35));
}

// How much slopes are exaggerated for posts at this distance in metres: coarse grids know gentle slopes only.
double exaggerationFor(double spacing) {
    constexpr double kTrue = 100.0;
    return std::clamp(std::sqrt(std::sqrt(spacing / kTrue)) * 1.3, 1.0, 5.0);
}

// Factor of the brightness of ground that is lit from the north-west, 1 where it is level.
// `exaggeration`: of its slope.
double shadeOf(const glm::dvec3& normalLocal, double exaggeration) {
    // From the north-west, 45 degrees high. Slopes towards the light shine less than those away from it lie in the
    // dark.
    constexpr float kLight = 0.70710678F;
    constexpr float kDarkest = 0.35F;
    constexpr float kBrightest = 1.3F;
    // Single precision is enough for a colour.
    const auto east = static_cast<float>(exaggeration * normalLocal.x);
    const auto north = static_cast<float>(exaggeration * normalLocal.y);
    const auto up = std::max(static_cast<float>(normalLocal.z), 1e-3F);
    const float shade = (kLight * (north - east) + up) / std::sqrt(east * east + north * north + up * up);
    return static_cast<double>(std::clamp(shade < 1.0F ? shade : 1.0F + 0.7F * (shade - 1.0F), kDarkest, kBrightest));
}

// Snow and shade for the colours of a grid's posts.
class ReliefPainter {
public:
    ReliefPainter(const TerrainGrid& grid, const Posts& posts) : _grid(grid), _posts(posts) {
        _exaggeration = exaggerationFor(glm::two_pi<double>() * grid.ellipsoid.equatorialRadius() /
                                        static_cast<double>(grid.columns));
        for (int row = 0; row <= grid.cells; ++row)
            _snowLines.push_back(
                snowLine(-90.0 + 360.0 * static_cast<double>(grid.firstRow + row) / static_cast<double>(grid.columns)));
    }

    [[nodiscard]] osg::Vec4ub painted(const osg::Vec4ub& colour, const osg::Vec3f& normal, int column, int row) const {
        const double height = _grid.height(column, row);
        const glm::dvec3 local = _posts.local({normal.x(), normal.y(), normal.z()}, column, row);
        constexpr double kWhite = 248.0;
        // Water dims what lies below.
        constexpr double kSeaShade = 0.5;
        const double snow = snowShare(height, _snowLines[static_cast<std::size_t>(row)], local);
        double shade = shadeOf(local, _exaggeration);
        if (height <= 0.0) shade = 1.0 + kSeaShade * (shade - 1.0);
        const double white = snow * kWhite;
        const auto part = [&](unsigned char c) {
            return static_cast<unsigned char>(std::min(shade * (c * (1.0 - snow) + white) + 0.5, 255.0));
        };
        return {part(colour.r()), part(colour.g()), part(colour.b()), colour.a()};
    }

private:
    const TerrainGrid& _grid;
    const Posts& _posts;
    double _exaggeration;
    std::vector<double> _snowLines;
};

osg::ref_ptr<osg::Vec4ubArray> coloursOf(const TerrainGrid& grid, const Posts& posts, const osg::Vec3Array& normals) {
    const bool isPlain = grid.colours.size() < 2;
    const osg::ref_ptr<osg::Vec4ubArray> colours =
        new osg::Vec4ubArray(isPlain ? osg::Array::BIND_OVERALL : osg::Array::BIND_PER_VERTEX);
    colours->setNormalize(true);
    if (isPlain) {
        colours->push_back(osg::Vec4ub(255, 255, 255, 255));
        return colours;
    }
    colours->reserve(static_cast<std::size_t>((grid.cells + 1) * (grid.cells + 5)));
    std::optional<ReliefPainter> painter;
    if (grid.relief) painter.emplace(grid, posts);
    for (int row = 0; row <= grid.cells; ++row) {
        for (int column = 0; column <= grid.cells; ++column) {
            const osg::Vec4ub colour = colourAt(grid.colours, grid.height(column, row));
            const osg::Vec3f& normal = normals[surfaceIndex(grid.cells, column, row)];
            colours->push_back(painter ? painter->painted(colour, normal, column, row) : colour);
        }
    }
    repeatAtSkirts(grid.cells, *colours);
    return colours;
}

std::vector<glm::dvec3> verticesOf(const TerrainGrid& grid, const Posts& posts) {
    const int cells = grid.cells;
    std::vector<glm::dvec3> vertices;
    vertices.reserve(static_cast<std::size_t>((cells + 1) * (cells + 5)));
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) vertices.push_back(posts.ecef(column, row));
    forSkirtPosts(cells, [&](std::size_t edge, std::size_t along, int column, int row) {
        const TerrainGrid::Skirt& skirt = grid.skirts[edge];
        const double outward = edge == 1 ? TerrainGrid::kStep : -TerrainGrid::kStep;
        vertices.push_back(vertices[surfaceIndex(cells, column, row)] -
                           TerrainGrid::kStep * skirt.depth[along] * posts.up(column, row) +
                           outward * skirt.lean[along] * posts.north(column, row));
    });
    for (glm::dvec3& vertex : vertices) vertex = rounded(vertex, grid.quantum);
    return vertices;
}

}  // namespace

const std::vector<TerrainGrid::ColourStop>& hypsometricStops() {
    // The coast is a step, so that it shows. High ground is bare: snow depends on the latitude too, and comes on top.
    static const std::vector<TerrainGrid::ColourStop> stops{
        {-11000.0F, {6, 18, 58}},   {-6000.0F, {14, 44, 104}},  {-3500.0F, {24, 70, 138}}, {-1500.0F, {44, 104, 166}},
        {-200.0F, {96, 158, 196}},  {-0.5F, {146, 196, 214}},   {0.0F, {74, 120, 66}},     {150.0F, {98, 140, 74}},
        {500.0F, {148, 164, 92}},   {1000.0F, {184, 172, 112}}, {2000.0F, {172, 140, 94}}, {3200.0F, {146, 116, 86}},
        {4500.0F, {152, 132, 112}}, {6500.0F, {172, 162, 152}}};
    return stops;
}

osg::Vec4ub colourAt(const std::vector<TerrainGrid::ColourStop>& stops, double height) {
    const double clamped =
        std::clamp(height, static_cast<double>(stops.front().height), static_cast<double>(stops.back().height));
    std::size_t i = 1;
    while (i + 1 < stops.size() && stops[i].height < clamped) ++i;
    const TerrainGrid::ColourStop& a = stops[i - 1];
    const TerrainGrid::ColourStop& b = stops[i];
    const double share = (clamped - a.height) / (static_cast<double>(b.height) - a.height);
    // half is added and cut off: numbers are positive
    const auto mixed = [&](std::size_t c) {
        return static_cast<unsigned char>(a.colour[c] + share * (b.colour[c] - a.colour[c]) + 0.5);
    };
    return {mixed(0), mixed(1), mixed(2), 255};
}

std::vector<glm::dvec3> verticesOf(const TerrainGrid& grid) {
    return verticesOf(grid, Posts(grid));
}

std::vector<std::uint16_t> trianglesOf(int cells) {
    std::vector<std::uint16_t> indices;
    const auto add = [&indices](std::size_t a, std::size_t b, std::size_t c) {
        for (const std::size_t i : {a, b, c}) indices.push_back(static_cast<std::uint16_t>(i));
    };
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const std::size_t southWest = surfaceIndex(cells, column, row);
            const std::size_t northEast = surfaceIndex(cells, column + 1, row + 1);
            add(southWest, southWest + 1, northEast);
            add(southWest, northEast, northEast - 1);
        }
    }
    for (std::size_t edge = 0; edge < 4; ++edge) {
        const bool runsRight = edge == 0 || edge == 3;  // as seen from outside the tile
        const auto top = [&](int along) {
            const EdgePost post(cells, edge, along);
            return surfaceIndex(cells, post.column, post.row);
        };
        const std::size_t foot = static_cast<std::size_t>(cells + 1) * (static_cast<std::size_t>(cells + 1) + edge);
        for (int i = 0; i < cells; ++i) {
            const int left = runsRight ? i : i + 1;
            const int right = runsRight ? i + 1 : i;
            add(foot + static_cast<std::size_t>(left), foot + static_cast<std::size_t>(right), top(right));
            add(foot + static_cast<std::size_t>(left), top(right), top(left));
        }
    }
    return indices;
}

void addTextureCoordinates(int cells, int textureSize, osg::Vec2Array& coordinates) {
    const auto coordinate = [&](int along) {
        const float share = static_cast<float>(along) / static_cast<float>(cells);
        return (0.5F + share * static_cast<float>(textureSize - 1)) / static_cast<float>(textureSize);
    };
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column)
            coordinates.push_back(osg::Vec2(coordinate(column), coordinate(row)));
    repeatAtSkirts(cells, coordinates);
}

void fillGeometry(const TerrainGrid& grid, osg::Geometry& geometry) {
    const Posts posts(grid);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const std::vector<glm::dvec3> ecef = verticesOf(grid, posts);
    vertices->reserve(ecef.size());
    for (const glm::dvec3& vertex : ecef) {
        const glm::dvec3 local = vertex - grid.origin;
        vertices->push_back(osg::Vec3f(osg::Vec3d(local.x, local.y, local.z)));
    }
    geometry.setVertexArray(vertices);
    const osg::ref_ptr<osg::Vec3Array> normals = normalsOf(grid, posts);
    geometry.setNormalArray(normals);
    geometry.setColorArray(coloursOf(grid, posts, *normals));
    geometry.setUseDisplayList(false);
    geometry.setUseVertexBufferObjects(true);
}

}  // namespace osgAnalyticBin
