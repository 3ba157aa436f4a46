// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// OccluderNodes and bins. Oracle: OSG alone.

#include "ApplicationGlobe.h"
#include "CameraGlobe.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/ConvexPlanarOccluder>
#include <osg/OccluderNode>

#include <array>
#include <set>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin {
namespace {

using test::osgVector;

using osg::CullSettings;
using test::CullView;
using test::kEarthRadius;

using Corners = std::array<osg::Vec3d, 4>;

struct Wall {
    Corners corners;
    std::vector<Corners> holes;

    [[nodiscard]] osg::ref_ptr<osg::OccluderNode> node() const {
        osg::ref_ptr<osg::ConvexPlanarOccluder> occluder = new osg::ConvexPlanarOccluder;
        for (const osg::Vec3d& corner : corners) occluder->getOccluder().add(osg::Vec3(corner));
        for (const Corners& hole : holes) {
            osg::ConvexPlanarPolygon polygon;
            for (const osg::Vec3d& corner : hole) polygon.add(osg::Vec3(corner));
            occluder->addHole(polygon);
        }
        osg::ref_ptr<osg::OccluderNode> result = new osg::OccluderNode;
        result->setOccluder(occluder.get());
        result->setCullingActive(false);
        return result;
    }
};

// A camera above the globe, and walls in the way of its sight.
struct WalledView {
    CullView view;
    osg::Vec3d eye, forward, right, up;
    double altitude = 0.0;

    explicit WalledView(test::Random& random) {
        altitude = random.logUniform(1e6, 1e7);
        eye = osgVector(random.direction()) * (kEarthRadius + altitude);
        const osg::Vec3d target = osgVector(random.direction()) * (0.5 * kEarthRadius);
        view = CullView::lookAt(eye, target, osgVector(random.direction()), 70.0);
        // OSG drops occluders whose shadow is a small part of the frustum
        view.projection = osg::Matrixd::perspective(70.0, 1.0, 0.05 * altitude, altitude + 2 * kEarthRadius);
        view.cullingMode |= CullSettings::SHADOW_OCCLUSION_CULLING;
        const osg::Matrixd toWorld = osg::Matrixd::inverse(view.modelView);
        forward = osg::Matrixd::transform3x3(osg::Vec3d(0, 0, -1), toWorld);
        right = osg::Matrixd::transform3x3(osg::Vec3d(1, 0, 0), toWorld);
        up = osg::Matrixd::transform3x3(osg::Vec3d(0, 1, 0), toWorld);
    }

    [[nodiscard]] Wall randomWall(test::Random& random) const {
        const double distance = random.uniform(0.1, 0.5) * altitude;
        const osg::Vec3d middle =
            eye + (forward + right * random.uniform(-0.4, 0.4) + up * random.uniform(-0.4, 0.4)) * distance;
        const osg::Vec3d x = (right + forward * random.uniform(-0.5, 0.5)) * (distance * random.uniform(0.2, 0.6));
        const osg::Vec3d y = (up + forward * random.uniform(-0.5, 0.5)) * (distance * random.uniform(0.2, 0.6));
        const auto rectangle = [&](double size) {
            return Corners{middle - x * size - y * size, middle + x * size - y * size, middle + x * size + y * size,
                           middle - x * size + y * size};
        };
        Wall wall{rectangle(1.0), {}};
        if (random.uniform(0, 1) < 0.3) wall.holes.push_back(rectangle(random.uniform(0.2, 0.6)));
        return wall;
    }
};

// What is drawn of a globe's tiles behind walls.
std::set<std::size_t> drawnBehind(const std::vector<Wall>& walls, test::MeshGlobe& globe, const CullView& view) {
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    for (const Wall& wall : walls) scene->addChild(wall.node());
    scene->addChild(globe.root);
    const auto drawn = test::cull(*scene, view, *globe.visitor, ++globe.frame).drawn;
    std::set<std::size_t> numbers;
    for (std::size_t i = 0; i < globe.tiles.size(); ++i) {
        if (drawn.count(test::drawableOf(*globe.tiles[i]))) numbers.insert(i);
    }
    return numbers;
}

TEST(Occluders, LeaveTilesToOsgsSpheres) {
    test::MeshGlobe plain, installed;
    installBins(*installed.root);
    test::Random random(90);
    std::size_t hidden = 0, culled = 0;
    for (int i = 0; i < 60; ++i) {
        WalledView walled(random);
        std::vector<Wall> walls;
        for (int k = 0; k < 3; ++k) walls.push_back(walled.randomWall(random));
        const std::set<std::size_t> drawn = drawnBehind(walls, installed, walled.view);
        EXPECT_EQ(drawn, drawnBehind(walls, plain, walled.view)) << i;
        walled.view.cullingMode &= ~CullSettings::SHADOW_OCCLUSION_CULLING;
        const std::size_t inView = drawnBehind(walls, plain, walled.view).size();
        hidden += inView - drawn.size();
        culled += inView - drawnBehind(walls, installed, walled.view).size();
    }
    EXPECT_GT(hidden, 60u);
    EXPECT_GT(culled, 60u) << "bins, in views without occluders";
}

}  // namespace
}  // namespace osgAnalyticBin
