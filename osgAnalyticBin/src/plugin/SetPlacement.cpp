// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SetPlacement.h"

#include <osg/CoordinateSystemNode>
#include <osg/Math>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::plugin {

namespace {

constexpr const char* kEnu = "ENU:";

// "ENU:LAT,LON" or "ENU:LAT,LON,HEIGHT", in degrees and metres.
std::optional<SetPlacement> enuPlacementOf(const PhotogrammetryMetadata& metadata, std::string& error) {
    const std::string text = metadata.srs.substr(std::string(kEnu).size());
    const bool hasHeight = std::count(text.begin(), text.end(), ',') == 2;
    const auto place = numbersFrom(text, hasHeight ? 3 : 2);
    if (!place || std::abs(place->x()) > 90.0 || std::abs(place->y()) > 360.0) {
        error = "the SRS is \"" + metadata.srs + "\"; ENU:LATITUDE,LONGITUDE in degrees is expected";
        return std::nullopt;
    }
    osg::Matrixd enuToEcef;
    osg::EllipsoidModel().computeLocalToWorldTransformFromLatLongHeight(
        osg::DegreesToRadians(place->x()), osg::DegreesToRadians(place->y()), hasHeight ? place->z() : 0.0, enuToEcef);
    return SetPlacement{osg::Matrixd::translate(metadata.origin) * enuToEcef, {}};
}

}  // namespace

std::optional<SetPlacement> placementOf(const PhotogrammetryMetadata& metadata, const osg::Vec3d& center,
                                        std::string& error) {
    if (metadata.srs.rfind(kEnu, 0) == 0) return enuPlacementOf(metadata, error);
#ifdef OSGANALYTICBIN_PROJ
    return projectedPlacementOf(metadata, center, error);
#else
    (void)center;
    error = "the SRS is \"" + metadata.srs + "\", for which this plugin has to be built with PROJ; it is not";
    return std::nullopt;
#endif
}

}  // namespace osgAnalyticBin::plugin
