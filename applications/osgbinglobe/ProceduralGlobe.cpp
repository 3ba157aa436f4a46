// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ProceduralGlobe.h"

#include "GlmBridge.h"

#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <osg/Geometry>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::globe {

using tiles::PostId;
using tiles::TileId;

namespace {

constexpr double kStep = TerrainGrid::kStep;
// Of heights to whole steps.
constexpr double kRounding = 0.5 * kStep;

// Of the relief, how much is coloured as the bottom of a sea.
constexpr double kSea = 0.45;
// No terrain is higher, metres.
constexpr double kHighest = 20000.0;
// Factor of second derivatives, for what is left out.
constexpr double kHigherOrders = 1.1;
// Half diagonals from its middle at which a tile is refined.
constexpr double kLod = 4.0;

constexpr const char* kWkt =
    "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
    "UNIT[\"degree\",0.0174532925199433]]";

constexpr double kLongestWave = 5.0e6;  // metres
constexpr double kWaveRadius = 6.37e6;  // metres, for the length of waves alone
constexpr double kLacunarity = 1.6;
// Amplitudes fall a little more slowly than wave lengths: finer slopes are steeper.
constexpr double kPersistence = 0.6866;

core::Interval sineOver(double from, double to) {
    core::Interval range{std::min(std::sin(from), std::sin(to)), std::max(std::sin(from), std::sin(to))};
    const auto holds = [&](double angle) {
        return std::floor((to - angle) / glm::two_pi<double>()) > std::floor((from - angle) / glm::two_pi<double>());
    };
    if (holds(glm::half_pi<double>())) range.upper = 1.0;
    if (holds(-glm::half_pi<double>())) range.lower = -1.0;
    return range;
}

}  // namespace

ProceduralTerrain::ProceduralTerrain(double relief) noexcept : _middle(0.5 * relief) {
    constexpr double kGoldenAngle = 2.399963229728653;
    double sum = 0.0;
    double share = 1.0;
    double frequency = glm::two_pi<double>() * kWaveRadius / kLongestWave;
    for (std::size_t i = 0; i < kWaves; ++i) {
        // Directions spread over the sphere, in an order without neighbours.
        const double place = (static_cast<double>((i * 12 + 5) % kWaves) + 0.5) / kWaves;
        const double z = 1.0 - 2.0 * place;
        const double ring = std::sqrt(1.0 - z * z);
        const double angle = kGoldenAngle * static_cast<double>(i);
        _waves[i] = {{ring * std::cos(angle), ring * std::sin(angle), z}, frequency, angle, share};
        sum += share;
        share *= kPersistence;
        frequency *= kLacunarity;
    }
    for (Wave& wave : _waves) wave.amplitude *= _middle / sum;
}

double ProceduralTerrain::height(const tiles::PositionDeg& position) const noexcept {
    const double latitude = glm::radians(position.latitudeDeg);
    const double longitude = glm::radians(position.longitudeDeg);
    const glm::dvec3 up(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                        std::sin(latitude));
    double height = _middle;
    for (const Wave& wave : _waves)
        height += wave.amplitude * std::sin(wave.frequency * glm::dot(wave.direction, up) + wave.phase);
    return height;
}

core::Interval ProceduralTerrain::heightsIn(const tiles::RectDeg& rect) const noexcept {
    // Of rounding: sines of arguments up to 1e7, and all sums.
    constexpr double kSlack = 1e-6;
    const core::GeodeticBin directions =
        core::GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, {0.0, 0.0});
    const core::ExactGeodeticBin patch(core::Ellipsoid(1.0, 1.0), directions, 0.0);
    core::Interval heights{_middle - kSlack, _middle + kSlack};
    for (const Wave& wave : _waves) {
        const core::Interval along = patch.distanceRange({wave.direction, 0.0});
        const core::Interval sine =
            sineOver(wave.frequency * along.lower + wave.phase, wave.frequency * along.upper + wave.phase);
        heights.lower += wave.amplitude * sine.lower;
        heights.upper += wave.amplitude * sine.upper;
    }
    return heights;
}

double ProceduralTerrain::interpolationError(double spacing) const noexcept {
    double error = 0.0;
    for (const Wave& wave : _waves) {
        // The second derivative along a circle of the sphere: of the wave, and of the circle.
        const double along = wave.frequency * spacing;
        error += wave.amplitude * std::min(2.0, 0.125 * (along * along + along * spacing));
    }
    return error;
}

ProceduralGlobe::ProceduralGlobe(const GlobeOptions& options)
    : _options(options), _layout(options.cells, options.levels, defaultEllipsoid()), _terrain(GlobeOptions::kRelief) {}

// How far the edge of a mesh may be above or below the terrain: heights between posts and their rounding, and the sag
// of the chords.
double ProceduralGlobe::edgeError(int level) const noexcept {
    const double spacing = glm::radians(_layout.spacingDeg(level));
    const double radius = _layout.ellipsoid().equatorialRadius() + kHighest;
    return _terrain.interpolationError(spacing) + kRounding + kHigherOrders * 0.125 * radius * spacing * spacing;
}

double ProceduralGlobe::skirtDepth(int level) const noexcept {
    return kStep * std::ceil((edgeError(level) + edgeError(std::max(0, level - 1))) / kStep);
}

