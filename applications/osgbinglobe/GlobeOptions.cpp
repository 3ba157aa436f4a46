// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GlobeOptions.h"

#include "CsvTable.h"

#include <osgAnalyticBin/NameParameters.h>

#include <ParameterReader.h>
#include <cstdio>

namespace osgAnalyticBin::globe {

namespace {

using flight::Applied;
using flight::applied;
using flight::setNumber;
using flight::setWhole;
using flight::textFrom;
using osgbindem::TileId;

bool setSwitch(bool& target, const std::string& value) {
    target = value == "on";
    return target || value == "off";
}

flight::ParameterReader readerInto(GlobeOptions& options) {
    const auto apply = [&options](const std::string& key, const std::string& value) {
        if (key == "levels") return applied(setWhole(options.levels, value, 0, GlobeOptions::kMostLevels));
        if (key == "cells")
            return applied(setWhole(options.cells, value, 2, GlobeOptions::kMostCells) && options.cells % 2 == 0);
        if (key == "relief") return applied(setNumber(options.relief, value, 0.0, GlobeOptions::kMostRelief));
        if (key == "lod")
            return applied(setNumber(options.lod, value, GlobeOptions::kLeastLod, GlobeOptions::kMostLod));
        if (key == "bins") return applied(setSwitch(options.bins, value));
        return Applied::Unknown;
    };
    return {apply, kAllowedParameters};
}

// One line that says whose parameters they are.
std::string ofGlobe(const std::string& message) {
    return std::string(kGlobeExtension) + ": " + message;
}

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
    return levels == other.levels && cells == other.cells && relief == other.relief && lod == other.lod &&
           bins == other.bins;
}

std::optional<GlobeName> globeNameOf(const std::string& fileName, const std::string& optionString, std::string& error) {
    const std::string file = withoutFolder(fileName);
    const NameParameters parts = nameParametersFrom(file.substr(0, file.rfind('.')));
    GlobeName result;
    const flight::ParameterReader reader = readerInto(result.options);
    result.tile = tileFrom(parts.name);
    if (!result.tile) {
        if (!reader.readOptionString(optionString, error)) {
            error = ofGlobe(error);
            return std::nullopt;
        }
        if (!parts.name.empty() && !setWhole(result.options.levels, parts.name, 0, GlobeOptions::kMostLevels)) {
            error = std::string(kGlobeExtension) + ": \"" + parts.name +
                    "\" is no number of levels; give 0 to 24, for example 12." + kGlobeExtension;
            return std::nullopt;
        }
    }
    if (!reader.readBracketed(parts.parameters, error)) {
        error = ofGlobe(error);
        return std::nullopt;
    }
    if (!result.tile || hasChildren(*result.tile, result.options)) return result;
    error = std::string(kGlobeExtension) + ": tile \"" + parts.name + "\" has no children in a globe of " +
            std::to_string(result.options.levels) + " levels";
    return std::nullopt;
}

namespace {

std::string parametersOf(const GlobeOptions& options) {
    const GlobeOptions usual;
    std::string text = "(levels=" + std::to_string(options.levels);
    if (options.cells != usual.cells) text += ",cells=" + std::to_string(options.cells);
    if (options.relief != usual.relief) text += ",relief=" + textFrom(options.relief);
    if (options.lod != usual.lod) text += ",lod=" + textFrom(options.lod);
    if (options.bins != usual.bins) text += ",bins=off";
    return text + ")." + kGlobeExtension;
}

}  // namespace

std::string childrenFileOf(const TileId& tile, const GlobeOptions& options) {
    return std::to_string(tile.level) + '-' + std::to_string(tile.x) + '-' + std::to_string(tile.y) + '.' +
           parametersOf(options);
}

std::string rootFileOf(const GlobeOptions& options) {
    return parametersOf(options);
}

}  // namespace osgAnalyticBin::globe
