// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainTileSurface.h"

#include "../Classes.h"
#include "../GlmBridge.h"
#include "TerrainLimits.h"

#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>

#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/Layer>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace osgAnalyticBin {

namespace {

// osgTerrain::GeometryTechnique: the grid of a tile without heights, and the coarsest that a sample ratio makes.
constexpr std::size_t kDefaultPosts = 20;
constexpr std::size_t kFewestSampledPosts = 16;
// The vertical scales up to which the sag holds.
constexpr double kLargestScale = 10.0;
constexpr double kLargestCell = 1.0;  // radians
// Vertices are floats about the tile's middle; half a unit in the last place each, in three directions.
constexpr double kVertexRounding = 1.1e-7;
constexpr double kSameRadius = 1e-3;  // metres on the earth
constexpr double kPlacing = 0.01;     // metres on the earth: heights as floats, positions as doubles, radii

// The lowest and highest valid posts of an elevation layer, metres; low > high when there are none.
struct HeightRange {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    // No valid post is infinite or not a number.
    bool isFinite = true;

    [[nodiscard]] static HeightRange flat() { return {0.0, 0.0, true}; }
};

// Minimum, maximum and finiteness of floats, in lanes that the compiler turns into vectors.
struct FloatRange {
    static constexpr std::size_t kLanes = 16;

    void add(const float* values, std::size_t count) {
        std::size_t i = 0;
        for (; i + kLanes <= count; i += kLanes) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const float v = values[i + lane];
                low[lane] = v < low[lane] ? v : low[lane];
                high[lane] = v > high[lane] ? v : high[lane];
                poison[lane] += v - v;  // 0 for finite values only
            }
        }
        for (; i < count; ++i) {
            low[0] = std::min(low[0], values[i]);
            high[0] = std::max(high[0], values[i]);
            poison[0] += values[i] - values[i];
        }
    }

    [[nodiscard]] double lowest() const { return static_cast<double>(*std::min_element(low, low + kLanes)); }
    [[nodiscard]] double highest() const { return static_cast<double>(*std::max_element(high, high + kLanes)); }
    [[nodiscard]] bool isFinite() const {
        return std::all_of(poison, poison + kLanes, [](float p) { return p == 0.0f; });
    }

    float low[kLanes];
    float high[kLanes];
    float poison[kLanes];

    FloatRange() {
        std::fill(low, low + kLanes, std::numeric_limits<float>::infinity());
        std::fill(high, high + kLanes, -std::numeric_limits<float>::infinity());
        std::fill(poison, poison + kLanes, 0.0f);
    }
};

void include(HeightRange& range, float value) {
    range.isFinite &= std::isfinite(value);
    range.low = std::min(range.low, static_cast<double>(value));
    range.high = std::max(range.high, static_cast<double>(value));
}

HeightRange rangeOfAll(const float* values, std::size_t columns, std::size_t rows) {
    FloatRange floats;
    floats.add(values, columns * rows);
    return {floats.lowest(), floats.highest(), floats.isFinite()};
}

// Cost: one pass over the floats, or as many virtual calls where the layer is of another class or picks its posts.
HeightRange heightRange(const osgTerrain::Layer& layer, const osg::HeightField* field) {
    const std::size_t columns = layer.getNumColumns(), rows = layer.getNumRows();
    if (field && columns > 0 && rows > 0 && !layer.getValidDataOperator())
        return rangeOfAll(field->getFloatArray()->asVector().data(), columns, rows);
    HeightRange range;
    for (unsigned int row = 0; row < rows; ++row) {
        for (unsigned int column = 0; column < columns; ++column) {
            float value = 0.0f;
            if (layer.getValidValue(column, row, value)) include(range, value);
        }
    }
    return range;
}

std::size_t sampledPosts(std::size_t posts, double sampleRatio) {
    const float scaled = static_cast<float>(posts) * std::sqrt(static_cast<float>(sampleRatio));
    return std::max(static_cast<std::size_t>(scaled), kFewestSampledPosts);
}

