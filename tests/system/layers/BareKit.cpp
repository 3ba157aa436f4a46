// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The kit without its parts for indexes and occlusion: it links, and culls a tile beyond the horizon and none in sight.

#include "../../../osgAnalyticBin/src/kit/tile/TerrainHider.h"
#include "../../../osgAnalyticBin/src/kit/tile/TileBoundsSource.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <osg/CoordinateSystemNode>
#include <osg/Geode>
#include <osg/Geometry>
#include <osgUtil/CullVisitor>

#include <cstdio>

namespace osgAnalyticBin {

ChosenIndex chooseIndex(const std::string&, const osgDB::Options*, IndexUse) {
    return {};
}

osg::ref_ptr<TerrainHider> makeTerrainHider() {
    return nullptr;
}

}  // namespace osgAnalyticBin

namespace {

using namespace osgAnalyticBin;

// One degree beside the equator.
osg::ref_ptr<osg::Geode> makeTile(const osg::EllipsoidModel& ellipsoid, double west) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (int i = 0; i < 4; ++i) {
        osg::Vec3d place;
        ellipsoid.convertLatLongHeightToXYZ(osg::DegreesToRadians(i / 2 ? 1.0 : 0.0),
                                            osg::DegreesToRadians(west + i % 2), 0.0, place.x(), place.y(), place.z());
        vertices->push_back(place);
    }
    const osg::ref_ptr<osg::Geometry> mesh = new osg::Geometry;
    mesh->setVertexArray(vertices);
    mesh->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
    osg::ref_ptr<osg::Geode> tile = new osg::Geode;
    tile->addDrawable(mesh);
    setStoredBin(*tile,
                 AnalyticBin(core::GeodeticBin::fromDegrees({0.0, 1.0}, {west, west + 1.0}, {-500.0, 10.0}), 1.0));
    return tile;
}

BinCounts countsFrom(osg::Node& scene, const osg::Vec3d& eye, const osg::Vec3d& center) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    visitor->setStateGraph(new osgUtil::StateGraph);
    visitor->setRenderStage(new osgUtil::RenderStage);
    visitor->setTraversalNumber(1);
    visitor->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    visitor->pushViewport(new osg::Viewport(0, 0, 512, 512));
    visitor->pushProjectionMatrix(new osg::RefMatrix(osg::Matrixd::perspective(40.0, 1.0, 1.0, 1e8)));
    visitor->pushModelViewMatrix(new osg::RefMatrix(osg::Matrixd::lookAt(eye, center, {0, 0, 1})),
                                 osg::Transform::ABSOLUTE_RF);
    scene.accept(*visitor);
    return BinStatistics::of(*visitor).getCounts();
}

}  // namespace

int main() {
    const osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    globe->setEllipsoidModel(new osg::EllipsoidModel);
    const osg::ref_ptr<osg::Group> tiles = new osg::Group;
    for (const double west : {0.0, 90.0}) tiles->addChild(makeTile(*globe->getEllipsoidModel(), west));
    globe->addChild(tiles);
    CullOptions options;
    options.horizonUse = HorizonUse::Given;
    options.horizon = -1000.0;
    const std::size_t installed = installBins(*globe, options);
    const BinCounts counts = countsFrom(*globe, {6.38e6 + 1e6, 0.0, 0.0}, {6.38e6, 1e5, 1e5});
    std::printf("%zu tiles, %u in sight, %u not\n", installed, counts.inside + counts.straddling, counts.outside);
    return installed == 2 && counts.inside + counts.straddling == 1 && counts.outside == 1 ? 0 : 1;
}
