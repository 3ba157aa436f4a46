// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BuildSources.h"

#include "GdalRaster.h"

#include <osgAnalyticBin/Version.h>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <osg/Version>

#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>
#include <system_error>

namespace osgbindem {

namespace {

// To be raised when the same settings come to make other files.
constexpr int kFormat = 1;

std::string wholePath(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return path;  // GDAL has names that are no files
    const std::filesystem::path whole = std::filesystem::canonical(path, error);
    return error ? path : whole.string();
}

void describeFile(const std::string& path, std::ostream& out) {
    VSIStatBufL status{};
    const bool isThere = VSIStatL(path.c_str(), &status) == 0;
    out << "  file " << wholePath(path);
    if (isThere) out << ' ' << status.st_size << ' ' << status.st_mtim.tv_sec << '.' << status.st_mtim.tv_nsec;
    out << '\n';
}

/// A raster may be made of many files: a mosaic, or one with overviews beside it.
void describeRaster(const std::string& path, std::ostream& out) {
    const GdalDataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
    char** files = dataset ? dataset->GetFileList() : nullptr;
    for (int i = 0; i < CSLCount(files); ++i) describeFile(files[i], out);
    CSLDestroy(files);
}

}  // namespace

std::string describeSources(const Settings& settings, const TileLayout& layout) {
    std::ostringstream out;
    out << std::setprecision(std::numeric_limits<double>::max_digits10);
    out << "osgbindem " << osgAnalyticBin::version() << ", format " << kFormat << ", GDAL "
        << GDALVersionInfo("RELEASE_NAME") << ", OpenSceneGraph " << osgGetVersion() << '\n';
    out << "levels " << layout.deepestLevel() << ", cells " << layout.cells() << ", lod factor " << settings.lodFactor
        << ", compressed " << settings.compress << ", overviews " << settings.useOverviews << '\n';
    out << "radii " << settings.ellipsoid.equatorialRadius() << ' ' << settings.ellipsoid.polarRadius() << ", WGS 84 "
        << settings.isWgs84 << '\n';
    if (settings.nodata) out << "nodata " << *settings.nodata << '\n';
    for (const DemInput& dem : settings.dems) {
        out << "elevation " << wholePath(dem.path) << ", scale " << dem.metresPerUnit << '\n';
        describeRaster(dem.path, out);
    }
    if (!settings.image.empty()) {
        out << "image " << wholePath(settings.image) << '\n';
        describeRaster(settings.image, out);
    }
    return out.str();
}

}  // namespace osgbindem
