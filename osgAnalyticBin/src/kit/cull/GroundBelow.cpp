// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GroundBelow.h"

#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../tile/EachNode.h"

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

// OSG makes meshes of terrain tiles in the update traversal. It must not make them here: other threads may cull the
// tile.
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

}  // namespace

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

bool GroundBelow::isBelow(const core::Geodetic& eye, const Ground& ground, const core::Ellipsoid& ellipsoid) {
    const glm::dvec3 point = ellipsoid.toEcef(eye);
    const glm::dvec3 up = ellipsoid.up(eye.latitude, eye.longitude);
    // an application may change a mesh without saying so: a result is used for about a second
    constexpr int kMostUses = 60;
    const bool isSame = ground.isAsRead && _mesh.get() == &ground.mesh && _localToEcef == ground.localToEcef;
    if (isSame && ++_uses < kMostUses && isTriangleBelow(point, up)) return true;
    _mesh = nullptr;
    const auto ecefToLocal = affineInverse(ground.localToEcef);
    if (!ecefToLocal || !hasMesh(ground.mesh)) return false;

    const double top = std::max(ground.high, eye.altitude) + 1.0;
    const double bottom = std::min(ground.low, eye.altitude) - 1.0;
    if (!std::isfinite(top) || !std::isfinite(bottom)) return false;
    const auto at = [&](double altitude) {
        return toOsg(ellipsoid.toEcef({eye.latitude, eye.longitude, altitude})) * *ecefToLocal;
    };
    const osg::ref_ptr<Intersector> intersector = new Intersector(at(top), at(bottom));
    MeshIntersection visitor(intersector);
    ground.mesh.accept(visitor);
    if (!intersector->containsIntersections()) return false;
    // the first is the highest
    const Intersector::Intersection& highest = *intersector->getIntersections().begin();
    const glm::dvec3 hit = toGlm(highest.getWorldIntersectPoint() * ground.localToEcef);
    if (!(glm::dot(hit - point, up) < 0.0)) return false;
    _triangle = triangleOf(highest, ground.localToEcef);
    _mesh = &ground.mesh;
    _localToEcef = ground.localToEcef;
    _uses = 0;
    return true;
}

}  // namespace osgAnalyticBin
