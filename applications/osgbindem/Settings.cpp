// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Settings.h"

#include "CommandLine.h"
#include "Gdal.h"
#include "GlmBridge.h"
#include "TileLayout.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>

namespace osgbindem {

using osgAnalyticBin::support::UsageError;
using osgAnalyticBin::support::within;

namespace {

constexpr const char* kDescription =
    "Builds a paged globe for OpenSceneGraph from elevation rasters, with bins stored in its tiles.\n"
    "Where rasters overlap, the finest one is used; where none has data, the height is 0 m.";

constexpr const char* kExamples =
    "Example, heights of the first raster in metres and of the second in feet:\n"
    "  osgbindem world.tif rockies.nc --height-unit m ft -o earth.osgb\n"
    "writes earth.osgb and the folder earth_tiles beside it. Large rasters are read fastest when tiled\n"
    "(gdal_translate -co TILED=YES).\n"
    "A run that was interrupted, killed or out of disk space leaves the finished parts in earth_tiles.partial. The\n"
    "same command resumes from them; another command starts again. Remove the folder to start anew.\n"
    "A finished database is replaced only with --overwrite, and brought up to date with --update.\n"
    "Under mpirun, ranks share the parts: mpirun -n 8 osgbindem world.tif -o earth.osgb, with the output in a folder\n"
    "that all of them see.\n"
    "Exit codes: 0 the database is complete, 1 an error, 2 a wrong command line, 130 interrupted.";

/// `units`: metres per unit.
std::vector<DemInput> demsOf(const std::vector<std::string>& rasters, const std::vector<double>& units) {
    if (rasters.empty()) throw UsageError("no elevation raster on the command line; name at least one");
    if (units.size() > 1 && units.size() != rasters.size())
        throw UsageError(std::to_string(units.size()) + " units in --height-unit for " +
                         std::to_string(rasters.size()) + " rasters; give one for all or one for each");
    std::vector<DemInput> dems;
    for (std::size_t i = 0; i < rasters.size(); ++i) {
        dems.push_back({rasters[i]});
        if (!units.empty()) dems.back().metresPerUnit = units[units.size() == 1 ? 0 : i];
    }
    return dems;
}

void setRadii(Settings& settings, double a, double b) {
    if (!(a >= 1e4 && a <= 1e9 && b >= 0.5 * a && b <= 2.0 * a))
        throw UsageError("radii " + std::to_string(a) + " and " + std::to_string(b) +
                         " in --radii; give metres from 1e4 to 1e9, neither more than twice the other");
    const auto wgs84 = osgAnalyticBin::defaultEllipsoid();
    settings.ellipsoid = osgAnalyticBin::core::Ellipsoid(a, b);
    settings.areRadiiGiven = true;
    settings.isWgs84 = a == wgs84.equatorialRadius() && b == wgs84.polarRadius();
}

RectDeg regionOf(const std::vector<double>& edges) {
    const RectDeg region{edges[0], edges[1], edges[2], edges[3]};
    if (!(region.west >= -360.0 && region.west <= 360.0 && region.east > region.west &&
          region.east - region.west <= 360.0 && region.south >= -90.0 && region.north <= 90.0 &&
          region.north > region.south)) {
        throw UsageError(
            "-te is no part of the earth; give degrees as WEST SOUTH EAST NORTH, east more than west by at most 360 "
            "(179 -20 182 -15 passes the date line)");
    }
    return region;
}

void requireFiles(const Settings& settings) {
    if (!settings.geoid.empty() && settings.geoid != "none" && settings.geoid != "egm96" && !mayExist(settings.geoid))
        throw Failure("no file \"" + settings.geoid + "\" for --geoid; give none, egm96 or a grid");
    if (std::filesystem::path(settings.output).extension() != ".osgb")
        throw UsageError("output \"" + settings.output + "\"; give a file name that ends in .osgb");
}

void declare(CLI::App& app, Settings& settings, std::vector<std::string>& dems, std::vector<double>& units) {
    app.footer(kExamples);
    app.add_option(
        "DEM", dems,
        "elevation rasters that GDAL reads, in any reference system;\nwithout one, longitude and latitude in "
        "degrees");
    app.add_option("-o,--output", settings.output, "the root file of the database, *.osgb")->required();
    app.add_option("--height-unit", units,
                   "unit of the heights: m, ft or metres per unit;\none for all rasters or one for each (default: the "
                   "unit in the raster, else m)")
        ->delimiter(',')
        ->transform(CLI::Transformer(std::map<std::string, std::string>{{"m", "1"}, {"ft", "0.3048"}}))
        ->check([](const std::string& word) {
            return std::isnormal(std::atof(word.c_str())) ? "" : word + " is no unit; give m, ft or metres per unit";
        });
    app.add_option("-b,--band", settings.band, "band of the elevation rasters with the heights (default: the first)")
        ->check(CLI::Range(1, 65535));
    app.add_option("--nodata", settings.nodata, "value that marks missing heights, instead of the one in the rasters");
    app.add_option_function<std::vector<double>>(
           "--te", [&settings](const std::vector<double>& edges) { settings.region = regionOf(edges); },
           "build this part of the earth: WEST SOUTH EAST NORTH in degrees, also as -te\n(default: the whole earth)")
        ->expected(4);
    app.add_option(
        "--geoid", settings.geoid,
        "vertical reference of all rasters: none (heights are used unchanged), egm96, or FILE,\na geoid grid "
        "that PROJ reads (default: the vertical reference in the raster, else none)");
    app.add_option("--blend", settings.blend,
                   "width in metres of the band inside the border of a raster where it blends into\ncoarser "
                   "ones, 0 for none (default: a post of the coarser one, at most an eighth of the finer one)")
        ->check(within(0.0, 1e6));
    app.add_option("--levels", settings.levels,
                   "levels of tiles below the 16 x 8 start tiles\n(default: as fine as the finest raster)")
        ->check(CLI::Range(0, TileLayout::kDeepest));
    app.add_option("--image", settings.images,
                   "image that GDAL reads, draped over the terrain; may be given several times: the finest\nthat has a "
                   "pixel counts, and the colours of the relief where none has")
        ->allow_extra_args(false);
    app.add_option_function<std::vector<double>>(
           "--radii", [&settings](const std::vector<double>& radii) { setRadii(settings, radii[0], radii[1]); },
           "equatorial and polar radius in metres\n(default: those of the first raster where it is of another "
           "body than the earth, else WGS 84)")
        ->expected(2);
    app.add_option("--cells", settings.cells, "cells along the edge of a tile, even\n(default: from the rasters)")
        ->check(CLI::Range(4, 240))
        ->check([](const std::string& word) { return std::atoi(word.c_str()) % 2 == 0 ? "" : word + " is not even"; });
    app.add_option(
           "--lod-factor", settings.lodFactor,
           "distance at which a tile is replaced by finer ones,\nin half diagonals of the tile, 3 to 100 (default 4)")
        ->check(within(3.0, 100.0));
    app.add_option(
           "--threads", settings.threads,
           "number of threads (default: one per core);\nunder mpirun, of each rank (default: its share of cores)")
        ->check(CLI::Range(1, 256));
    app.add_option("--memory", settings.memoryMib,
                   "MiB for data read from the rasters (default 256);\ntiles that are being built need more")
        ->check(CLI::Range(16, 65536));
    app.add_flag("!--full-resolution", settings.useOverviews,
                 "do not read a raster's overviews where --levels needs nothing finer");
    app.add_flag("--compress", settings.compress, "compress the files with zlib");
    app.add_flag("--packed", settings.packed,
                 "store tiles as grids of heights, a fifth of the bytes or less;\nthey need this library's modules "
                 "where they are shown");
    auto* overwrite = app.add_flag("--overwrite", settings.overwrite,
                                   "replace a finished database OUTPUT when the new one is complete");
    app.add_flag(
           "--update", settings.update,
           "build only the tiles of the database OUTPUT that differ because rasters\nor images were added, replaced "
           "or left out since; all have to be named")
        ->excludes(overwrite);
    app.add_flag("-q,--quiet", settings.quiet, "show no progress, summary or warnings");
}

}  // namespace

std::optional<Settings> settingsFrom(int argc, const char* const* argv) {
    Settings settings;
    settings.ellipsoid = osgAnalyticBin::defaultEllipsoid();
    std::vector<std::string> dems;
    std::vector<double> units;
    CLI::App app{kDescription, "osgbindem"};
    declare(app, settings, dems, units);
    std::vector<const char*> words(argv, argv + argc);
    // GDAL's tools have it with one dash, which the parser takes for an option of one letter.
    std::replace_if(
        words.begin(), words.end(), [](const char* word) { return std::strcmp(word, "-te") == 0; }, "--te");
    if (!osgAnalyticBin::support::parseCommandLine(app, argc, words.data())) return std::nullopt;
    settings.dems = demsOf(dems, units);
    requireFiles(settings);
    return settings;
}

}  // namespace osgbindem
