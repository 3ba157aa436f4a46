// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DeepGlobe.h"

#include "CameraGlobe.h"

#include <glm/geometric.hpp>
#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>

#include <algorithm>

namespace osgAnalyticBin::test {

namespace {

constexpr int kDeepGlobeLevels = 3;

osg::ref_ptr<osg::Group> nodeOf(DeepTile& tile, const DeepTerrain& terrain, const osg::Matrixd& localToEcef) {
    const core::GeodeticBin extents(tile.latitude, tile.longitude, {tile.low, tile.high});
    tile.callback = new AnalyticBinCullCallback(AnalyticBin(extents), osg::EllipsoidModel());
    tile.callback->setSurface(AnalyticBin(extents.withAltitude({tile.surface, tile.surface})));
    if (!localToEcef.isIdentity()) tile.callback->setLocalToEcef(localToEcef);
    osg::ref_ptr<osg::Group> node = new osg::Group;
    if (tile.cutoff > 0.0f) {
        const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
        node = paged;
        paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        paged->setCenter(osgVector(tile.center) * osg::Matrixd::inverse(localToEcef));
        paged->setRadius(1.0f);
        paged->setRangeMode(terrain.mode);
        paged->addChild(new osg::Geode, tile.cutoff, 1e10f);
        paged->setFileName(1, "parts");
        paged->setRange(1, 0.0f, tile.cutoff);
        if (!tile.parts.empty()) {
            const osg::ref_ptr<osg::Group> parts = new osg::Group;
            for (DeepTile& part : tile.parts) parts->addChild(nodeOf(part, terrain, localToEcef));
            paged->addChild(parts);
        }
    }
    node->setCullingActive(false);
    if (terrain.hasCallbackInFront) node->addCullCallback(new osg::NodeCallback);
    node->addCullCallback(tile.callback);
    return node;
}

const DeepTile* tileAt(const std::vector<DeepTile>& tiles, double latitude, double longitude) {
    const auto found = std::find_if(tiles.begin(), tiles.end(), [&](const DeepTile& tile) {
        return tile.latitude.contains(latitude) && tile.longitude.contains(longitude);
    });
    return found == tiles.end() ? &tiles.back() : &*found;
}

}  // namespace

DeepGlobe::DeepGlobe(const DeepTerrain& terrain, Random& random) : _terrain(terrain), _random(random) {
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            const core::GeodeticBin bin = core::GeodeticBin::fromDegrees(
                {-90.0 + 45.0 * y, -45.0 + 45.0 * y}, {-180.0 + 45.0 * x, -135.0 + 45.0 * x}, {0.0, 0.0});
            const bool isMoved = random.chance(terrain.movedShare);
            _tiles.push_back(made(bin, 0, isMoved || terrain.mode != osg::LOD::DISTANCE_FROM_EYE_POINT));
            _moved.push_back(isMoved);
        }
    }
}

void DeepGlobe::build() {
    const osg::Matrixd turn = osg::Matrixd::rotate(0.7, osg::Vec3d(0.1, 0.2, 1.0)) * osg::Matrixd::translate(1e5, 0, 0);
    for (std::size_t i = 0; i < _tiles.size(); ++i) {
        if (!_moved[i]) {
            root->addChild(nodeOf(_tiles[i], _terrain, osg::Matrixd()));
            continue;
        }
        const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(turn);
        transform->addChild(nodeOf(_tiles[i], _terrain, turn));
        root->addChild(transform);
    }
}

double DeepGlobe::shownAltitude(double latitude, double longitude, const glm::dvec3& eye) const {
    return shownAt(*tileAt(_tiles, latitude, longitude), latitude, longitude, eye);
}

double DeepGlobe::mostAltitude(double latitude, double longitude, const glm::dvec3& eye) const {
    return mostAt(*tileAt(_tiles, latitude, longitude), latitude, longitude, eye);
}

DeepTile DeepGlobe::made(const core::GeodeticBin& extents, int level, bool isUncertain) {
    DeepTile tile;
    tile.latitude = extents.latitude();
    tile.longitude = extents.longitude();
    tile.surface =
        _random.chance(_terrain.deepShare) ? -_random.logUniform(500.0, 15000.0) : _random.uniform(-400.0, 3000.0);
    tile.low = tile.high = tile.surface;
    tile.center = earth().toEcef({tile.latitude.middle(), tile.longitude.middle(), 0.0});
    tile.isUncertain = isUncertain;
    if (level + 1 < kDeepGlobeLevels) {
        tile.cutoff = static_cast<float>(_random.logUniform(5e5, 2e7));
        if (_random.chance(_terrain.loadedShare)) {
            for (const core::GeodeticBin& quarter : extents.quarters()) {
                tile.parts.push_back(made(quarter, level + 1, isUncertain));
                tile.low = std::min(tile.low, tile.parts.back().low);
                tile.high = std::max(tile.high, tile.parts.back().high);
            }
        }
    }
    if (_random.chance(_terrain.airShare)) tile.high = std::max(tile.high, 9000.0);
    return tile;
}

bool DeepGlobe::isFine(const DeepTile& tile, const glm::dvec3& eye) {
    return !tile.parts.empty() && glm::distance(eye, tile.center) < static_cast<double>(tile.cutoff);
}

double DeepGlobe::mostAt(const DeepTile& tile, double latitude, double longitude, const glm::dvec3& eye) {
    if (tile.parts.empty()) return tile.surface;
    const double fine = mostAt(*tileAt(tile.parts, latitude, longitude), latitude, longitude, eye);
    if (tile.isUncertain) return std::max(tile.surface, fine);
    return isFine(tile, eye) ? fine : tile.surface;
}

double DeepGlobe::shownAt(const DeepTile& tile, double latitude, double longitude, const glm::dvec3& eye) {
    if (tile.parts.empty()) return tile.surface;
    const double fine = shownAt(*tileAt(tile.parts, latitude, longitude), latitude, longitude, eye);
    if (tile.isUncertain) return std::min(tile.surface, fine);
    return isFine(tile, eye) ? fine : tile.surface;
}

}  // namespace osgAnalyticBin::test
