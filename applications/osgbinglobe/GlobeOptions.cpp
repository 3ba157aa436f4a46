// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GlobeOptions.h"

#include "Failure.h"

#include <osgAnalyticBin/NameParameters.h>

#include <cstdio>

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

std::string withoutFolder(const std::string& fileName) {
    return fileName.substr(fileName.find_last_of("/\\") + 1);
}

}  // namespace

bool GlobeOptions::operator==(const GlobeOptions& other) const {
    return levels == other.levels && cells == other.cells && bins == other.bins;
}

std::vector<flight::Parameter> GlobeOptions::parameters() {
    const auto takeCells = [this](const std::string& value) {
        return flight::wholeInto(cells, 2, kMostCells)(value) && cells % 2 == 0;
    };
    const auto takeBins = [this](const std::string& value) {
        bins = value == "on";
        return bins || value == "off";
    };
    return {{"levels=0..24",
             "Levels below the 16 x 8 start tiles (default: 12). From some 20 on OSG measures the distances at which "
             "tiles are refined in steps of half a metre.",
             flight::wholeInto(levels, 0, kMostLevels)},
            {"cells=2..64", "Cells along a tile's edge, an even number (default: 16)", takeCells},
            {"bins=on|off", "Whether tiles carry analytic bins, as those of osgbindem do (default: on)", takeBins}};
}

GlobeName globeNameOf(const std::string& fileName) {
    const std::string file = withoutFolder(fileName);
    const NameParameters parts = nameParametersFrom(file.substr(0, file.rfind('.')));
    GlobeName result;
    const auto known = result.options.parameters();
    result.tile = tileFrom(parts.name);
    try {
        if (!result.tile && !parts.name.empty() &&
            !flight::wholeInto(result.options.levels, 0, GlobeOptions::kMostLevels)(parts.name))
            throw Failure("\"" + parts.name + "\" is no number of levels; give 0 to 24, for example 12." +
                          kGlobeExtension);
        flight::readBracketed(known, parts.parameters);
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
