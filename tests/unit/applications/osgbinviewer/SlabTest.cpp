// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Slabs as they are drawn. Oracle: the exact bin, and pictures.

#include "DrawnViewer.h"
#include "ViewTools.h"

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <osg/CoordinateSystemNode>

#include <DatabaseFixture.h>
#include <algorithm>

namespace osgAnalyticBin::viewer {
namespace {

const core::Ellipsoid kEarth(6378137.0, 6356752.3142);
constexpr double kSag = 500.0;

core::GeodeticBin binDeg(core::Interval latitude, core::Interval longitude, core::Interval altitude) {
    return core::GeodeticBin::fromDegrees(latitude, longitude, altitude);
}

const core::GeodeticBin kBins[] = {binDeg({10, 11}, {20, 21}, {-500, 4000}),
                                   binDeg({-45, 0}, {90, 135}, {-12000, 3000}), binDeg({30, 50}, {170, 200}, {0, 9000}),
                                   binDeg({67.5, 90}, {-180, -157.5}, {0, 10}),
                                   binDeg({-90, 90}, {-180, 180}, {-100, 100})};

TEST(Slab, HoldsTheBinButForTheSagOfItsSides) {
    for (const core::GeodeticBin& bin : kBins) {
        const SlabMesh mesh = slabMesh(bin, kEarth);
        const core::ExactGeodeticBin exact(kEarth, bin);
        for (int i = 0; i < 200; ++i) {
            const double z = -1.0 + 2.0 * (i + 0.5) / 200.0;
            const double r = std::sqrt(1.0 - z * z);
            const osg::Vec3d direction(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z);
            double farthest = -1e9;
            for (const osg::Vec3& vertex : mesh.vertices)
                farthest = std::max(farthest, (osg::Vec3d(vertex) + mesh.origin) * direction);
            EXPECT_NEAR(farthest, exact.support({direction.x(), direction.y(), direction.z()}), kSag);
        }
    }
}

class SlabPicture : public test::DrawnViewer {
protected:
    void SetUp() override {
        DrawnViewer::SetUp();
        if (IsSkipped()) return;
        _viewer.setLightingMode(osg::View::NO_LIGHT);
        _viewer.getCamera()->setClearColor(osg::Vec4(0.0F, 0.0F, 0.0F, 1.0F));
    }

    // Straight down, or with `away`, so far to the south of what is looked at, metres.
    void lookAt(double latitudeDeg, double longitudeDeg, double altitude, double away) {
        const osg::EllipsoidModel ellipsoid(kEarth.equatorialRadius(), kEarth.polarRadius());
        osg::Matrixd toWorld;
        ellipsoid.computeLocalToWorldTransformFromLatLongHeight(osg::DegreesToRadians(latitudeDeg),
                                                                osg::DegreesToRadians(longitudeDeg), 0.0, toWorld);
        const osg::Vec3d eye = osg::Vec3d(0.0, -away, altitude) * toWorld;
        const osg::Vec3d north = osg::Matrixd::transform3x3(osg::Vec3d(0.0, 1.0, 0.0), toWorld);
        _viewer.getCamera()->setViewMatrixAsLookAt(eye, toWorld.getTrans(), north);
        const double farthest = 3.0 * (altitude + away);
        _viewer.getCamera()->setProjectionMatrixAsPerspective(40.0, 1.0, 5e-4 * farthest, farthest);
    }

    [[nodiscard]] osg::ref_ptr<osg::Image> pictureOf(const std::vector<osg::ref_ptr<osg::Node>>& nodes) {
        const osg::ref_ptr<osg::Group> scene = new osg::Group;
        constexpr GLenum kDepthClamp = 0x864F;
        scene->getOrCreateStateSet()->setMode(kDepthClamp, osg::StateAttribute::ON);
        for (const auto& node : nodes) scene->addChild(node);
        _viewer.setSceneData(scene);
        return picture(_viewer);
    }

    static std::size_t bluePixels(const osg::Image& image) {
        std::size_t count = 0;
        for (unsigned int i = 0; i < image.getTotalSizeInBytes(); i += 3)
            count += image.data()[i + 2] > image.data()[i] ? 1U : 0U;
        return count;
    }
};

// Flat and blue, with posts at other places than the slab's.
osg::ref_ptr<osg::Node> makeSea(const core::GeodeticBin& bin) {
    const auto sea = test::makeMeshTile(bin, 0.0, 65);
    const osg::Vec4 blue[] = {osg::Vec4(0.0F, 0.0F, 1.0F, 1.0F)};
    osg::Geometry& mesh = *sea->getChild(0)->asGeode()->getDrawable(0)->asGeometry();
    mesh.setColorArray(new osg::Vec4Array(1, blue), osg::Array::BIND_OVERALL);
    return sea;
}

TEST_F(SlabPicture, LiesOnFlatTerrainFromFarAndNear) {
    const core::GeodeticBin bin = binDeg({22.5, 45.0}, {0.0, 22.5}, {0.0, 0.0});
    const osg::Vec4 red(1.0F, 0.0F, 0.0F, 1.0F);
    const osg::ref_ptr<osg::Node> slab = makeSlab(slabMesh(bin, kEarth), red, red, 21);
    const osg::ref_ptr<osg::Node> sea = makeSea(bin);
    for (const auto& [altitude, away] : {std::pair(1e7, 0.0), {5e5, 1e6}, {5e4, 1e5}, {1e4, 3e4}}) {
        lookAt(33.7, 11.3, altitude, away);
        EXPECT_GT(bluePixels(*pictureOf({sea})), 1000u) << altitude;
        EXPECT_EQ(bluePixels(*pictureOf({sea, slab})), 0u) << altitude;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::viewer