// The rectangle of a locator whose matrix is nothing but extents. `radian`: of its units.
std::optional<core::GeodeticGrid> rectangleOf(const osgTerrain::Locator& locator, double radian) {
    const osg::Matrixd& m = locator.getTransform();
    osg::Matrixd extents;
    extents(0, 0) = m(0, 0);
    extents(1, 1) = m(1, 1);
    extents(3, 0) = m(3, 0);
    extents(3, 1) = m(3, 1);
    if (!(m == extents)) return std::nullopt;
    const auto between = [radian](double from, double width) {
        const double to = (from + width) / radian;
        return width < 0.0 ? core::Interval{to, from / radian} : core::Interval{from / radian, to};
    };
    core::GeodeticGrid grid;
    grid.longitude = between(m(3, 0), m(0, 0));
    grid.latitude = between(m(3, 1), m(1, 1));
    return grid;
}

bool isOnTheGlobe(const core::GeodeticGrid& grid) {
    constexpr double kRounding = 1e-9;
    const bool proper = std::isfinite(grid.longitude.lower) && grid.longitude.width() <= 2.0 * osg::PI + kRounding &&
                        std::abs(grid.longitude.lower) <= 4.0 * osg::PI &&
                        std::abs(grid.latitude.lower) <= osg::PI_2 + kRounding &&
                        std::abs(grid.latitude.upper) <= osg::PI_2 + kRounding;
    return proper && grid.columns >= 2 && grid.rows >= 2 &&
           grid.longitude.width() <= kLargestCell * static_cast<double>(grid.columns - 1) &&
           grid.latitude.width() <= kLargestCell * static_cast<double>(grid.rows - 1);
}

bool isSame(const osg::EllipsoidModel& a, const osg::EllipsoidModel& b) {
    const double same = kSameRadius * core::earthScale(toCore(b));
    return std::abs(a.getRadiusEquator() - b.getRadiusEquator()) <= same &&
           std::abs(a.getRadiusPolar() - b.getRadiusPolar()) <= same;
}

bool standsOn(const osgTerrain::Locator& locator, const osg::EllipsoidModel& ellipsoid) {
    if (!isOneOf<osgTerrain::Locator>(locator)) return false;
    const bool isGeocentric = locator.getCoordinateSystemType() == osgTerrain::Locator::GEOCENTRIC;
    if (isMapPlane(ellipsoid)) return !isGeocentric;
    return isGeocentric && locator.getEllipsoidModel() && isSame(*locator.getEllipsoidModel(), ellipsoid);
}

// What the technique makes a mesh of.
struct TileSource {
    core::GeodeticGrid grid;  // not sampled
    osgTerrain::Layer* layer;
    const osg::HeightField* field;  // null: there is no layer, or one of another class
};

// Returns: nullopt where that is not known, or broken.
std::optional<TileSource> sourceOf(osgTerrain::TerrainTile& tile, const osg::EllipsoidModel& ellipsoid) {
    const osgTerrain::Locator* locator = masterLocator(tile);
    if (!locator || !standsOn(*locator, ellipsoid)) return std::nullopt;
    std::optional<core::GeodeticGrid> grid =
        rectangleOf(*locator, isMapPlane(ellipsoid) ? core::Ellipsoid::kMapUnitsInRadian : 1.0);
    const bool isFar =
        grid && isMapPlane(ellipsoid) &&
        !(largestCoordinate({grid->latitude, grid->longitude, {0.0, 0.0}}) <= core::Ellipsoid::kFarthestInMap);
    osgTerrain::Layer* const layer = tile.getElevationLayer();
    const osg::HeightField* const field = heightField(tile);
    const bool isBroken = !field && dynamic_cast<const osgTerrain::HeightFieldLayer*>(layer);
    if (!grid || isFar || isBroken) return std::nullopt;
    grid->columns = layer ? layer->getNumColumns() : kDefaultPosts;
    grid->rows = layer ? layer->getNumRows() : kDefaultPosts;
    return TileSource{*grid, layer, field};
}

