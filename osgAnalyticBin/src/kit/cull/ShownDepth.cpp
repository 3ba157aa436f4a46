// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShownDepth.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../tile/EachNode.h"
#include "../tile/InstalledTile.h"
#include "SelectionWalk.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <glm/geometric.hpp>
#include <osg/Geode>
#include <osg/Geometry>
#include <osgTerrain/TerrainTile>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

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

std::optional<core::Geodetic> placeOf(const Viewpoint& viewpoint, const core::Ellipsoid& ellipsoid) {
    if (!viewpoint.eye()) return std::nullopt;
    return ellipsoid.toGeodetic(*viewpoint.eye());
}

// Whether all that hides is drawn, and the eye is above it.
bool isTrusted(const DatabaseView& view, const SelectionWalk& walk, const std::optional<core::Geodetic>& place) {
    const auto isBelow = [&](const SelectionWalk::NearGround& close) {
        return CullTraversal::of(view.visitor).ground.isBelow(*place, *close.mesh, *close.tile, view.ellipsoid);
    };
    const std::vector<SelectionWalk::NearGround>& ground = walk.nearGround();
    return !walk.hasHole() && std::all_of(ground.begin(), ground.end(), isBelow) && walk.areMeshesDrawn();
}

// Selects for an eye; null: nothing is hidden.
SelectionWalk walkFor(const DatabaseView& view, const core::HorizonEye* eye, const SelectionWalk::Search& search) {
    SelectionWalk walk(view, eye, &search);
    walk.select(view.root);
    return walk;
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

bool GroundBelow::isBelow(const core::Geodetic& eye, osg::Node& mesh, const AnalyticBinCullCallback& tile,
                          const core::Ellipsoid& ellipsoid) {
    if (tile.getTerrainShape() && tile.getTerrainShape()->techniqueMargin > 0.0) return false;
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

std::optional<core::HorizonEye> eyeAboveWhatIsShown(const DatabaseView& view, const Viewpoint& viewpoint,
                                                    double deepest, double& depth) {
    // A deeper occluder has a wider horizon, over which more may be seen that is deeper still. Raised from zero to what
    // is found until nothing deeper is, the depth is the least that will do.
    constexpr int kMostRounds = 16;
    constexpr int kExactRounds = 12;
    constexpr double kRoom = 1.05;
    const core::Ellipsoid& ellipsoid = view.ellipsoid;
    const std::optional<core::Geodetic> place = placeOf(viewpoint, ellipsoid);
    const double step = 500.0 * core::earthScale(ellipsoid);
    depth = std::clamp(depth, 0.0, deepest);
    for (int round = 0; round < kMostRounds; ++round) {
        const auto eye = viewpoint.above(ellipsoid, depth);
        if (!eye && depth >= deepest) break;
        if (!eye) {
            // the eye may stand in a valley below the ellipsoid
            depth = std::min(2.0 * depth + step, deepest);
            continue;
        }
        if (view.region && !view.region->holdsHorizonOf(*eye)) return std::nullopt;
        const SelectionWalk lowest = walkFor(view, &*eye, {place, depth, deepest, view.expectsHole});
        if (lowest.hasHole()) return std::nullopt;
        if (lowest.depth() <= depth) {
            depth = std::max(lowest.depth(), 0.0);
            // a near plane that cuts the terrain shows the inside of the globe, so no deeper occluder may be used
            const double belowEye = place && place->altitude < 0.0 ? step - place->altitude : 0.0;
            const bool isCutOpen = !viewpoint.above(ellipsoid, std::max(depth, belowEye));
            return !isCutOpen && isTrusted(view, lowest, place) ? eye : std::nullopt;
        }
        if (lowest.depth() > 0.25 * ellipsoid.polarRadius()) break;
        depth = std::min((round < kExactRounds ? 1.0 : kRoom) * lowest.depth(), deepest);
    }
    depth = 0.0;
    return std::isfinite(deepest) ? eyeAboveDepth(view, viewpoint, deepest) : std::nullopt;
}

std::optional<core::HorizonEye> eyeAboveDepth(const DatabaseView& view, const Viewpoint& viewpoint, double depth) {
    const core::Ellipsoid& ellipsoid = view.ellipsoid;
    const auto eye = viewpoint.above(ellipsoid, depth);
    if (!eye) return std::nullopt;
    const std::optional<core::Geodetic> place = placeOf(viewpoint, ellipsoid);
    const SelectionWalk walk = walkFor(view, &*eye, {place, depth, depth, view.expectsHole});
    return isTrusted(view, walk, place) ? eye : std::nullopt;
}

bool selectWithoutHorizon(const DatabaseView& view, const Viewpoint& viewpoint) {
    constexpr double kUnknownDepth = std::numeric_limits<double>::infinity();
    const std::optional<core::Geodetic> place = placeOf(viewpoint, view.ellipsoid);
    return isTrusted(view, walkFor(view, nullptr, {place, -kUnknownDepth, kUnknownDepth, view.expectsHole}), place);
}

}  // namespace osgAnalyticBin
