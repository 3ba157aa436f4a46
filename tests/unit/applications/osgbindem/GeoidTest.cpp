// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What heights are above. Heights of the geoid EGM96 are those that its authors print: 17.16 m at latitude and
// longitude 0, -106.9 m south of India.

#include "DatabaseCheck.h"
#include "DemMosaic.h"
#include "Failure.h"
#include "Program.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace {

using osgbindem::DemMosaic;
using osgbindem::Settings;

constexpr const char* kEgm96 = "/usr/share/proj/egm96_15.gtx";

class Geoid : public testing::Test {
protected:
    void SetUp() override {
        GDALAllRegister();
        if (!std::filesystem::exists(kEgm96)) GTEST_SKIP() << "package proj-data is not installed";
    }

    [[nodiscard]] std::string file(const std::string& name) const { return _folder.file(name); }

    /// A globe at 100 m.
    std::string globe(const std::string& name, const std::string& reference) {
        TestRaster raster = TestRaster::globe(2.0, [](double, double) { return 100.0; });
        raster.setReference(reference);
        raster.write(file(name));
        return file(name);
    }
    static Settings settingsFor(const std::vector<std::string>& rasters, const std::string& geoid = {}) {
        Settings settings;
        settings.ellipsoid = osgAnalyticBin::core::Ellipsoid(6378137.0, 6356752.3142);
        settings.geoid = geoid;
        for (const std::string& raster : rasters) settings.dems.push_back({raster});
        return settings;
    }

private:
    TempFolder _folder;
};

TEST_F(Geoid, IsAddedWhereItIsAskedFor) {
    const std::string raster = globe("globe.tif", "EPSG:4326");
    DemMosaic plain(settingsFor({raster}));
    EXPECT_EQ(plain.height({0.0, 0.0}), 100.0);
    for (const char* geoid : {"egm96", kEgm96}) {
        DemMosaic mosaic(settingsFor({raster}, geoid));
        EXPECT_NEAR(mosaic.height({0.0, 0.0}), 117.16, 0.1) << geoid;
        EXPECT_NEAR(mosaic.height({4.75, 78.75}), 100.0 - 106.9, 0.5) << geoid;
        EXPECT_EQ(mosaic.height({10.0, 180.0}), mosaic.height({10.0, -180.0})) << geoid;
        const osgbindem::Interval range = mosaic.range({75.0, 0.0, 80.0, 8.0});
        EXPECT_LE(range.lower, 100.0 - 106.9);
        EXPECT_GE(range.upper, mosaic.height({0.0, 75.0}));
        EXPECT_LT(range.upper - range.lower, 50.0);
    }
}

TEST_F(Geoid, IsReadFromTheRastersReference) {
    DemMosaic mosaic(settingsFor({globe("globe.tif", "EPSG:4326+5773")}));
    EXPECT_NEAR(mosaic.height({0.0, 0.0}), 117.16, 0.1);
    DemMosaic none(settingsFor({file("globe.tif")}, "none"));
    EXPECT_EQ(none.height({0.0, 0.0}), 100.0);
    // Heights that are above the ellipsoid already.
    DemMosaic ellipsoidal(settingsFor({globe("ellipsoidal.tif", "EPSG:4979")}));
    EXPECT_EQ(ellipsoidal.height({0.0, 0.0}), 100.0);
}

TEST_F(Geoid, IsAddedOnceToMapProjections) {
    // The geoid is 28.7 m below the ellipsoid in the middle.
    TestRaster raster(600500.0, 3700500.0, 1000.0, 1000.0, 60, 60, [](double, double) { return 5000.0; });
    raster.setReference("EPSG:32614+5773");
    raster.write(file("metres.tif"));
    const osgbindem::PositionDeg middle{33.162, -97.613};
    EXPECT_NEAR(DemMosaic(settingsFor({file("metres.tif")})).height(middle), 4971.3, 0.1);
    EXPECT_NEAR(DemMosaic(settingsFor({file("metres.tif")}, "egm96")).height(middle), 4971.3, 0.1);
    EXPECT_NEAR(DemMosaic(settingsFor({file("metres.tif")}, "none")).height(middle), 5000.0, 1e-6);
    // Texas and heights, both in feet of the US survey; the user's word counts more than the raster's.
    TestRaster feet(2300500.0, 7000500.0, 1000.0, 1000.0, 60, 60, [](double, double) { return 5000.0; });
    feet.setReference("EPSG:2276+6360");
    feet.write(file("feet.tif"));
    Settings settings = settingsFor({file("feet.tif")}, "none");
    EXPECT_NEAR(DemMosaic(settings).height({32.7835, -97.3237}), 5000.0 * 1200.0 / 3937.0, 1e-6);
    settings.dems.front().metresPerUnit = 0.1;
    EXPECT_NEAR(DemMosaic(settings).height({32.7835, -97.3237}), 500.0, 1e-6);
}

TEST_F(Geoid, WithoutItsGridIsRefused) {
    // No package of Debian has the grid of the Dutch NAP.
    globe("globe.tif", "EPSG:4326+5709");
    const Outcome outcome = run({file("globe.tif"), "-o", file("earth.osgb")});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_NE(outcome.errors.find("--geoid"), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.errors.find('\n'), outcome.errors.size() - 1) << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(file("earth.osgb")));
    build({file("globe.tif"), "--geoid", "none", "--levels", "0", "--cells", "4", "-o", file("earth.osgb")});
}

TEST_F(Geoid, IsInTheDatabase) {
    build({globe("globe.tif", "EPSG:4326"), "--geoid", "egm96", "--levels", "1", "--cells", "8", "-o",
           file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(file("earth.osgb"));
    EXPECT_NEAR(database.altitudeAt(0.0, 0.0), 117.16, 0.3);
    checkSharedPosts(database);
}

}  // namespace
