// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BlendBand.h"
#include "DemSource.h"
#include "Settings.h"
#include "TileLayout.h"
#include "VerticalShift.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgbindem {

/// The elevation rasters of the command line, for tiles of the layout where there is one: then of the overviews that
/// are as fine, where settings allow them, and warped to posts of tiles. Throws Failure.
[[nodiscard]] std::vector<std::unique_ptr<RasterLayer>> elevationLayers(const Settings& settings,
                                                                        const TileLayout* layout);

/// All elevation rasters as one: at each position the finest layer that has data there, voids filled from those below
/// it, its border blended with them, and 0 m where none has.
/// Not for use by several threads: each has its own.
class DemMosaic final {
public:
    /// Throws Failure.
    explicit DemMosaic(const Settings& settings, const TileLayout* layout = nullptr);
    DemMosaic(const DemMosaic&) = delete;
    DemMosaic& operator=(const DemMosaic&) = delete;

    struct Found {
        /// Above the ellipsoid.
        double metres = 0.0;
        /// No data, but what stands in a void.
        bool isFilled = false;
        std::size_t source = 0;
    };

    /// The same for the same position, whatever was read before. Returns: nullopt where no raster has data.
    [[nodiscard]] std::optional<Found> find(const PositionDeg& position) { return heightFrom(0, position); }

    /// Metres above the ellipsoid, 0 where no raster has data.
    [[nodiscard]] double height(const PositionDeg& position) {
        const auto found = find(position);
        return found ? found->metres : 0.0;
    }

    /// Heights of every post, of every raster used in the rectangle, that has part in it.
    [[nodiscard]] HeightRange range(const RectDeg& rect);

    /// Whether a raster finer than the spacing has a part in the rectangle, and whether it has data there.
    [[nodiscard]] bool hasFinerRaster(const RectDeg& rect, double spacingDeg) const noexcept;
    [[nodiscard]] bool hasFinerData(const RectDeg& rect, double spacingDeg);

    void prefetch(const RectDeg& rect);

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
    [[nodiscard]] std::optional<Found> heightFrom(std::size_t source, const PositionDeg& position);

    /// What the coarser layers have, as heights of this one.
    [[nodiscard]] VoidFill::Below below(std::size_t source, const PositionDeg& position);

    /// A layer's share of the height, less than 1 in the bands at its rasters' borders.
    [[nodiscard]] double share(std::size_t source, const PositionDeg& position) const noexcept;

    /// As DemSource::addRange(), above the ellipsoid.
    [[nodiscard]] bool addRange(std::size_t source, const RectDeg& rect, HeightRange& range);

    double _mostPosts;
    std::vector<std::unique_ptr<DemSource>> _sources;
    /// One for each source.
    std::vector<VerticalShift> _shifts;
    /// Of each source, those of its rasters that have one.
    std::vector<std::vector<BlendBand>> _bands;
};

}  // namespace osgbindem