// The middle of the rectangle of a locator, in its units.
osg::Vec3d middleOf(const osgTerrain::Locator& locator) {
    return osg::Vec3d(0.5, 0.5, 0.0) * locator.getTransform();
}

// Metres that a vertex is at most from where the technique stores vertices about: the middle of the tile, or of its
// colours, where these have a place of their own.
double reachOf(osgTerrain::TerrainTile& tile, const core::GeodeticGrid& grid, const core::Ellipsoid& ellipsoid) {
    const double radius = std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius()) + highestTerrain(ellipsoid);
    const osgTerrain::Layer* const colour = tile.getColorLayer(0);
    osg::Vec3d away;
    if (colour && colour->getLocator()) away = middleOf(*colour->getLocator()) - middleOf(*masterLocator(tile));
    const double radian = ellipsoid.isPlane() ? core::Ellipsoid::kMapUnitsInRadian : 1.0;
    const double farthest =
        0.5 * (grid.latitude.width() + grid.longitude.width()) + (std::abs(away.x()) + std::abs(away.y())) / radian;
    return radius * (ellipsoid.isPlane() ? farthest : std::min(2.0, farthest));
}

// By which the whole grid and those of descendants may leave their bin in a map.
double marginInMap(const core::GeodeticGrid& grid, const core::Interval& altitude, double reach) {
    return drawingErrorOf(std::max(reach, largestCoordinate({grid.latitude, grid.longitude, altitude})));
}

double marginOf(double reach, const core::Ellipsoid& ellipsoid) {
    return kVertexRounding * reach + kPlacing * core::earthScale(ellipsoid);
}

}  // namespace

bool isDrawnByOsg(const osgTerrain::TerrainTile& tile) {
    const osgTerrain::TerrainTechnique* technique = tile.getTerrainTechnique();
    return isOneOf<osgTerrain::TerrainTile>(tile) && (!technique || isOneOf<osgTerrain::GeometryTechnique>(*technique));
}

const osgTerrain::Locator* masterLocator(osgTerrain::TerrainTile& tile) {
    const osgTerrain::Layer* elevation = tile.getElevationLayer();
    if (elevation && elevation->getLocator()) return elevation->getLocator();
    const osgTerrain::Layer* colour = tile.getColorLayer(0);
    return colour ? colour->getLocator() : nullptr;
}

const osg::HeightField* heightField(osgTerrain::TerrainTile& tile) {
    const auto* layer = dynamic_cast<osgTerrain::HeightFieldLayer*>(tile.getElevationLayer());
    const osg::HeightField* field =
        layer && isOneOf<osgTerrain::HeightFieldLayer>(*layer) ? layer->getHeightField() : nullptr;
    if (!field || !field->getFloatArray()) return nullptr;
    const std::size_t posts = std::size_t{field->getNumColumns()} * field->getNumRows();
    return field->getFloatArray()->size() >= posts ? field : nullptr;
}

