// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Surfaces of tiles on ellipsoids from an 11 km body to Saturn, oblate and prolate extremes, each of them in metres, in
// kilometres and with an equatorial radius of one. Oracle: samples of the triangles that are drawn, taken back to
// latitude, longitude and altitude.

#include "TileSurfaceCases.h"

#include <support/Planets.h>

namespace osgAnalyticBin::test::surfaces {
namespace {

// Of the equatorial radius.
constexpr double kDeepSkirt = 0.005;
constexpr double kRelief = 0.001;

class PlanetSurface : public ::testing::TestWithParam<Planet> {
protected:
    void setUnit(double unit) {
        ellipsoid = GetParam().in(unit);
        radius = ellipsoid.equatorialRadius();
        model = new osg::EllipsoidModel(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    }

    Random random{2300};
    core::Ellipsoid ellipsoid{1.0, 1.0};
    double radius = 1.0;
    osg::ref_ptr<osg::EllipsoidModel> model;
};

// South, east, north, west: the lowest of the chords between the posts of an edge.
std::array<double, 4> edgeTruth(const core::Ellipsoid& ellipsoid, const std::vector<EcefTriangle>& triangles,
                                unsigned int posts) {
    const unsigned int cells = posts - 1;
    std::array<double, 4> lows;
    lows.fill(std::numeric_limits<double>::infinity());
    const auto chord = [&](double& low, const glm::dvec3& p, const glm::dvec3& q) {
        for (int k = 0; k <= 8; ++k) low = std::min(low, ellipsoid.toGeodetic(p + k / 8.0 * (q - p)).altitude);
    };
    for (unsigned int i = 0; i < cells; ++i) {
        const EcefTriangle& south = triangles[2 * i];                              // a, b, d
        const EcefTriangle& east = triangles[2 * (i * cells + cells - 1)];         // a, b, d
        const EcefTriangle& north = triangles[2 * ((cells - 1) * cells + i) + 1];  // a, d, c
        const EcefTriangle& west = triangles[2 * (i * cells) + 1];                 // a, d, c
        chord(lows[0], south[0], south[1]);
        chord(lows[1], east[1], east[2]);
        chord(lows[2], north[1], north[2]);
        chord(lows[3], west[0], west[2]);
    }
    return lows;
}

TEST_P(PlanetSurface, HoldsMeshes) {
    for (const double unit : GetParam().units()) {
        setUnit(unit);
        for (const double south : {-70.0, -10.0, 0.0, 35.0, 69.0}) {
            const GeodeticBin extents = GeodeticBin::fromDegrees({south, south + 20.0}, {170.0, 190.0}, {0.0, 0.0});
            const double low = random.uniform(-kRelief, kRelief) * radius;
            const double high = low + (random.chance(0.5) ? 0.0 : kRelief * radius);
            const VpbMesh mesh{extents, 9, kDeepSkirt * radius, low, high};
            const auto tile = makeVpbTile(mesh, random, *model);
            const TileSurface surface = tileSurface(*tile, *model, osg::Matrixd());
            ASSERT_TRUE(surface.bin.valid()) << unit << " at " << south;
            EXPECT_NEAR(surface.skirt, mesh.skirt, 1e-6 * radius);
            EXPECT_LE(surface.bin.margin(), 4e-7 * radius);
            const std::vector<EcefTriangle> triangles = surfaceTriangles(*tile, mesh.posts);
            const auto samples = samplesOf(triangles, 8);
            EXPECT_LE(metresOutside(surface.bin, samples, ellipsoid), surface.bin.margin()) << unit << " at " << south;
            const core::Interval truth = altitudesOf(samples, ellipsoid);
            const double rounding = 1e-5 * radius;
            const core::Interval& bound = surface.bin.bin().altitude();
            EXPECT_LE(bound.upper, truth.upper + rounding);
            EXPECT_GE(bound.lower, truth.lower - surface.bin.sag() - rounding);
            EXPECT_LE(surface.bin.sag(), 1.8 * (high - truth.lower) + rounding);
            const std::array<double, 4> edges = edgeTruth(ellipsoid, triangles, mesh.posts);
            for (std::size_t edge = 0; edge < edges.size(); ++edge) {
                EXPECT_LE(surface.edgeLow[edge], edges[edge] + 1e-8 * radius) << unit << " edge " << edge;
                EXPECT_GE(surface.edgeLow[edge], bound.lower);
            }
        }
    }
}

TEST_P(PlanetSurface, HoldsTerrainTiles) {
    for (const double unit : GetParam().units()) {
        setUnit(unit);
        const bool isEarthLike = std::abs(ellipsoid.eccentricitySquared()) < 0.1;
        for (const double south : {-90.0, -45.0, 0.0, 35.0}) {
            for (const float scale : {1.0f, 3.0f, 0.25f, -2.0f}) {
                const GeodeticBin extents = GeodeticBin::fromDegrees({south, south + 45.0}, {-45.0, 0.0}, {0.0, 0.0});
                const double low = random.uniform(-0.002, 0.002) * radius;
                const auto tile = makeTerrainTile(extents, 17, 17, [&](unsigned int, unsigned int) {
                    return static_cast<float>(low + random.uniform() * kRelief * radius);
                });
                tile->getElevationLayer()->getLocator()->setEllipsoidModel(model);
                const TileSurface surface = tileSurface(*tile, *model, osg::Matrixd());
                ASSERT_EQ(surface.bin.valid(), isEarthLike) << unit << " at " << south;
                if (!isEarthLike) continue;
                EXPECT_LE(surface.bin.margin(), 2e-7 * std::max(radius, ellipsoid.polarRadius()));
                const auto samples = samplesOf(drawnTriangles(*tile, scale).surface, 4);
                ASSERT_FALSE(samples.empty());
                const AnalyticBin bin = surface.bin.exaggerated(static_cast<double>(scale));
                EXPECT_LE(metresOutside(bin, samples, ellipsoid), bin.margin())
                    << unit << " at " << south << " scale " << scale;
                if (scale != 1.0f) continue;
                const double truth = altitudesOf(samples, ellipsoid).lower;
                EXPECT_GE(bin.bin().altitude().lower, truth - surface.bin.sag() - bin.margin());
            }
        }
    }
}

// Mountains of small bodies are a tenth of their radius high; what is far above any is no terrain, in any unit.
TEST_P(PlanetSurface, TellsTerrainFromWhatIsNone) {
    for (const double unit : GetParam().units()) {
        setUnit(unit);
        const GeodeticBin extents = GeodeticBin::fromDegrees({10.0, 15.0}, {20.0, 25.0}, {0.0, 0.0});
        const auto isKnown = [&](double altitude) {
            const auto tile = makeVpbTile({extents, 9, kDeepSkirt * radius, altitude, altitude}, random, *model);
            return tileSurface(*tile, *model, osg::Matrixd()).bin.valid();
        };
        const double metres = radius / GetParam().equatorialRadius;
        const double mountain = std::min(22000.0 * metres, 0.09 * std::min(radius, ellipsoid.polarRadius()));
        EXPECT_TRUE(isKnown(mountain));
        EXPECT_TRUE(isKnown(-std::min(mountain, 0.05 * ellipsoid.polarRadius())));
        EXPECT_FALSE(isKnown(0.12 * std::max(radius, ellipsoid.polarRadius())));
        EXPECT_FALSE(isKnown(-0.2 * std::max(radius, ellipsoid.polarRadius())));
    }
}

INSTANTIATE_TEST_SUITE_P(All, PlanetSurface, ::testing::ValuesIn(kPlanets),
                         [](const auto& planet) { return std::string(planet.param.name); });

}  // namespace
}  // namespace osgAnalyticBin::test::surfaces
