// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileTruth.h"

#include "FrustumHull.h"

#include <osgAnalyticBin/TileSurface.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/Polytope>

#include <algorithm>
#include <cmath>
#include <optional>

namespace osgAnalyticBin::bench {

namespace {

std::vector<core::Plane> frustumPlanes(const osg::Camera& view, const osg::Matrixd& ecefToWorld) {
    osg::Polytope frustum;
    frustum.setToUnitFrustum();
    frustum.transformProvidingInverse(ecefToWorld * view.getViewMatrix() * view.getProjectionMatrix());
    std::vector<core::Plane> planes;
    for (osg::Plane plane : frustum.getPlaneList()) {
        plane.makeUnitLength();
        planes.push_back(toCore(plane));
    }
    return planes;
}

class View {
public:
    View(const osg::Camera& camera, const flight::Globe& globe, const core::Ellipsoid& ellipsoid)
        : _ellipsoid(ellipsoid),
          _eye(toGlm(osg::Vec3d(0.0, 0.0, 0.0) * osg::Matrixd::inverse(camera.getViewMatrix()) *
                     osg::Matrixd::inverse(globe.localToWorld))),
          _planes(frustumPlanes(camera, globe.localToWorld)),
          _hull(_planes, _planes.size()) {}

    /// A map has no horizon.
    void setOccluder(double depth) {
        if (!_ellipsoid.isPlane()) _horizon = core::HorizonEye::fromEye(_ellipsoid, depth, _eye);
    }

    /// Whether the hull of the bin meets the frustum.
    [[nodiscard]] bool meets(const AnalyticBin& shown) const {
        const core::GeodeticBin& bin = shown.bin();
        if (_ellipsoid.isPlane()) {
            const core::QuadraticBin box(core::GeodeticMapping(_ellipsoid), core::parameterBox(bin), shown.margin());
            return meets(box) && !isBeyondAFace(box);
        }
        if (!core::ExactGeodeticBin::holds(_ellipsoid, bin)) return true;
        const core::ExactGeodeticBin exact(_ellipsoid, bin, shown.margin());
        return meets(exact) && !isSeparated(hull::ReverseBin(exact, bin), _hull);
    }

    [[nodiscard]] bool hides(const AnalyticBin& shown) const {
        return _horizon && _horizon->hides(core::HorizonBin(_ellipsoid, shown.bin(), shown.margin()));
    }

    [[nodiscard]] const glm::dvec3& eye() const { return _eye; }

private:
    template <class Bin>
    [[nodiscard]] bool meets(const Bin& bin) const {
        core::PlaneMask undecided = (core::PlaneMask{1} << _planes.size()) - 1;
        return core::classify(bin, _planes, _planes.size(), undecided) != core::Side::Outside &&
               !core::isSeparated(bin, _planes, _planes.size(), undecided, _planes.size());
    }

