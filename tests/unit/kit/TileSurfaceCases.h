// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Places and sizes of tiles whose surfaces the tests ask for.

#pragma once

#include "KitTest.h"

namespace osgAnalyticBin::test::surfaces {

using core::GeodeticBin;

inline const osg::ref_ptr<osg::EllipsoidModel> kModel = new osg::EllipsoidModel;
inline const core::Ellipsoid kEllipsoid(kModel->getRadiusEquator(), kModel->getRadiusPolar());

inline TileSurface surfaceOf(osg::Node& node, double sampleRatio = 1.0) {
    return tileSurface(node, *kModel, osg::Matrixd(), sampleRatio);
}

inline core::Interval altitudesOf(const std::vector<glm::dvec3>& points,
                                  const core::Ellipsoid& ellipsoid = kEllipsoid) {
    core::Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const glm::dvec3& point : points) {
        const double altitude = ellipsoid.toGeodetic(point).altitude;
        range = {std::min(range.lower, altitude), std::max(range.upper, altitude)};
    }
    return range;
}

struct TileCase {
    const char* name;
    GeodeticBin extents;
    unsigned int columns, rows;
};

// From the whole globe down to a tile of 20 metres between posts.
inline std::vector<TileCase> tileCases() {
    const auto rect = [](double south, double west, double north, double east) {
        return GeodeticBin::fromDegrees({south, north}, {west, east}, {0, 0});
    };
    return {{"globe", rect(-90, -180, 90, 180), 64, 64},      {"coarse globe", rect(-90, -180, 90, 180), 16, 9},
            {"hemisphere", rect(-90, -180, 90, 0), 64, 64},   {"north pole", rect(45, 0, 90, 90), 64, 64},
            {"south pole", rect(-90, -45, -67.5, 0), 16, 16}, {"date line", rect(40, 170, 50, 190), 33, 17},
            {"flat", rect(-22.5, 90, 0, 112.5), 8, 8},        {"across the equator", rect(-10, 10, 20, 30), 20, 30},
            {"south", rect(-60, 10, -45, 40), 20, 20},        {"small", rect(47, 10, 47.01, 10.02), 64, 64}};
}

// A mesh as VirtualPlanetBuilder makes it: texture coordinates, skirts of one depth, in the frame of its centre.
struct VpbMesh {
    GeodeticBin extents;
    unsigned int posts = 17;
    double skirt = 5000.0;
    double low = -500.0, high = 3000.0;
    bool doSkirtsLean = false;  // to the east of the geocentric vertical, by 1.7 degrees at the equator
};

inline osg::ref_ptr<osg::MatrixTransform> makeVpbTile(const VpbMesh& c, Random& random,
                                                      const osg::EllipsoidModel& model = *kModel) {
    const core::Ellipsoid ellipsoid(model.getRadiusEquator(), model.getRadiusPolar());
    const core::Geodetic center{c.extents.latitude().middle(), c.extents.longitude().middle(), 0.0};
    osg::Matrixd frame;
    model.computeLocalToWorldTransformFromLatLongHeight(center.latitude, center.longitude, 0.0, frame);
    const osg::Matrixd toLocal = osg::Matrixd::inverse(frame);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec2Array> texCoords = new osg::Vec2Array;
    const osg::ref_ptr<osg::DrawElementsUShort> triangles = gridTriangles<osg::DrawElementsUShort>(c.posts);
    const unsigned int n = c.posts;
    const auto add = [&](unsigned int i, unsigned int j, double altitude, double leaning = 0.0) {
        const double u = static_cast<double>(i) / (n - 1);
        const double v = static_cast<double>(j) / (n - 1);
        glm::dvec3 ecef = ellipsoid.toEcef({c.extents.latitude().lower + v * c.extents.latitude().width(),
                                            c.extents.longitude().lower + u * c.extents.longitude().width(), altitude});
        const glm::dvec3 up = glm::normalize(ecef);
        ecef -= leaning * glm::normalize(up - 0.03 * glm::dvec3(-up.y, up.x, 0.0));
        vertices->push_back(osg::Vec3(osg::Vec3d(ecef.x, ecef.y, ecef.z) * toLocal));
        texCoords->push_back(osg::Vec2(static_cast<float>(u), static_cast<float>(v)));
    };
    std::vector<double> altitudes;
    for (unsigned int post = 0; post < n * n; ++post) {
        altitudes.push_back(random.uniform(c.low, c.high));
        add(post % n, post / n, altitudes.back());
    }
    const std::vector<unsigned int> border = gridBorder(n);
    for (const unsigned int post : border)
        if (c.skirt > 0.0 && c.doSkirtsLean)
            add(post % n, post / n, altitudes[post], c.skirt);
        else if (c.skirt > 0.0)
            add(post % n, post / n, altitudes[post] - c.skirt);
    for (std::size_t k = 0; k < border.size() && c.skirt > 0.0; ++k) {
        const std::size_t next = (k + 1) % border.size(), bottom = n * n;
        for (const std::size_t i : {bottom + k, bottom + next, std::size_t{border[next]}, bottom + k,
                                    std::size_t{border[next]}, std::size_t{border[k]}})
            triangles->push_back(static_cast<GLushort>(i));
    }
    const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(vertices, triangles);
    geometry->setTexCoordArray(0, texCoords);
    return placed(geometry, frame);
}

// The triangles with the skirts left out, by the order in which makeVpbTile() adds them.
inline std::vector<EcefTriangle> surfaceTriangles(osg::MatrixTransform& tile, unsigned int posts) {
    std::vector<EcefTriangle> triangles = drawnTriangles(tile).surface;
    triangles.resize(2 * (posts - 1) * (posts - 1));
    return triangles;
}

}  // namespace osgAnalyticBin::test::surfaces
