// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles that a real DatabasePager loads from a real web server, in good order and in trouble. Oracle: what is drawn
// from the same files, or from those of them that the server gives. Needs OSG_LIBRARY_PATH.

#include "Nginx.h"
#include "PagedFlight.h"

#include <osgDB/ReadFile>

#include <regex>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;
using test::CullView;
using test::Nginx;
using test::PagedFlight;

// Of the finest tiles in view some are missing, for some the server is in trouble, for some it sends something else.
constexpr const char* kMissing = "/L02_X[0-9]*[048]_";
constexpr const char* kInTrouble = "/L02_X[0-9]*6_Y[0-9]*[48]";
constexpr const char* kNonsense = "/L02_X[0-9]*6_Y[0-9]*[026]";

std::string failingRules() {
    return std::string("location ~ '") + kMissing + "' { return 404; }\nlocation ~ '" + kInTrouble +
           "' { return 503; }\nlocation ~ '" + kNonsense + "' { return 200 'Please log in.'; }";
}

// 300 km above the hills, looking 45 degrees down.
CullView view() {
    const osg::Vec3d eye(5.9e6, 1.5e6, 2.7e6);
    osg::Vec3d up = eye;
    up.normalize();
    const osg::Vec3d east = osg::Vec3d(0, 0, 1) ^ up;
    return CullView::lookAt(eye, eye - up + east, up, 50.0);
}

class HttpPaging : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        folder = new test::TemporaryFolder;
        if (!Nginx::isInstalled()) return;
        ASSERT_TRUE(test::makeSmallGlobe(folder->path()));
        PagedFlight flight(*read(*folder / "earth.osgb"));
        ASSERT_TRUE(flight.load(view()));
        whole = flight.drawn();
        ASSERT_GT(whole.size(), 5u);
    }
    static void TearDownTestSuite() { delete folder; }

    void SetUp() override {
        if (!Nginx::isInstalled()) GTEST_SKIP() << "needs nginx";
    }

    // The scene stays until the end of the test, longer than its flight.
    static osg::ref_ptr<osg::Node> read(const std::string& name, const std::string& parameters = "") {
        osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(name + parameters + ".analyticbin");
        if (!node) ADD_FAILURE() << name << " cannot be read";
        scenes.push_back(node ? node : new osg::Group);
        return scenes.back();
    }

    static bool matches(const std::string& path, const char* pattern) {
        return std::regex_search(path, std::regex(pattern));
    }

    static bool fails(const std::string& path) {
        return matches(path, kMissing) || matches(path, kInTrouble) || matches(path, kNonsense);
    }

    // Frames until nothing is missing but what the server does not give.
    static bool loadAllBut(PagedFlight& flight, bool (*isNotGiven)(const std::string&)) {
        return flight.framesUntil(view(), [&flight, isNotGiven] {
            const auto& wanted = flight.wanted();
            return !wanted.empty() && std::all_of(wanted.begin(), wanted.end(), isNotGiven);
        });
    }

    // What is drawn from the files that the server gives.
    static std::multiset<std::string> drawnWithoutFailing() {
        const test::TemporaryFolder partial;
        fs::copy(folder->path(), partial.path(), fs::copy_options::recursive);
        std::vector<fs::path> failing;
        for (const auto& entry : fs::recursive_directory_iterator(partial.path()))
            if (fails(entry.path().string())) failing.push_back(entry.path());
        for (const fs::path& file : failing) fs::remove(file);
        PagedFlight flight(*read(partial / "earth.osgb"));
        EXPECT_TRUE(loadAllBut(flight, fails));
        return flight.drawn();
    }

    // The largest number of requests for one file that failed.
    [[nodiscard]] int mostRequests() const {
        std::map<std::string, int> counts;
        int most = 0;
        for (const Nginx::Request& request : nginx.requests())
            if (fails(request.path)) most = std::max(most, ++counts[request.path]);
        return most;
    }

    static inline test::TemporaryFolder* folder = nullptr;
    static inline std::multiset<std::string> whole;
    static inline std::vector<osg::ref_ptr<osg::Node>> scenes;
    Nginx nginx{folder->path()};
};