TileSurface terrainTileSurface(osgTerrain::TerrainTile& tile, const osg::EllipsoidModel& ellipsoid,
                               double sampleRatio) {
    const std::optional<TileSource> source = sourceOf(tile, ellipsoid);
    if (!source || !(sampleRatio >= 0.0)) return {};
    auto [grid, layer, field] = *source;
    const HeightRange heights = layer ? heightRange(*layer, field) : HeightRange::flat();
    const core::Ellipsoid model = toCore(ellipsoid);
    const double most = highestTerrain(model);
    if (!heights.isFinite || !(heights.low <= heights.high) || heights.low < -most || heights.high > most) return {};
    if (sampleRatio != 1.0 && grid.columns > kFewestSampledPosts && grid.rows > kFewestSampledPosts) {
        grid.columns = sampledPosts(grid.columns, sampleRatio);
        grid.rows = sampledPosts(grid.rows, sampleRatio);
    }
    if (!isOnTheGlobe(grid)) return {};

    const double skirt = field ? static_cast<double>(field->getSkirtHeight()) : 0.0;
    if (!std::isfinite(skirt)) return {};
    const double highest = kLargestScale * std::max(std::abs(heights.low), std::abs(heights.high));
    const core::GeodeticGridBounds bounds(model, grid, highest, std::max(0.0, skirt));
    if (!bounds.isKnown()) return {};

    if (!(heights.low - bounds.sag() > -core::deepestPost(model))) return {};

    TileSurface surface;
    // a skirt of negative height stands up
    const core::Interval altitude{heights.low - bounds.sag(), heights.high + std::max(0.0, -skirt)};
    const double reach = reachOf(tile, grid, model) + std::abs(skirt);
    const double margin = model.isPlane() ? marginInMap(grid, altitude, reach) : marginOf(reach, model);
    surface.bin = AnalyticBin(core::GeodeticBin(bounds.latitude(), grid.longitude, altitude), margin);
    surface.bin.setSag(bounds.sag());
    surface.skirt = std::max(0.0, skirt);
    surface.isScalable = true;
    return surface;
}

std::optional<core::GeodeticBin> terrainExtents(osgTerrain::TerrainTile& tile, const osg::EllipsoidModel& ellipsoid) {
    const std::optional<TileSource> source = sourceOf(tile, ellipsoid);
    if (!source || !isOnTheGlobe(source->grid)) return std::nullopt;
    osgTerrain::Layer* const layer = source->layer;
    for (unsigned int row = 0; layer && layer->getValidDataOperator() && row < layer->getNumRows(); ++row) {
        for (unsigned int column = 0; column < layer->getNumColumns(); ++column) {
            float height = 0.0f;
            if (!layer->getValidValue(column, row, height)) return std::nullopt;
        }
    }
    return core::GeodeticBin(source->grid.latitude, source->grid.longitude, {0.0, 0.0});
}

std::optional<TerrainPosts> terrainPosts(osgTerrain::TerrainTile& tile, const osg::EllipsoidModel& ellipsoid,
                                         const TerrainShape& shape) {
    if (shape.techniqueMargin != 0.0 || shape.areBoundariesEqual || shape.sampleRatio != 1.0) return std::nullopt;
    if (!isDrawnByOsg(tile)) return std::nullopt;
    const std::optional<TileSource> source = sourceOf(tile, ellipsoid);
    if (!source || !isOnTheGlobe(source->grid)) return std::nullopt;
    const auto [grid, layer, field] = *source;
    // rows from the south, columns from the west
    const osg::Matrixd& extents = masterLocator(tile)->getTransform();
    if (!(extents(0, 0) > 0.0) || !(extents(1, 1) > 0.0)) return std::nullopt;

    // a skirt of negative height stands up
    if (field && !(field->getSkirtHeight() >= 0.0f)) return std::nullopt;
    const core::Ellipsoid model = toCore(ellipsoid);
    const double reach = reachOf(tile, grid, model);
    TerrainPosts posts{grid, {}, model.isPlane() ? 0.0 : marginOf(reach, model), 0.0};
    if (field) posts.skirt = static_cast<double>(field->getSkirtHeight());
    posts.altitudes.reserve(grid.rows * grid.columns);
    for (unsigned int row = 0; row < grid.rows; ++row) {
        for (unsigned int column = 0; column < grid.columns; ++column) {
            float height = 0.0f;
            if (layer && !layer->getValidValue(column, row, height)) return std::nullopt;
            // as the technique multiplies
            posts.altitudes.push_back(static_cast<double>(height * static_cast<float>(shape.verticalScale)));
            const double farthest = reach + std::abs(posts.altitudes.back());
            if (model.isPlane()) posts.margin = std::max(posts.margin, drawingErrorOf(farthest));
        }
    }
    return posts;
}

}  // namespace osgAnalyticBin
