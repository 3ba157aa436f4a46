// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbindem reads an elevation raster from a web server, piece by piece. Oracle: the database from the same file on
// disk, and the server's own count of what it sent.

#include "Nginx.h"
#include "TestRaster.h"

#include <support/Programs.h>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;
using test::Nginx;
using test::quoted;

/// Rough heights, a post each tenth of a degree, as a Cloud Optimized GeoTIFF with overviews.
void writeCloudOptimized(const std::string& path) {
    constexpr int kColumns = 3600, kRows = 1800;
    const OpenRaster memory("/vsimem/rough.tif", {kColumns, kRows, 1}, GDT_Int16, -180.0, 90.0, 0.1, 0.1);
    std::vector<double> heights;
    std::uint32_t state = 1;
    for (int i = 0; i < kColumns * kRows; ++i) {
        state = state * 1664525U + 1013904223U;
        heights.push_back(state >> 22);
    }
    OpenRaster::write(memory.band(), heights);
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("COG");
    GDALDataset* const file = driver->CreateCopy(path.c_str(), memory.operator->(), FALSE, nullptr, nullptr, nullptr);
    ASSERT_NE(file, nullptr);
    GDALClose(GDALDataset::ToHandle(file));
}

class RemoteSource : public ::testing::Test {
protected:
    void SetUp() override {
        if (!Nginx::isInstalled()) GTEST_SKIP() << "needs nginx";
        fs::create_directory(folder / "served");
        writeCloudOptimized(raster);
    }

    test::Outcome build(const std::string& source, const std::string& name, const std::string& options) const {
        fs::create_directory(folder / name);
        return test::runStock(quoted(OSGBINDEM_FILE) + ' ' + quoted(source) + ' ' + options + " --quiet -o " +
                                  quoted(folder / (name + "/earth.osgb")),
                              test::Modules::Present);
    }
    test::Files files(const std::string& name) const {
        test::Files result = test::filesBelow(folder / name);
        result.erase("earth_tiles/state/sources.txt");  // which names the raster
        return result;
    }
    std::size_t bytesSent() const {
        std::size_t sum = 0;
        for (const Nginx::Request& request : server.requests()) sum += request.bytes;
        return sum;
    }

    test::TemporaryFolder folder;
    const std::string raster = folder / "served/dem.tif";
    Nginx server{folder / "served"};
    const std::string remote = "/vsicurl/" + server.url("dem.tif");
};

TEST_F(RemoteSource, GivesTheDatabaseOfTheFileOnDisk) {
    ASSERT_TRUE(server.start());
    ASSERT_EQ(build(raster, "disk", "--levels 1 --cells 12").code, 0);
    ASSERT_EQ(build(remote, "web", "--levels 1 --cells 12").code, 0);
    EXPECT_TRUE(files("web") == files("disk"));
    EXPECT_EQ(files("web").size(), 129U + 128U);  // and the records
}

TEST_F(RemoteSource, IsReadThroughItsOverviews) {
    ASSERT_TRUE(server.start());
    ASSERT_EQ(build(remote, "coarse", "--levels 0 --cells 24").code, 0);
    const std::size_t coarse = bytesSent();
    ASSERT_EQ(build(remote, "full", "--levels 0 --cells 24 --full-resolution").code, 0);
    const std::size_t full = bytesSent() - coarse;
    EXPECT_GT(coarse, 16384U);
    EXPECT_LT(10 * coarse, fs::file_size(raster));
    EXPECT_GT(full, fs::file_size(raster) / 2);
}

TEST_F(RemoteSource, SurvivesAServerInTroubleForAWhile) {
    // Every connection's first request is turned away.
    ASSERT_TRUE(server.start("if ($connection_requests = 1) { return 503; }"));
    ASSERT_EQ(build(raster, "disk", "--levels 0 --cells 12").code, 0);
    const test::Outcome outcome = build(remote, "web", "--levels 0 --cells 12");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_TRUE(files("web") == files("disk"));
    const std::vector<Nginx::Request> requests = server.requests();
    EXPECT_GE(std::count_if(requests.begin(), requests.end(), [](const auto& r) { return r.status == 503; }), 1);
}

TEST_F(RemoteSource, IsMissedInOneLine) {
    ASSERT_TRUE(server.start());
    const test::Outcome outcome = build("/vsicurl/" + server.url("absent.tif"), "web", "--levels 0");
    EXPECT_NE(outcome.code, 0);
    EXPECT_NE(outcome.text.find("absent.tif"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("404"), std::string::npos) << outcome.text;
    EXPECT_TRUE(files("web").empty());
}

}  // namespace
}  // namespace osgAnalyticBin