// Steps. A chord between posts of a parallel runs poleward of it, by up to a sixteenth of the square of the spacing in
// radians; seen from above that opens a strip, over which the skirts lean.
std::int32_t ProceduralGlobe::skirtLean(int level) const noexcept {
    const double spacing = glm::radians(_layout.spacingDeg(std::max(0, level - 1)));
    const double metres = kHigherOrders * 0.0625 * spacing * spacing * _layout.ellipsoid().equatorialRadius();
    return static_cast<std::int32_t>(std::nearbyint(metres / kStep));
}

// The box of all meshes of one level in a tile's rectangle, the tile's own or those of its descendants.
core::GeodeticBin ProceduralGlobe::meshBox(const TileId& tile, int level, const core::Interval& heights) const {
    const tiles::RectDeg rect = tile.rect();
    constexpr double kLeastRadius = 6.2e6;  // of a meridian's curves, at the feet of skirts
    const double leanDeg = glm::degrees(kStep * skirtLean(tile.level) / kLeastRadius);
    const core::GeodeticBin grown =
        core::GeodeticBin::fromDegrees({rect.south - leanDeg, rect.north + leanDeg}, {rect.west, rect.east}, heights);
    const auto posts = (static_cast<std::size_t>(_layout.cells()) << (level - tile.level)) + 1;
    const double depth = skirtDepth(level);
    const core::GeodeticGridBounds bounds(_layout.ellipsoid(), {grown.latitude(), grown.longitude(), posts, posts},
                                          kHighest + depth);
    return {bounds.latitude(), grown.longitude(), {heights.lower - bounds.sag() - depth, heights.upper}};
}

AnalyticBin ProceduralGlobe::binOf(const TileId& tile, const core::Interval& own) const {
    core::GeodeticBin box = meshBox(tile, tile.level, own);
    if (hasChildren(tile)) {
        // Deeper levels sag less, and hang less.
        const core::Interval below = _terrain.heightsIn(tile.rect());
        box.expandBy(meshBox(tile, tile.level + 1, {below.lower - kRounding, below.upper + kRounding}));
    }
    // Of vertices that are rounded to whole quanta, and to floats where these run out.
    return AnalyticBin(box, 2.0 * _layout.quantum(tile.level));
}

AnalyticBin ProceduralGlobe::binOf(const TileId& tile) const {
    return binOf(tile, tiles::heightsOf(gridOf(tile)));
}

TerrainGrid ProceduralGlobe::gridOf(const TileId& tile) const {
    TerrainGrid grid = tiles::gridWithoutHeights(_layout, tile);
    const auto postAt = [&](int column, int row) {
        return PostId{tile.level, grid.firstColumn + column, grid.firstRow + row};
    };
    for (int row = -1; row <= grid.cells + 1; ++row)
        for (int column = -1; column <= grid.cells + 1; ++column)
            grid.heights.push_back(static_cast<std::int32_t>(
                std::nearbyint(_terrain.height(_layout.position(postAt(column, row))) / kStep)));
    tiles::placeOrigin(grid, _layout, tile.level);
    const auto posts = static_cast<std::size_t>(grid.cells + 1);
    const auto depth = static_cast<std::int32_t>(skirtDepth(tile.level) / kStep);
    for (const tiles::Edge edge : tiles::kEdges) {
        // eastern and western neighbours share a meridian, and beyond a pole there is none
        const bool leans = edge <= tiles::Edge::North && tile.neighbour(edge);
        const std::int32_t lean = leans ? skirtLean(tile.level) : 0;
        grid.skirts[static_cast<std::size_t>(edge)] = {std::vector<std::int32_t>(posts, depth),
                                                       std::vector<std::int32_t>(posts, lean)};
    }
    grid.colours = hypsometricStops();
    for (TerrainGrid::ColourStop& stop : grid.colours) stop.height += static_cast<float>(kSea * GlobeOptions::kRelief);
    return grid;
}

osg::ref_ptr<osg::Node> ProceduralGlobe::tileNode(const TileId& tile, tiles::SharedParts& shared) const {
    const TerrainGrid grid = gridOf(tile);
    const osg::ref_ptr<osg::Geometry> geometry = tiles::makeGeometry(grid, nullptr, false);
    shared.addTo(*geometry, 0);
    const osg::ref_ptr<osg::Node> placed = tiles::makePlaced(*geometry, grid.origin);
    const core::Interval own = tiles::heightsOf(grid);
    const double surfaceLow = meshBox(tile, tile.level, own).altitude().lower + skirtDepth(tile.level);
    const tiles::TileFacts facts{binOf(tile, own), surfaceLow, _layout, kLod,
                                 hasChildren(tile) ? childrenFileOf(tile, _options) : ""};
    osg::ref_ptr<osg::Node> node = tiles::makeTileNode(tile, *placed, facts);
    if (!_options.bins) node->setUserDataContainer(nullptr);
    return node;
}

osg::ref_ptr<osg::Node> ProceduralGlobe::children(const TileId& tile) const {
    tiles::SharedParts shared(_layout.cells(), false);
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const TileId& child : tile.children()) group->addChild(tileNode(child, shared));
    return group;
}

osg::ref_ptr<osg::Node> ProceduralGlobe::root() const {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = tiles::makeRoot(_layout.ellipsoid(), kWkt);
    tiles::SharedParts shared(_layout.cells(), false);
    for (const TileId& tile : _layout.startTiles()) root->addChild(tileNode(tile, shared));
    if (_options.bins) tiles::declareHorizon(*root);
    return root;
}

}  // namespace osgAnalyticBin::globe
