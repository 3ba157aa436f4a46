// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <TileLayout.h>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace osgAnalyticBin::globe {

/// What a procedural globe is made of.
struct GlobeOptions {
    int levels = 12;   ///< below the 16 x 8 start tiles, 0 to 24
    int cells = 16;    ///< along a tile's edge, even, 2 to 64
    bool bins = true;  ///< whether tiles carry their bins, and the root its horizon

    static constexpr int kMostLevels = 24;
    static constexpr int kMostCells = 64;
    /// Metres from the lowest terrain, at the ellipsoid, to the highest.
    static constexpr double kRelief = 8000.0;

    /// Declares what reads the parameters of a file's name into these.
    void declare(CLI::App& app);
};

inline constexpr const char* kGlobeExtension = "proceduralglobe";

/// What a file name asks for.
struct GlobeName {
    GlobeOptions options;
    /// The tile whose children are asked for; nullopt: the root.
    std::optional<tiles::TileId> tile;
};

/// Reads "LEVELS.proceduralglobe", "(levels=LEVELS,cells=CELLS).proceduralglobe", both at once as
/// "LEVELS.(cells=CELLS).proceduralglobe", and the names of children, "LEVEL-X-Y.(...).proceduralglobe".
/// Throws: Failure when the name or a parameter is unknown, malformed or out of range.
[[nodiscard]] GlobeName globeNameOf(const std::string& fileName);

/// The file with the children of a tile. Requires: a tile above the deepest level.
[[nodiscard]] std::string childrenFileOf(const tiles::TileId& tile, const GlobeOptions& options);

/// The root file.
[[nodiscard]] std::string rootFileOf(const GlobeOptions& options);

}  // namespace osgAnalyticBin::globe
