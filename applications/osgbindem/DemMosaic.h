// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"
#include "Settings.h"
#include "TileLayout.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::core::Interval;

class DemSource;

/// A height at a place.
struct FoundHeight {
    double metres = 0.0;
    /// No data: interpolated in a narrow void.
    bool isFilled = false;
};

/// All elevation rasters as one: at each position the finest layer that has data there, its narrow voids filled, its
/// border blended with those below it, and 0 m where none has.
/// Not for use by several threads: each has its own.
class DemMosaic final {
public:
    /// Throws Failure.
    explicit DemMosaic(const Settings& settings, const TileLayout* layout = nullptr);
    ~DemMosaic();

    /// Above the ellipsoid; the same for the same position, whatever was read before. Returns: nullopt where no raster
    /// has data.
    [[nodiscard]] std::optional<FoundHeight> find(const PositionDeg& position) { return heightFrom(0, position); }

    /// Metres above the ellipsoid, 0 where no raster has data.
    [[nodiscard]] double height(const PositionDeg& position) {
        const auto found = find(position);
        return found ? found->metres : 0.0;
    }

    /// Heights of every post, of every raster used in the rectangle, that has part in it.
    [[nodiscard]] Interval range(const RectDeg& rect);

    /// Whether a raster finer than the spacing has a part in the rectangle, and whether it has data there.
    [[nodiscard]] bool hasFinerRaster(const RectDeg& rect, double spacingDeg) const noexcept;
    [[nodiscard]] bool hasFinerData(const RectDeg& rect, double spacingDeg);

    /// Looks at each raster; reads, so it is done once and not in each thread. Returns: what the user should know of
    /// them, in lines. Throws Failure when one is empty.
    [[nodiscard]] std::vector<std::string> inspect();

    /// The finest distance between posts.
    [[nodiscard]] double finestDeg() const noexcept;

    /// The finest distance between posts among the rasters that go round the globe; without one, finestDeg().
    [[nodiscard]] double finestGlobalDeg() const noexcept;

    /// About how many posts there are within the rectangle, of all rasters.
    [[nodiscard]] double posts(const RectDeg& rect) const noexcept;

private:
    /// Of the layers from this one on, finest first; nullopt where none of them has data.
    [[nodiscard]] std::optional<FoundHeight> heightFrom(std::size_t source, const PositionDeg& position);

    std::vector<std::unique_ptr<DemSource>> _sources;
};

}  // namespace osgbindem
