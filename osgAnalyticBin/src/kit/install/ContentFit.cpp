// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ContentFit.h"

#include "../../core/EarthScale.h"
#include "../Classes.h"
#include "../GlmBridge.h"
#include "../Spheres.h"
#include "../cull/CullCallbacks.h"
#include "../database/Database.h"
#include "../tile/InstalledTile.h"
#include "MeshState.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/TileSurface.h>

#include <osg/Transform>

#include <algorithm>
#include <cmath>
#include <optional>

namespace osgAnalyticBin {

namespace {

// The content as the box of latitudes, longitudes and altitudes about its sphere. Not valid: it has none.
AnalyticBin binAbout(const osg::BoundingSphere& sphere, const core::Ellipsoid& ellipsoid) {
    const glm::dvec3 center = toGlm(osg::Vec3d(sphere.center()));
    const double radius = sphere.radius() * 1.001;
    if (ellipsoid.isPlane()) {
        const double farthest = std::max(std::abs(center.x), std::abs(center.y)) + radius;
        if (!(farthest <= core::Ellipsoid::kFarthestInMap)) return {};
        const core::Geodetic low = ellipsoid.toGeodetic(center - radius), high = ellipsoid.toGeodetic(center + radius);
        return AnalyticBin(core::GeodeticBin({low.latitude, high.latitude}, {low.longitude, high.longitude},
                                             {low.altitude, high.altitude}));
    }
    const core::Geodetic middle = ellipsoid.toGeodetic(center);
    const double fromAxis = std::hypot(center.x, center.y);
    // from the nearest centre of curvature
    const double fromCurvature = core::smallestCurvatureRadius(ellipsoid) + middle.altitude - radius;
    if (!std::isfinite(fromAxis + radius) || !(fromCurvature > radius) || !(fromAxis > radius)) return {};
    const double north = std::asin(radius / fromCurvature);
    const double east = std::asin(radius / fromAxis);
    return AnalyticBin(core::GeodeticBin({middle.latitude - north, middle.latitude + north},
                                         {middle.longitude - east, middle.longitude + east},
                                         {middle.altitude - radius, middle.altitude + radius}));
}

// Content below tiles, as it is passed up from one tile to the next.
class Content {
public:
    Content(osg::Node& node, const osg::BoundingSphere& sphere, bool isMerged)
        : _node(node), _isTerrain(asTerrain(node)), _sphere(sphere), _isMerged(isMerged) {}

    // Goes from the frame inside a transform to the one outside.
    void leave(const osg::Transform& transform) {
        osg::Matrixd matrix;
        transform.computeLocalToWorldMatrix(matrix, nullptr);
        _sphere = movedSphere(_sphere, matrix);
        _about.reset();
        _toHere = _toHere * matrix;
    }

    void fitInto(const AnalyticBinCullCallback& callback) {
        InstalledTile* const tile = callback.getInstalledTile();
        if (!tile || !callback.getBin().valid()) return;
        const unsigned int reasons = reasonsAbove(drawn(callback));
        tile->doubt(reasons);
        if (reasons & InstalledTile::NeverCulled) return;
        const bool isOther = !isOfSameShape(callback.getTerrainShape());
        const osg::EllipsoidModel& model = *tile->database().ellipsoid();
        const AnalyticBin& about = aboutOn(model, callback.getLocalToEcef());
        if (!isOther && isHeld(about, about.sag(), callback.getBin())) return;
        const TileSurface& surface = surfaceOn(model, callback.getLocalToEcef());
        const bool areSkirtsCounted = surface.skirt <= callback.getSkirt();
        const AnalyticBin own = areSkirtsCounted ? surface.bin : surface.bin.withSkirts(surface.skirt);
        const AnalyticBin& bin = callback.getBin();
        if (!isOther && (_isTerrain ? bin.contains(own) : isHeld(own, surface.bin.sag(), bin))) return;
        const AnalyticBin& content = own.valid() ? own : about;
        if (_isMerged) {
            Database::of(*tile).widen(*tile, {content, isOther || !content.valid()});
        } else {
            tile->doubt(InstalledTile::Outgrown);
        }
    }

private:
    // Bins, and what is known of osgTerrain tiles, are those of the terrain before it is exaggerated; other content is
    // measured as it is drawn.
    [[nodiscard]] bool isOfSameShape(const std::optional<TerrainShape>& shape) const {
        if (!_isTerrain) return !shape || shape->verticalScale == 1.0;
        if (!shape) return false;
        TerrainShape whole;
        whole.verticalScale = shape->verticalScale;
        return *shape == whole;
    }

    [[nodiscard]] const DrawnState& drawn(const AnalyticBinCullCallback& tile) {
        if (!_drawn) _drawn = drawnStateBelow(_node, {tile.getCullOptions().plainShaders});
        return *_drawn;
    }

    // A fitted mesh may have another form by now, as after osgUtil::Optimizer: it is recognised by its posts.
    static bool isHeld(const AnalyticBin& content, double sag, const AnalyticBin& bin) {
        if (!content.valid()) return false;
        const core::Interval& altitude = content.bin().altitude();
        const double posts = std::min(altitude.lower + sag, altitude.upper);
        const core::Interval room{bin.bin().altitude().lower - bin.margin(), bin.bin().altitude().upper + bin.margin()};
        return bin.bin().withAltitude(room).contains(content.bin().withAltitude({posts, altitude.upper}));
    }

    // Computed once for all tiles in the same frame.
    const AnalyticBin& aboutOn(const osg::EllipsoidModel& model, const osg::Matrixd& localToEcef) {
        if (!_about || localToEcef != _aboutToEcef) _about = binAbout(movedSphere(_sphere, localToEcef), toCore(model));
        _aboutToEcef = localToEcef;
        return *_about;
    }

    // Read once, for all tiles above, unless a transform in between has moved since bins were installed.
    const TileSurface& surfaceOn(const osg::EllipsoidModel& model, const osg::Matrixd& localToEcef) {
        const osg::Matrixd toEcef = _toHere * localToEcef;
        if (!_surface || toEcef != _toEcef) _surface = tileSurface(_node, model, toEcef);
        _toEcef = toEcef;
        return *_surface;
    }

    osg::Node& _node;
    bool _isTerrain;
    osg::BoundingSphere _sphere;
    bool _isMerged;
    osg::Matrixd _toHere;
    std::optional<AnalyticBin> _about;
    osg::Matrixd _aboutToEcef;  // that it was found with
    std::optional<TileSurface> _surface;
    osg::Matrixd _toEcef;  // that the surface was read with
    std::optional<DrawnState> _drawn;
};

void fitFrom(const osg::Node& node, Content content) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        if (isExactly<AnalyticBinCullCallback>(*at))
            content.fitInto(*static_cast<const AnalyticBinCullCallback*>(at->asNodeCallback()));
    }
    if (node.asTransform()) content.leave(*node.asTransform());
    for (const osg::Group* const parent : node.getParents()) fitFrom(*parent, content);
}

}  // namespace

void fitIntoTilesFrom(const osg::Node& node, osg::Node& content, const osg::BoundingSphere& sphere, bool isMerged) {
    fitFrom(node, Content(content, sphere, isMerged));
}

}  // namespace osgAnalyticBin
