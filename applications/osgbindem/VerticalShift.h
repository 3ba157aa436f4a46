// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"

#include <ogr_spatialref.h>

#include <memory>
#include <string>

namespace osgbindem {

/// What is added to heights of a raster so that they are above the ellipsoid: the height of the geoid, found by PROJ.
/// Not for use by several threads: each has its own.
class VerticalShift final {
public:
    /// `vertical`: the vertical part of the reference system of the raster at `path`, empty when it has none.
    /// `geoid`: "none" for no shift, "egm96", or a file with a grid that PROJ reads; empty for what `vertical` says.
    /// Throws Failure when PROJ has no grid for it.
    VerticalShift(const std::string& vertical, const std::string& geoid, const std::string& path);

    [[nodiscard]] bool isNone() const noexcept { return !_transformation; }

    /// For the user: what heights are above.
    [[nodiscard]] const std::string& what() const noexcept { return _what; }

    /// Metres. Throws Failure where the grid has none.
    [[nodiscard]] double at(const PositionDeg& position) const;

private:
    struct Destroy {
        void operator()(OGRCoordinateTransformation* transformation) const {
            OGRCoordinateTransformation::DestroyCT(transformation);
        }
    };
    void open(const OGRSpatialReference& reference, const std::string& what);

    std::string _what;
    std::unique_ptr<OGRCoordinateTransformation, Destroy> _transformation;
};

}  // namespace osgbindem