    // Of the box of a map.
    [[nodiscard]] bool isBeyondAFace(const core::QuadraticBin& box) const {
        for (glm::length_t i = 0; i < 6 && _hull.cornerCount() > 0; ++i) {
            glm::dvec3 outward(0.0);
            outward[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
            if (_hull.isBehind({-outward, box.distanceRange({outward, 0.0}).upper}, box.reach())) return true;
        }
        return false;
    }

    core::Ellipsoid _ellipsoid;
    glm::dvec3 _eye;
    std::vector<core::Plane> _planes;
    hull::FrustumHull _hull;
    std::optional<core::HorizonEye> _horizon;
};

// How far the surface of a sphere of the smaller radius, lowered by a depth, can be seen from an eye above it.
double horizonDistance(const core::Ellipsoid& ellipsoid, double depth, const glm::dvec3& eye) {
    const double radius = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius()) - depth;
    return std::sqrt(std::max(0.0, glm::dot(eye, eye) - radius * radius));
}

// A lower bound of the distance from the eye to the hull of the bin: that to a plane which supports the bin.
double leastDistance(const core::GeodeticBin& bin, const core::Ellipsoid& ellipsoid, const glm::dvec3& eye) {
    const core::ExactGeodeticBin exact(ellipsoid, bin);
    const glm::dvec3 middle = ellipsoid.toEcef(bin.center());
    const double toMiddle = glm::distance(eye, middle);
    if (!(toMiddle > 0.0)) return 0.0;
    glm::dvec3 direction = (eye - middle) / toMiddle;
    double least = std::max(0.0, glm::dot(direction, eye) - exact.support(direction));
    // Each step turns the plane towards the eye, seen from the point of the bin that it touches.
    for (int step = 0; step < 8; ++step) {
        const glm::dvec3 toEye = eye - exact.supportPoint(direction);
        const double length = glm::length(toEye);
        if (!(length > 0.0)) return 0.0;
        direction = glm::normalize(direction + toEye / length);
        least = std::max(least, glm::dot(direction, eye) - exact.support(direction));
    }
    return least;
}

}  // namespace

double occluderDepth(const std::vector<core::GeodeticBin>& bins, const core::Ellipsoid& ellipsoid,
                     const glm::dvec3& eye) {
    if (ellipsoid.isPlane()) return 0.0;
    struct Surface {
        double distance, depth;
    };
    std::vector<Surface> surfaces;
    for (const core::GeodeticBin& bin : bins)
        surfaces.push_back({leastDistance(bin, ellipsoid, eye), -bin.altitude().lower});
    double depth = 0.0;
    for (bool grows = true; grows;) {
        const double horizon = horizonDistance(ellipsoid, depth, eye);
        grows = false;
        for (const Surface& surface : surfaces) {
            if (surface.depth <= depth || surface.distance > horizon) continue;
            depth = surface.depth;
            grows = true;
        }
    }
    return depth;
}

void TileTruth::learnBins(const std::vector<flight::DrawnTile>& tiles) {
    for (const flight::DrawnTile& tile : tiles)
        if (tile.bin.valid()) _bins.insert_or_assign(tile.key, tile.bin);
}

const AnalyticBin& TileTruth::surfaceOf(const flight::DrawnTile& tile, const flight::Globe& globe) {
    const auto [found, isNew] = _surfaces.try_emplace(tile.key);
    if (!isNew) return found->second;
    const osg::Matrixd worldToEcef = osg::Matrixd::inverse(globe.localToWorld);
    for (const flight::DrawnMesh& mesh : tile.meshes) {
        const AnalyticBin own = tileSurface(*mesh.drawable, *globe.ellipsoid, mesh.localToWorld * worldToEcef).bin;
        if (!own.valid()) return found->second = AnalyticBin();
        found->second.expandBy(own);
    }
    return found->second;
}

NeededTiles TileTruth::neededTiles(const std::vector<flight::DrawnTile>& tiles, const osg::Camera& view,
                                   const flight::Globe& globe) {
    const core::Ellipsoid ellipsoid = globe.radii();
    std::vector<core::GeodeticBin> surfaces;
    for (const flight::DrawnTile& tile : tiles)
        if (const AnalyticBin& surface = surfaceOf(tile, globe); surface.valid()) surfaces.push_back(surface.bin());
    View seen(view, globe, ellipsoid);
    seen.setOccluder(occluderDepth(surfaces, ellipsoid, seen.eye()));
    NeededTiles needed;
    for (const flight::DrawnTile& tile : tiles) {
        const auto known = _bins.find(tile.key);
        const AnalyticBin& bin = known == _bins.end() ? surfaceOf(tile, globe) : known->second;
        // A tile without a known bin counts as needed.
        if (bin.valid() && !seen.meets(bin)) continue;
        if (bin.valid() && seen.hides(bin))
            ++needed.hidden;
        else
            needed.keys.insert(tile.key);
    }
    return needed;
}

}  // namespace osgAnalyticBin::bench
