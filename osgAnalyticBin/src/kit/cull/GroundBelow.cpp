// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GroundBelow.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../tile/EachNode.h"
#include "../tile/InstalledTile.h"

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

// The corners of the triangle that was met, in ECEF; all zero where OSG does not say.
std::array<glm::dvec3, 3> triangleOf(const Intersector::Intersection& hit, const osg::Matrixd& localToEcef) {
    const osg::Geometry* const geometry = hit.drawable ? hit.drawable->asGeometry() : nullptr;
    const auto* const vertices = geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
    std::array<glm::dvec3, 3> triangle{};
    if (!vertices || hit.indexList.size() != 3) return triangle;
    osg::Matrixd toEcef = localToEcef;
    if (hit.matrix) toEcef.preMult(*hit.matrix);
    for (std::size_t i = 0; i < 3; ++i) {
        if (hit.indexList[i] >= vertices->size()) return {};
        triangle[i] = toGlm(osg::Vec3d((*vertices)[hit.indexList[i]]) * toEcef);
    }
    return triangle;
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

bool GroundBelow::isTriangleBelow(const glm::dvec3& eye, const glm::dvec3& up) const {
    const auto& [a, b, c] = _triangle;
    const double ab = glm::dot(up, glm::cross(a - eye, b - eye));
    const double bc = glm::dot(up, glm::cross(b - eye, c - eye));
    const double ca = glm::dot(up, glm::cross(c - eye, a - eye));
    const bool isWithin = (ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0);
    return isWithin &&
           (ab * glm::dot(up, c - eye) + bc * glm::dot(up, a - eye) + ca * glm::dot(up, b - eye)) / (ab + bc + ca) <
               0.0;
}

bool GroundBelow::isBelow(const core::Geodetic& eye, osg::Node& mesh, const AnalyticBinCullCallback& tile,
                          const core::Ellipsoid& ellipsoid) {
    if (overhang(tile) > 0.0) return false;
    const glm::dvec3 point = ellipsoid.toEcef(eye);
    const glm::dvec3 up = ellipsoid.up(eye.latitude, eye.longitude);
    // a mesh may change without a word: a result is used for a few frames only
    constexpr int kMostUses = 16;
    const InstalledTile* const installed = tile.getInstalledTile();
    const bool isChanged = !installed || installed->has(InstalledTile::MeshChanged);
    const bool isSame = !isChanged && _mesh.get() == &mesh && _tile.get() == &tile && ++_uses < kMostUses;
    if (isSame && isTriangleBelow(point, up)) return true;
    _mesh = nullptr;
    const auto ecefToLocal = affineInverse(tile.getLocalToEcef());
    if (!ecefToLocal || !hasMesh(mesh)) return false;

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
    const Intersector::Intersection& highest = *intersector->getIntersections().begin();
    const glm::dvec3 hit = toGlm(highest.getWorldIntersectPoint() * tile.getLocalToEcef());
    if (!(glm::dot(hit - point, up) < 0.0)) return false;
    _triangle = triangleOf(highest, tile.getLocalToEcef());
    _mesh = &mesh;
    _tile = &tile;
    _uses = 0;
    return true;
}

}  // namespace osgAnalyticBin
