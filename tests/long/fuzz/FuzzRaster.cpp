// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Small rasters as ESRI ASCII grids, which GDAL reads from memory, and the unit and the number for missing heights in
// the first two bytes: heights are finite, or there are none.

#include "Fuzz.h"

#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <DemMosaic.h>
#include <Failure.h>
#include <cmath>
#include <string>
#include <vector>

namespace {

constexpr const char* kFile = "/vsimem/fuzz.asc";

void tryRaster(const osgbindem::Settings& settings) {
    osgbindem::DemMosaic mosaic(settings);
    for (const double latitude : {-90.0, -0.5, 0.0, 12.25, 90.0}) {
        for (const double longitude : {-180.0, -0.5, 0.0, 33.5, 180.0}) {
            osgbindem::PositionDeg position{};
            position.latitudeDeg = latitude;
            position.longitudeDeg = longitude;
            const auto height = mosaic.find(position);
            osgAnalyticBin::test::require(!height || std::isfinite(height->metres));
        }
    }
    (void)mosaic.inspect();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMostBytes = 4096;
    if (size < 2 || size > kMostBytes) return 0;
    GDALAllRegister();
    CPLSetErrorHandler(CPLQuietErrorHandler);
    std::vector<GByte> bytes(data + 2, data + size);
    VSIFCloseL(VSIFileFromMemBuffer(kFile, bytes.data(), bytes.size(), FALSE));
    osgbindem::Settings settings;
    settings.dems = {{kFile, std::ldexp(1.0, data[0] % 64 - 32)}};
    if (data[1] % 2 == 1) settings.nodata = data[1];
    try {
        tryRaster(settings);
    } catch (const osgAnalyticBin::support::Failure& failure) {
        osgAnalyticBin::test::require(std::string(failure.what()).find('\n') == std::string::npos);
    }
    VSIUnlink(kFile);
    return 0;
}
