// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Coarse meshes beside a pole, whose stored bins are right: the bound of such a mesh that the check has is rough in
// latitude, which is no reason to call the bin too small. Oracle of the bins: core::GeodeticMeshBounds. False bins
// elsewhere are in FalseBinTest.cpp; the tiles that this was found with in applications/osgbinglobe.

#include "DatabaseFixture.h"
#include "TileFixture.h"

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>

#include <support/CapturedNotes.h>

namespace osgAnalyticBin::test {
namespace {

const std::string kTooSmall = "larger than the bin stored with it or above it";
constexpr unsigned int kCoarsePosts = 3;
constexpr double kMarginAngle = 0.01 / 6.4e6;  // metres, as an angle

struct CoarseTile {
    osg::ref_ptr<osg::Group> node;
    core::GeodeticBin bin;
};

CoarseTile makeCoarseTile(const core::GeodeticBin& extents) {
    const osg::ref_ptr<osg::Node> mesh = makeMeshTile(extents, 0.0, kCoarsePosts);
    core::GeodeticMeshBounds bounds(core::Ellipsoid(6378137.0, 6356752.314245), extents.center().longitude);
    for (const EcefTriangle& triangle : drawnTriangles(*mesh).surface) {
        for (const glm::dvec3& corner : triangle) bounds.expandByVertex(corner);
        bounds.expandByTriangle(triangle[0], triangle[1], triangle[2]);
    }
    CoarseTile tile{new osg::Group, bounds.bin()};
    tile.node->addChild(mesh);
    return tile;
}

// A square of so many degrees; its nearer edge so many rows of such tiles from the pole.
core::GeodeticBin besidePole(bool isNorth, double width, int rows) {
    const double near = 90.0 - width * rows;
    return isNorth ? extentsDeg(near - width, near, 10.0, 10.0 + width)
                   : extentsDeg(-near, -near + width, 10.0, 10.0 + width);
}

// What is culled by after the bin has been stored and compared with the mesh.
AnalyticBin installedWith(const CoarseTile& tile, const AnalyticBin& stored) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    setStoredBin(*tile.node, stored);
    root->addChild(tile.node);
    EXPECT_EQ(installBins(*root), 1U);
    return installedOn(*tile.node)->getBin();
}

TEST(StoredBinNearPole, ThatIsRightIsNoFalseAlarm) {
    const CapturedNotes notes;
    for (const bool isNorth : {false, true}) {
        for (const double width : {11.25, 5.625, 2.8125, 1.40625, 0.3515625}) {
            for (const int rows : {1, 2, 3}) {
                const CoarseTile tile = makeCoarseTile(besidePole(isNorth, width, rows));
                const AnalyticBin stored = AnalyticBin::fromText(AnalyticBin(tile.bin, 0.01).toText());
                EXPECT_EQ(installedWith(tile, stored), stored) << isNorth << ' ' << width << ' ' << rows;
            }
        }
    }
    EXPECT_EQ(notes.count(kTooSmall), 0U);
}

TEST(StoredBinNearPole, ThatEndsTooEarlyIsWidened) {
    for (const bool isNorth : {false, true}) {
        for (const double width : {5.625, 1.40625, 0.3515625}) {
            for (const int rows : {1, 2, 3}) {
                const CoarseTile tile = makeCoarseTile(besidePole(isNorth, width, rows));
                const core::Interval& latitude = tile.bin.latitude();
                const double quarter = 0.25 * latitude.width();
                for (const core::Interval& range : {core::Interval{latitude.lower + quarter, latitude.upper},
                                                    core::Interval{latitude.lower, latitude.upper - quarter}}) {
                    const CapturedNotes notes;
                    const AnalyticBin stored(core::GeodeticBin(range, tile.bin.longitude(), tile.bin.altitude()), 0.01);
                    const core::Interval widened = installedWith(tile, stored).bin().latitude();
                    EXPECT_LE(widened.lower - latitude.lower, kMarginAngle) << isNorth << ' ' << width;
                    EXPECT_LE(latitude.upper - widened.upper, kMarginAngle) << isNorth << ' ' << width;
                    EXPECT_EQ(notes.count(kTooSmall), 1U) << isNorth << ' ' << width << ' ' << rows;
                }
            }
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
