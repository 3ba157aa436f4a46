// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Photogrammetry sets as an application opens them: where they stand, and what is said of broken ones. How they are
// culled: PhotogrammetryCullTest.cpp. Oracles of places: the meridian arc by quadrature, OSG's ellipsoid.

#include "DatabaseFixture.h"
#include "PhotogrammetryFixture.h"

#include <osgAnalyticBin/Declarations.h>

#include <cmath>
#include <filesystem>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;

using test::CapturedNotes;

class Photogrammetry : public test::PhotogrammetryFixture {
protected:
    // Where a point of the tiles' frame stands on the globe.
    osg::Vec3d placed(const osg::Vec3d& point) const {
        const osg::ref_ptr<osg::Node> scene = read();
        EXPECT_TRUE(scene) << errorOfRead();
        return scene ? point * setIn(*scene)->getMatrix() : osg::Vec3d();
    }
    void expectError(const std::string& text) const {
        EXPECT_NE(errorOfRead().find(text), std::string::npos) << errorOfRead();
    }
    void expectError(const std::string& srs, const std::string& origin, const std::string& text) const {
        writeMetadata(srs, origin);
        expectError(text);
    }
    static osg::Vec3d ecef(double latitudeDeg, double longitudeDeg, double height) {
        return test::ecefDeg(latitudeDeg, longitudeDeg, height);
    }
};

// Metres along the meridian from the equator, by Simpson's rule.
double meridianArc(double latitude) {
    const double a = osg::WGS_84_RADIUS_EQUATOR, b = osg::WGS_84_RADIUS_POLAR, e2 = 1.0 - b * b / (a * a);
    const auto radius = [&](double p) { return a * (1.0 - e2) / std::pow(1.0 - e2 * std::sin(p) * std::sin(p), 1.5); };
    constexpr int kSteps = 2000;
    const double step = latitude / kSteps;
    double sum = radius(0.0) + radius(latitude);
    for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * radius(i * step);
    return sum * step / 3.0;
}

TEST_F(Photogrammetry, StandsWhereEnuSays) {
    EXPECT_NEAR((placed({0, 0, 0}) - ecef(47.5, 11.2, 0.0)).length(), 0.0, 1e-6);
    EXPECT_NEAR((placed({0, 0, 250}) - ecef(47.5, 11.2, 250.0)).length(), 0.0, 1e-6);
    // 100 m to the north are to the north
    const osg::Vec3d north = placed({0, 100, 0}) - placed({0, 0, 0});
    const osg::Vec3d expected = ecef(47.501, 11.2, 0.0) - ecef(47.5, 11.2, 0.0);
    EXPECT_NEAR(north.length(), 100.0, 1e-6);
    EXPECT_GT(north * expected / (north.length() * expected.length()), 1.0 - 1e-8);
}

TEST_F(Photogrammetry, AddsTheOriginInTheFrameOfEnu) {
    writeMetadata("ENU:47.5,11.2", "10,20,30");
    const osg::Vec3d moved = placed({1, 2, 3});
    writeMetadata("ENU:47.5,11.2", "0,0,0");
    EXPECT_NEAR((moved - placed({11, 22, 33})).length(), 0.0, 1e-6);
}

#ifdef OSGANALYTICBIN_PROJ
// On its central meridian the transverse Mercator projection is the meridian arc by its scale.
TEST_F(Photogrammetry, StandsWhereAMapSays) {
    const double latitude = osg::DegreesToRadians(47.5);
    const double northing = 0.9996 * meridianArc(latitude);
    writeMetadata("EPSG:32632", "500000," + std::to_string(northing) + ",600");
    // the tangent touches at the middle of the set, some metres up
    EXPECT_NEAR((placed({0, 0, 0}) - ecef(47.5, 9.0, 600.0)).length(), 0.0, 0.01);
    EXPECT_NEAR((placed({0, 0, 100}) - ecef(47.5, 9.0, 700.0)).length(), 0.0, 0.01);
    // metres of the map are longer on the earth
    EXPECT_NEAR((placed({100, 0, 0}) - placed({0, 0, 0})).length(),
                100.0 / 0.9996 * (1.0 + 650.0 / osg::WGS_84_RADIUS_EQUATOR), 0.01);
}

TEST_F(Photogrammetry, LeavesTheCurvedEarthAsDocumented) {
    writeMetadata("EPSG:32632", "500000,5260000,0");
    const osg::Vec3d far = placed({0, 5000, 0});
    double latitude = 0.0, longitude = 0.0, height = 0.0;
    osg::EllipsoidModel().convertXYZToLatLongHeight(far.x(), far.y(), far.z(), latitude, longitude, height);
    EXPECT_NEAR(height, 5000.0 * 5000.0 / (2.0 * 6.37e6), 0.1);
}

