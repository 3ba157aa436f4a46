// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BlendBand.h"
#include "DemSource.h"
#include "Settings.h"
#include "VerticalShift.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace osgbindem {

/// All elevation rasters as one: at each position the finest raster that has data there, voids filled from those below
/// it, its border blended with them, and 0 m where none has.
/// Of equally fine rasters the one named first counts. Not for use by several threads: each has its own.
class DemMosaic final {
public:
    /// With a spacing of posts, of the overviews that are as fine, where settings allow them. Throws Failure.
    explicit DemMosaic(const Settings& settings, double spacingDeg = 0.0);
    DemMosaic(const DemMosaic&) = delete;
    DemMosaic& operator=(const DemMosaic&) = delete;

    /// Metres above the ellipsoid; the same number for the same position, whatever was read before.
    [[nodiscard]] double height(const PositionDeg& position);

    /// Heights of every post, of every raster used in the rectangle, that has part in it.
    [[nodiscard]] HeightRange range(const RectDeg& rect);

    /// Whether a raster finer than the spacing has data in the rectangle.
    [[nodiscard]] bool hasFinerData(const RectDeg& rect, double spacingDeg);

    void prefetch(const RectDeg& rect);

    /// Throws Failure when a raster is empty; reads, so it is done once and not in each thread.
    void requireData();

    /// The finest distance between posts.
    [[nodiscard]] double finestDeg() const noexcept;

    /// The finest distance between posts among the rasters that go round the globe; without one, finestDeg().
    [[nodiscard]] double finestGlobalDeg() const noexcept;

    /// About how many posts there are within the rectangle, of all rasters.
    [[nodiscard]] double posts(const RectDeg& rect) const noexcept;

private:
    /// Of the rasters from this one on, finest first; nullopt where none of them has data.
    [[nodiscard]] std::optional<double> heightFrom(std::size_t source, const PositionDeg& position);

    /// As DemSource::addRange(), above the ellipsoid.
    [[nodiscard]] bool addRange(std::size_t source, const RectDeg& rect, HeightRange& range);

    double _mostPosts;
    std::vector<std::unique_ptr<DemSource>> _sources;
    /// One for each source.
    std::vector<VerticalShift> _shifts;
    /// One for each source.
    std::vector<BlendBand> _bands;
};

}  // namespace osgbindem