TEST_F(HttpPaging, DrawsWhatIsDrawnFromFilesAndEveryTileHasItsBin) {
    ASSERT_TRUE(nginx.start());
    const osg::ref_ptr<osg::Node> scene = read(nginx.url("earth.osgb"), ".(method=exact)");
    const std::size_t before = test::tilesWith<AnalyticBinCullCallback>(*scene);
    PagedFlight flight(*scene);
    ASSERT_TRUE(flight.load(view()));
    EXPECT_EQ(flight.drawn(), whole);
    EXPECT_GT(test::tilesWith<AnalyticBinCullCallback>(*scene), before);
    for (const Nginx::Request& request : nginx.requests())
        EXPECT_TRUE(request.status == 200 || !request.isTile()) << request.path;
}

TEST_F(HttpPaging, OsgByItselfAsksForMissingTilesInEveryFrame) {
    ASSERT_TRUE(nginx.start(failingRules()));
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(nginx.url("earth.osgb"));
    ASSERT_TRUE(scene);
    scene->setUpdateCallback(nullptr);  // no bins
    PagedFlight flight(*scene);
    EXPECT_TRUE(flight.framesUntil(view(), [this] { return mostRequests() > 30; }));
}

TEST_F(HttpPaging, WhereTilesFailTheirParentsStayAndTheServerIsSpared) {
    ASSERT_TRUE(nginx.start(failingRules()));
    PagedFlight flight(*read(nginx.url("earth.osgb")));
    ASSERT_TRUE(loadAllBut(flight, fails));
    constexpr int kFrames = 200;
    flight.frames(view(), kFrames);
    EXPECT_EQ(flight.drawn(), drawnWithoutFailing());
    EXPECT_NE(flight.drawn(), whole);
    for (const char* pattern : {kMissing, kInTrouble, kNonsense}) {
        const std::vector<Nginx::Request> requests = nginx.requests();
        EXPECT_TRUE(std::any_of(requests.begin(), requests.end(), [pattern](const Nginx::Request& request) {
            return matches(request.path, pattern);
        })) << pattern;
    }
    EXPECT_LT(mostRequests(), 10);
    // The server recovers: what failed is asked for again.
    ASSERT_TRUE(nginx.start());
    ASSERT_TRUE(flight.load(view()));
    EXPECT_EQ(flight.drawn(), whole);
}

TEST_F(HttpPaging, AServerThatStopsInTheMiddleOfAFileAndComesBackLeavesNoTrace) {
    ASSERT_TRUE(nginx.start());
    const osg::ref_ptr<osg::Node> scene = read(nginx.url("earth.osgb"));
    ASSERT_TRUE(nginx.start("limit_rate 4k;"));  // some seconds a tile
    PagedFlight flight(*scene);
    constexpr int kFrames = 200;
    flight.frames(view(), kFrames);
    const std::multiset<std::string> coarse = flight.drawn();
    EXPECT_FALSE(coarse.empty());
    nginx.stop();
    flight.frames(view(), kFrames);
    EXPECT_EQ(flight.drawn(), coarse);
    EXPECT_FALSE(flight.wanted().empty());
    ASSERT_TRUE(nginx.start());
    ASSERT_TRUE(flight.load(view()));
    EXPECT_EQ(flight.drawn(), whole);
}

// OSG's client waits for ever unless it is told otherwise, and with it the pager's only thread.
TEST_F(HttpPaging, TilesThatNeverEndAreGivenUpAfterTheTimeoutThatTheUserSets) {
    ASSERT_TRUE(nginx.start(std::string("location ~ '") + kInTrouble + "' { limit_rate 1; }"));
    osgDB::Registry::instance()->setOptions(new osgDB::Options("OSG_CURL_TIMEOUT=1"));
    PagedFlight flight(*read(nginx.url("earth.osgb")));
    osgDB::Registry::instance()->setOptions(nullptr);
    ASSERT_TRUE(loadAllBut(flight, [](const std::string& name) { return matches(name, kInTrouble); }));
    ASSERT_TRUE(nginx.start());
    ASSERT_TRUE(flight.load(view()));
    EXPECT_EQ(flight.drawn(), whole);
}

TEST_F(HttpPaging, AServerThatIsNotThereIsAnErrorAndNothingElse) {
    EXPECT_FALSE(osgDB::readRefNodeFile(nginx.url("earth.osgb") + ".analyticbin"));
}

}  // namespace
}  // namespace osgAnalyticBin
