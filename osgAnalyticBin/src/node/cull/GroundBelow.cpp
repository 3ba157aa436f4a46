// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GroundBelow.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../install/MeshCulling.h"

#include <glm/geometric.hpp>
#include <osg/Geode>
#include <osg/Geometry>
#include <osgTerrain/TerrainTile>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

using Intersector = osgUtil::LineSegmentIntersector;

// OSG's own takes all children of a Geode for drawables.
class MeshIntersection : public osgUtil::IntersectionVisitor {
public:
    using osgUtil::IntersectionVisitor::apply;
    using osgUtil::IntersectionVisitor::IntersectionVisitor;
    void apply(osg::Geode& geode) override { apply(static_cast<osg::Group&>(geode)); }
};

// Made in the update traversal, and not to be made here, where others may cull the same tile.
bool hasMesh(osg::Node& mesh) {
    bool has = true;
    forEachNode(mesh, [&has](osg::Node& node) {
        const auto* const tile = dynamic_cast<const osgTerrain::TerrainTile*>(&node);
        has = has && (!tile || (tile->getTerrainTechnique() && tile->getDirtyMask() == 0));
    });
    return has;
}

// Metres by which what is drawn may lie outside of the mesh.
double overhang(const AnalyticBinCullCallback& tile) {
    return tile.getTerrainShape() ? tile.getTerrainShape()->techniqueMargin : 0.0;
}

}  // namespace

bool isInColumn(const core::Geodetic& place, const AnalyticBinCullCallback& tile, const core::Ellipsoid& ellipsoid) {
    const core::GeodeticBin& bin = tile.getBin().bin();
    if (bin.empty()) return true;
    const core::Interval& latitude = bin.latitude();
    constexpr double kCurved = 1.1;  // arcs are longer than chords
    const double north = kCurved * overhang(tile) / core::smallestCurvatureRadius(ellipsoid);
    if (place.latitude < latitude.lower - north || place.latitude > latitude.upper + north) return false;
    if (north == 0.0) return bin.contains({place.latitude, place.longitude, bin.altitude().middle()});
    const double east = north / std::max(std::cos(std::abs(place.latitude) + north), 1e-9);
    return std::abs(std::remainder(place.longitude - bin.longitude().middle(), 2.0 * osg::PI)) <=
           0.5 * bin.longitude().width() + east;
}

bool isGroundBelow(const core::Geodetic& eye, osg::Node& mesh, const AnalyticBinCullCallback& tile,
                   const core::Ellipsoid& ellipsoid) {
    const auto ecefToLocal = affineInverse(tile.getLocalToEcef());
    if (overhang(tile) > 0.0 || !ecefToLocal || !hasMesh(mesh)) return false;
    const double room = 1.0 + tile.getBin().margin();
    const double top = std::max(tile.getBinHigh(), eye.altitude) + room;
    const double bottom = std::min(tile.getBinLow(), eye.altitude) - room;
    if (!std::isfinite(top) || !std::isfinite(bottom)) return false;
    const auto at = [&](double altitude) {
        return toOsg(ellipsoid.toEcef({eye.latitude, eye.longitude, altitude})) * *ecefToLocal;
    };
    const osg::ref_ptr<Intersector> intersector = new Intersector(at(top), at(bottom));
    MeshIntersection visitor(intersector);
    mesh.accept(visitor);
    if (!intersector->containsIntersections()) return false;
    // the first is the highest
    const osg::Vec3d highest = intersector->getIntersections().begin()->getWorldIntersectPoint();
    const glm::dvec3 up = ellipsoid.up(eye.latitude, eye.longitude);
    return glm::dot(toGlm(highest * tile.getLocalToEcef()) - ellipsoid.toEcef(eye), up) < 0.0;
}

}  // namespace osgAnalyticBin
