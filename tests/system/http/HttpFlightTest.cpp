// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The stock osgviewer flies over a globe that a web server gives. Oracle: the pictures of the flight over the files
// without any culling; what is sent is counted in the server's log.

#include "Nginx.h"
#include "Report.h"

#include <cstdio>
#include <set>

namespace osgAnalyticBin {
namespace {

using test::Nginx;

constexpr const char* kPath =
    "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n"
    "oblique_1,-10,170,800000,-4,178,0,60,10000,8000000\n"
    "oblique_2,75,-60,600000,80,-40,0,60,10000,8000000\n"
    "narrow,5,5,100000,6,8,0,10,10000,4000000\n";

struct Sent {
    std::size_t requests = 0;
    std::size_t bytes = 0;
};

class HttpFlight : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = new test::TemporaryFolder;
        if (!canFly()) return;
        globe = folder->makeFolder("globe");
        ASSERT_TRUE(test::makeSmallGlobe(globe));
        path = folder->write("path.csv", kPath);
        truth = fly(globe + "/earth.osgb", "none", "files");
    }
    static void TearDownTestSuite() { delete folder; }

    void SetUp() override {
        if (!canFly()) GTEST_SKIP() << "needs nginx, osgviewer and xvfb-run";
    }

    static bool canFly() { return Nginx::isInstalled() && test::canRunViewer(); }

    // Returns: the folder of the pictures.
    static std::string fly(const std::string& database, const std::string& method, const std::string& name,
                           const std::string& environment = {}) {
        const std::string out = *folder / name;
        const test::Outcome outcome =
            test::runViewer("--SingleThreaded " + test::quoted(database + ".(method=" + method + ").analyticbin") +
                                ' ' + test::quoted(path + ".(out=" + out + ",frames=2).binflight"),
                            test::Modules::Present, "OSG_NOTIFY_LEVEL=NOTICE " + environment);
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return out;
    }

    static void expectEqualPictures(const std::vector<std::string>& flights) {
        std::vector<std::string> folders{truth};
        folders.insert(folders.end(), flights.begin(), flights.end());
        for (const std::string& mismatch : bench::mismatchesOf(bench::readFlights(folders))) ADD_FAILURE() << mismatch;
    }

    static Sent sentBy(const Nginx& nginx) {
        Sent sent;
        for (const Nginx::Request& request : nginx.requests()) {
            ++sent.requests;
            sent.bytes += request.bytes;
            EXPECT_TRUE(request.status == 200 || !request.isTile()) << request.path;
        }
        return sent;
    }

    static inline test::TemporaryFolder* folder = nullptr;
    static inline std::string globe;
    static inline std::string path;
    static inline std::string truth;
};

TEST_F(HttpFlight, BinsAskForLessThanSpheresAndDrawTheSame) {
    std::vector<std::string> flights;
    std::vector<Sent> sent;
    for (const char* method : {"sphere", "quadratic"}) {
        Nginx nginx(globe);
        ASSERT_TRUE(nginx.start());
        flights.push_back(fly(nginx.url("earth.osgb"), method, method));
        sent.push_back(sentBy(nginx));
        std::printf("%s: %zu requests, %zu bytes\n", method, sent.back().requests, sent.back().bytes);
    }
    expectEqualPictures(flights);
    EXPECT_GT(sent[1].requests, 1u);
    EXPECT_LT(sent[1].requests, sent[0].requests);
    EXPECT_LT(sent[1].bytes, sent[0].bytes);
}

// The pager writes what it has read, bins and all, into the cache. A later flight may ask for other files, too: what is
// hidden while files are on their way depends on which came first.
TEST_F(HttpFlight, OsgsFileCacheServesLaterFlights) {
    Nginx nginx(globe);
    ASSERT_TRUE(nginx.start());
    const std::string cache = "OSG_FILE_CACHE=" + folder->makeFolder("cache");
    const std::string database = nginx.url("earth.osgb");
    const std::string first = fly(database, "quadratic", "uncached", cache);
    const std::string second = fly(database, "quadratic", "cached", cache);
    std::multiset<std::string> fetched;
    for (const Nginx::Request& request : nginx.requests()) {
        if (request.isTile()) fetched.insert(request.path);
    }
    EXPECT_GT(fetched.size(), 10u);
    for (const std::string& file : fetched) EXPECT_EQ(fetched.count(file), 1u) << file;
    expectEqualPictures({first, second, fly(database, "sphere", "cached_sphere", cache)});
}

}  // namespace
}  // namespace osgAnalyticBin
