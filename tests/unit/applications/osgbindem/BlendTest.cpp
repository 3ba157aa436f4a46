// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Borders of rasters inside coarser ones, as the heights of all rasters together. That bins hold them and that updates
// know what changes is tested on whole databases.

#include "DatabaseCheck.h"
#include "DemMosaic.h"
#include "Program.h"

#include <gtest/gtest.h>

namespace {

using osgbindem::DemMosaic;
using osgbindem::Settings;

class Blend : public testing::Test {
protected:
    [[nodiscard]] std::string file(const std::string& name) const { return _folder.file(name); }

    /// A flat raster; returns its file.
    std::string flat(const std::string& name, double west, double north, double spacing, int posts, double height) {
        TestRaster(west, north, spacing, spacing, posts, posts, [=](double, double) {
            return height;
        }).write(file(name));
        return file(name);
    }
    std::string globe(double height) {
        TestRaster::globe(1.0, [=](double, double) { return height; }).write(file("globe.tif"));
        return file("globe.tif");
    }

    static Settings settingsFor(const std::vector<std::string>& rasters, std::optional<double> blend = std::nullopt) {
        Settings settings;
        settings.ellipsoid = osgAnalyticBin::core::Ellipsoid(6378137.0, 6356752.3142);
        settings.blend = blend;
        for (const std::string& raster : rasters) settings.dems.push_back({raster});
        return settings;
    }

private:
    TempFolder _folder;
};

TEST_F(Blend, ClimbsFromTheCoarserRasterWithoutAStep) {
    DemMosaic mosaic(settingsFor({globe(100.0), flat("inset.tif", 10.0, 52.0, 0.02, 201, 900.0)}));
    EXPECT_EQ(mosaic.height({50.0, 12.0}), 900.0);
    EXPECT_EQ(mosaic.height({50.0, 9.0}), 100.0);
    EXPECT_NEAR(mosaic.height({50.0, 9.9901}), 100.0, 1.0);
    // The band is an eighth of the side: 0.32 degrees, the inset being narrower in longitude.
    EXPECT_EQ(mosaic.height({50.0, 10.6}), 900.0);
    double before = 100.0;
    for (double longitude = 9.9; longitude < 10.7; longitude += 0.01) {
        const double height = mosaic.height({50.0, longitude});
        EXPECT_GE(height, before - 1e-9);
        EXPECT_LE(height, before + 40.0) << longitude;
        before = height;
    }
    EXPECT_NEAR(mosaic.height({51.9, 12.0}), mosaic.height({48.1, 12.0}), 1e-6);
}

TEST_F(Blend, HasTheWidthThatIsGiven) {
    const std::vector<std::string> rasters{globe(100.0), flat("inset.tif", 10.0, 2.0, 0.02, 201, 900.0)};
    // At the equator a degree is 111.3 km; the border is half a pixel beyond the first post.
    DemMosaic wide(settingsFor(rasters, 111319.49));
    EXPECT_NEAR(wide.height({0.0, 10.49}), 500.0, 0.1);
    EXPECT_EQ(wide.height({0.0, 11.0}), 900.0);
    EXPECT_LT(wide.height({0.0, 10.9}), 900.0);
    DemMosaic none(settingsFor(rasters, 0.0));
    EXPECT_EQ(none.height({0.0, 10.0}), 900.0);
    EXPECT_EQ(none.height({0.0, 9.98}), 100.0);
}

TEST_F(Blend, RastersSideBySideHaveNoTrenchBetweenThem) {
    // As tiles of a survey: they share a row of posts.
    const std::string west = flat("west.tif", 10.0, 52.0, 0.01, 101, 900.0);
    const std::string east = flat("east.tif", 11.0, 52.0, 0.01, 101, 900.0);
    const std::string coarse = globe(100.0);
    DemMosaic mosaic(settingsFor({coarse, west, east}));
    for (double longitude = 10.5; longitude <= 11.5; longitude += 0.01)
        EXPECT_EQ(mosaic.height({51.5, longitude}), 900.0) << longitude;
    EXPECT_LT(mosaic.height({51.5, 10.0}), 200.0);
    EXPECT_LT(mosaic.height({51.5, 12.0}), 200.0);
    // One of another resolution that only meets them is no ground below either.
    const std::string south = flat("south.tif", 10.0, 51.0, 0.03, 34, 900.0);
    DemMosaic three(settingsFor({coarse, west, south}));
    EXPECT_EQ(three.height({51.01, 10.5}), 900.0);
    EXPECT_EQ(three.height({50.97, 10.5}), 900.0);
}

TEST_F(Blend, InsetsWithinInsetsMeetTheNextOne) {
    DemMosaic mosaic(settingsFor(
        {globe(0.0), flat("middle.tif", 10.0, 50.0, 0.05, 81, 500.0), flat("fine.tif", 11.5, 48.5, 0.01, 101, 800.0)}));
    EXPECT_NEAR(mosaic.height({48.0, 11.4951}), 500.0, 1.0);
    EXPECT_EQ(mosaic.height({48.0, 12.0}), 800.0);
}

TEST_F(Blend, NothingIsBlendedWithoutACoarserRaster) {
    DemMosaic alone(settingsFor({flat("inset.tif", 10.0, 52.0, 0.02, 201, 900.0)}));
    EXPECT_EQ(alone.height({50.0, 10.0}), 900.0);
    EXPECT_EQ(alone.height({50.0, 9.9}), 0.0);
}

TEST_F(Blend, PassesTheDateLine) {
    DemMosaic mosaic(settingsFor({globe(100.0), flat("fiji.tif", 178.0, -16.0, 0.02, 201, 900.0)}));
    EXPECT_EQ(mosaic.height({-18.0, 180.0}), 900.0);
    EXPECT_EQ(mosaic.height({-18.0, -180.0}), 900.0);
    EXPECT_NEAR(mosaic.height({-18.0, -178.2}), mosaic.height({-18.0, 178.2}), 1e-6);
    EXPECT_LT(mosaic.height({-18.0, -178.2}), 900.0);
}

}  // namespace