TEST_F(Photogrammetry, StandsWhereEarthCentredCoordinatesSay) {
    const osg::Vec3d origin = ecef(47.5, 11.2, 0.0);
    writeMetadata("EPSG:4978",
                  std::to_string(origin.x()) + ',' + std::to_string(origin.y()) + ',' + std::to_string(origin.z()));
    EXPECT_NEAR((placed({3, 4, 5}) - (origin + osg::Vec3d(3, 4, 5))).length(), 0.0, 1e-3);
}

TEST_F(Photogrammetry, IsRefusedWhereThePlaceCannotBeKnown) {
    expectError("EPSG:99999999", "0,0,0", "EPSG:99999999\" is not known to PROJ");
    expectError("EPSG:4326", "0,0,0", "coordinates in degrees");
    expectError("EPSG:32632", "1e30,1e30,0", "are SRS and SRSOrigin right?");
}
#else
TEST_F(Photogrammetry, IsRefusedWhereThePlaceCannotBeKnown) {
    expectError("EPSG:32632", "0,0,0", "built with PROJ");
}
#endif

TEST_F(Photogrammetry, WithoutAReferenceSystemStandsInItsOwnCoordinates) {
    writeMetadata("", "0,0,0");
    const CapturedNotes notes;
    const osg::ref_ptr<osg::Node> scene = read();
    ASSERT_TRUE(scene);
    EXPECT_EQ(notes.count("has no SRS"), 1U);
    EXPECT_TRUE(setIn(*scene)->getMatrix().isIdentity());
    EXPECT_TRUE(isPhotogrammetrySet(*scene));
}

TEST_F(Photogrammetry, SaysWhatIsWrongWithItsMetadata) {
    for (const char* text : {"", "<ModelMeta", "\x89PNG"}) {
        (void)_folder.write("metadata.xml", text);
        expectError("no element ModelMetadata");
    }
    expectError("ENU:47.5", "0,0,0", "ENU:LATITUDE,LONGITUDE");
    expectError("ENU:97.5,11", "0,0,0", "ENU:LATITUDE,LONGITUDE");
    expectError("ENU:47.5,11", "0,0", "three numbers");
    expectError("ENU:47.5,11", "0,nan,0", "three numbers");
}

TEST_F(Photogrammetry, SaysWhatIsWrongWithItsFolder) {
    fs::rename(_folder / "Data", _folder / "Elsewhere");
    expectError("no folder Data");
    fs::create_directory(_folder / "Data");
    expectError("holds no tile");
    const CapturedNotes notes;
    (void)osgDB::Registry::instance()->readNode("http://host.invalid/set/metadata.xml.analyticbin", nullptr);
    EXPECT_EQ(notes.count("not from a server"), 1U);
}

TEST_F(Photogrammetry, LeavesOutTilesThatAreMissingOrBrokenWithOneWarningEach) {
    const std::string folder = _folder / "Data/Tile_+000_+000";
    fs::remove_all(folder);
    fs::create_directory(folder);
    (void)_folder.write("Data/Tile_+002_+002/Tile_+002_+002.osgb", "broken");
    fs::remove(_folder / "Data/Tile_+002_+001/Tile_+002_+001.osgb");
    fs::remove(_folder / "Data/Tile_+002_+001/Tile_+002_+001_L1_0.osgb");
    const CapturedNotes notes;
    const osg::ref_ptr<osg::Node> scene = read();
    ASSERT_TRUE(scene);
    EXPECT_EQ(notes.count("2 folders have no root file, the first is \"Data/Tile_+000_+000\""), 1U);
    EXPECT_EQ(notes.count("1 root files cannot be read, the first is \"Data/Tile_+002_+002/"), 1U);
    EXPECT_EQ(setIn(*scene)->getNumChildren(), 6U);
}

TEST_F(Photogrammetry, FindsRootFilesByTheNamesOfTheOthers) {
    const std::string folder = _folder / "Data/Tile_+000_+000";
    fs::rename(folder, _folder / "Data/Block");
    const CapturedNotes notes;
    const osg::ref_ptr<osg::Node> scene = read();
    ASSERT_TRUE(scene);
    EXPECT_EQ(setIn(*scene)->getNumChildren(), 9U);
    EXPECT_EQ(notes.count("no root file"), 0U);
}

}  // namespace
}  // namespace osgAnalyticBin
