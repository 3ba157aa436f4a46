// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "VerticalShift.h"

#include "Failure.h"

#include <cmath>
#include <filesystem>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

/// Heights above the geoid of a grid, at longitudes and latitudes of WGS 84.
OGRSpatialReference referenceOf(const std::string& grid) {
    OGRSpatialReference reference;
    const std::string text = "+proj=longlat +datum=WGS84 +geoidgrids=" + grid + " +vunits=m +no_defs";
    if (reference.importFromProj4(text.c_str()) != OGRERR_NONE) {
        throw Failure("PROJ does not take \"" + grid + "\" for a grid of the geoid; see --geoid");
    }
    return reference;
}

/// A vertical reference system with longitudes and latitudes of WGS 84.
OGRSpatialReference withPositions(const OGRSpatialReference& heights) {
    OGRSpatialReference positions;
    positions.importFromEPSG(4326);
    OGRSpatialReference reference;
    reference.SetCompoundCS("positions and heights", &positions, &heights);
    return reference;
}

}  // namespace

VerticalShift::VerticalShift(const std::string& vertical, const std::string& geoid, const std::string& path) {
    if (geoid == "none") return;
    if (geoid == "egm96") {
        open(referenceOf("egm96_15.gtx"), "the geoid EGM96");
    } else if (!geoid.empty()) {
        open(referenceOf(std::filesystem::absolute(geoid).string()), "the geoid \"" + geoid + "\"");
    } else if (!vertical.empty()) {
        OGRSpatialReference heights;
        heights.importFromWkt(vertical.c_str());
        open(withPositions(heights),
             std::string("the vertical reference \"") + heights.GetName() + "\" of \"" + path + "\"");
    }
}

void VerticalShift::open(const OGRSpatialReference& reference, const std::string& what) {
    _what = what;
    OGRSpatialReference source(reference);
    OGRSpatialReference target;
    target.importFromEPSG(4979);
    source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRCoordinateTransformationOptions options;
    options.SetBallparkAllowed(false);
    _transformation.reset(OGRCreateCoordinateTransformation(&source, &target, options));
    if (!_transformation) {
        throw Failure("PROJ has no grid for " + what +
                      "; install the package proj-data, or see --geoid (none takes heights as they are)");
    }
}

double VerticalShift::at(const PositionDeg& position) const {
    if (!_transformation) return 0.0;
    double x = std::remainder(position.longitudeDeg, 360.0);
    double y = position.latitudeDeg;
    double z = 0.0;
    if (_transformation->Transform(1, &x, &y, &z) == 0 || !std::isfinite(z)) {
        throw Failure("PROJ finds no height of " + _what + " at latitude " + std::to_string(position.latitudeDeg) +
                      ", longitude " + std::to_string(position.longitudeDeg) +
                      "; install the package proj-data, or see --geoid (none takes heights as they are)");
    }
    return z;
}

}  // namespace osgbindem
