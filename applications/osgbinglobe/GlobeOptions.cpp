// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GlobeOptions.h"

#include "CommandLine.h"
#include "Failure.h"

#include <osgAnalyticBin/NameParameters.h>

#include <osgDB/FileNameUtils>

#include <cstdio>
#include <cstdlib>

namespace osgAnalyticBin::globe {

namespace {

using support::Failure;
using tiles::TileId;

std::optional<TileId> tileFrom(const std::string& name) {
    TileId tile;
    char rest = 0;
    const bool isRead = std::sscanf(name.c_str(), "%2d-%9d-%9d%c", &tile.level, &tile.x, &tile.y, &rest) == 3;
    return isRead ? std::optional(tile) : std::nullopt;
}

bool hasChildren(const TileId& tile, const GlobeOptions& options) {
    return tile.level >= 0 && tile.level < options.levels && tile.x >= 0 && tile.x < tile.columns() && tile.y >= 0 &&
           tile.y < tile.rows();
}

}  // namespace

void GlobeOptions::declare(CLI::App& app) {
    app.set_help_flag();
    app.add_option("--levels", levels,
                   "Levels below the 16 x 8 start tiles (default: 12). From some 20 on OSG measures the distances at "
                   "which tiles are refined in steps of half a metre.")
        ->option_text("0..24")
        ->check(CLI::Range(0, kMostLevels));
    app.add_option("--cells", cells, "Cells along a tile's edge, an even number (default: 16)")
        ->option_text("2..64")
        ->check(CLI::Range(2, kMostCells))
        ->check([](const std::string& word) { return std::atoi(word.c_str()) % 2 == 0 ? "" : word + " is not even"; });
    app.add_option("--bins", bins, "Whether tiles carry analytic bins, as those of osgbindem do (default: on)")
        ->option_text("on|off");
}

GlobeName globeNameOf(const std::string& fileName) {
    const NameParameters parts = nameParametersFrom(osgDB::getStrippedName(fileName));
    GlobeName result;
    CLI::App app;
    result.options.declare(app);
    result.tile = tileFrom(parts.name);
    try {
        if (!result.tile && !parts.name.empty()) support::parseParameters(app, "levels=" + parts.name);
        support::parseParameters(app, parts.parameters);
        if (result.tile && !hasChildren(*result.tile, result.options))
            throw Failure("tile \"" + parts.name + "\" has no children in a globe of " +
                          std::to_string(result.options.levels) + " levels");
    } catch (const Failure& failure) {
        throw Failure(std::string(kGlobeExtension) + ": " + failure.what());
    }
    return result;
}

std::string rootFileOf(const GlobeOptions& options) {
    const GlobeOptions usual;
    std::string text = "(levels=" + std::to_string(options.levels);
    if (options.cells != usual.cells) text += ",cells=" + std::to_string(options.cells);
    if (options.bins != usual.bins) text += ",bins=off";
    return text + ")." + kGlobeExtension;
}

std::string childrenFileOf(const TileId& tile, const GlobeOptions& options) {
    return std::to_string(tile.level) + '-' + std::to_string(tile.x) + '-' + std::to_string(tile.y) + '.' +
           rootFileOf(options);
}

}  // namespace osgAnalyticBin::globe
