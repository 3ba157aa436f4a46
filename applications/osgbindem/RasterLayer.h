// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BlendBand.h"
#include "RasterFile.h"
#include "Settings.h"
#include "TileLayout.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace osgbindem {

/// Rasters that are equally fine and meet, as one raster in degrees of the globe. GDAL makes it: rasters of one grid
/// are a mosaic, and what is not in degrees of the globe is warped, at its own spacing or to the posts of tiles that
/// are as fine, which then have GDAL's own bilinear values. Of rasters with data at the same place the one named first
/// counts. Not for use by several threads.
class RasterLayer final {
public:
    using Layers = std::vector<std::unique_ptr<RasterLayer>>;

    /// Opens all elevation rasters of the command line; finest layers first, of equally fine ones the one named first.
    /// For tiles of the layout where there is one: then of the overviews that are as fine, where settings allow them,
    /// and warped to posts of tiles. Throws Failure.
    [[nodiscard]] static Layers elevationOf(const Settings& settings, const TileLayout* layout);
    /// The same of all images. Throws Failure.
    [[nodiscard]] static Layers imagesOf(const Settings& settings);

    RasterLayer(const RasterLayer&) = delete;
    RasterLayer& operator=(const RasterLayer&) = delete;

    /// The rasters, and of each its number on the command line and the part of the layer that it may have data in.
    struct Member {
        std::size_t number = 0;
        std::unique_ptr<RasterFile> file;
        RasterGrid grid{{0.0, 1.0, 0.0, 0.0, 0.0, -1.0}, 1, 1};
        PixelWindow window;
        BlendBand band;
    };
    [[nodiscard]] const std::vector<Member>& members() const noexcept { return _members; }
    [[nodiscard]] const std::string& path() const noexcept { return _members.front().file->path(); }
    [[nodiscard]] const std::string& vertical() const noexcept { return _members.front().file->vertical(); }

    [[nodiscard]] GDALDataset& dataset() const noexcept { return *_dataset; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _grid; }
    /// The distance between posts of the finest raster.
    [[nodiscard]] double spacingDeg() const noexcept { return _spacingDeg; }
    [[nodiscard]] int width() const { return _dataset->GetRasterXSize(); }
    [[nodiscard]] int height() const { return _dataset->GetRasterYSize(); }

    /// The layer's share of heights or colours, less than 1 in the bands at its rasters' borders; and whether a band
    /// may reach into the rectangle.
    [[nodiscard]] double share(const PositionDeg& position) const noexcept;
    [[nodiscard]] bool isBlendedIn(const RectDeg& rect) const noexcept;

    /// Visits the pixels that are warped into a window of the layer, before they are.
    using VisitSource = std::function<void(GDALDataset& source, const PixelWindow& window)>;
    void forSources(const PixelWindow& window, const VisitSource& visit) const;

private:
    /// Rasters of one grid in one reference system.
    struct Piece {
        std::vector<std::size_t> members;
        GDALDataset* dataset = nullptr;
        std::unique_ptr<PixelTransform> transform;  // of what is warped
    };
    class Lattice;
    class Builder;

    RasterLayer() = default;
    [[nodiscard]] std::vector<PixelWindow> sourceWindows(const Piece& piece, const PixelWindow& window) const;

    /// Datasets, each made of earlier ones, and destroyed before them.
    struct Made {
        std::vector<GdalDataset> datasets;

        Made() = default;
        Made(const Made&) = delete;
        Made& operator=(const Made&) = delete;
        ~Made() {
            while (!datasets.empty()) datasets.pop_back();
        }
        GDALDataset& keep(GdalDataset dataset) { return *datasets.emplace_back(std::move(dataset)); }
    };

    std::vector<Member> _members;
    std::vector<const BlendBand*> _bands;
    Made _made;
    std::vector<Piece> _pieces;
    GDALDataset* _dataset = nullptr;
    double _spacingDeg = 0.0;
    RasterGrid _grid{{0.0, 1.0, 0.0, 0.0, 0.0, -1.0}, 1, 1};
};

}  // namespace osgbindem
