// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The two proofs that verdicts are set against, and what the experiment is for: sound methods are never wrong, the
// published rule and the corners are, and the counts fit together. The proofs come from different code: a plane between
// tile and frustum from the core, a point in both from sampling. At the end the program from outside.

#include "Experiment.h"
#include "GlmBridge.h"
#include "Terrain.h"
#include "TestRaster.h"
#include "TileTree.h"

#include <glm/trigonometric.hpp>

#include <memory>
#include <support/Programs.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::paper {

/// A globe in a folder of its own, with mountains and seas that differ everywhere, -6000 to 6000 m, whole metres.
struct TestGlobe {
    [[nodiscard]] static double height(double latitudeDeg, double longitudeDeg) {
        const double p = glm::radians(latitudeDeg), l = glm::radians(longitudeDeg);
        return std::round(3000.0 * std::sin(7.0 * p + std::sin(3.0 * l)) + 2000.0 * std::cos(5.0 * l) * std::cos(p) +
                          1000.0 * std::sin(23.0 * p) * std::sin(19.0 * l));
    }

    const test::TemporaryFolder folder;
    const std::string file = TestRaster::globe(2.0, height).write(folder / "hills.tif");
};

namespace {

TEST(TileTree, NoTileIsBothOutsideAndSeenAndAWitnessIsAPointOfTheTileInTheFrustum) {
    const TestGlobe globe;
    Terrain terrain(globe.file, 5);
    std::size_t outside = 0, seen = 0;
    for (std::size_t view = 0; view < 2 * kViewKinds.size(); ++view) {
        const Camera camera = randomCamera(terrain, view / 2, view % 2);
        for (const TreeTile& tile : TileTree(terrain, camera).tiles) {
            const auto found = findWitness(defaultEllipsoid(), tile.box, camera);
            EXPECT_FALSE(tile.isOutside && found);
            outside += tile.isOutside ? 1U : 0U;
            seen += found ? 1U : 0U;
            if (!tile.witness) continue;
            EXPECT_TRUE(tile.box.contains(tile.witness->position));
            for (const core::Plane& plane : camera.planes())
                EXPECT_GE(plane.distance(defaultEllipsoid().toEcef(tile.witness->position)), tile.witness->depth);
            EXPECT_GT(tile.witness->depth, 0.0);
        }
    }
    EXPECT_GT(outside, 1000U);
    EXPECT_GT(seen, 500U);
}

Results run(std::size_t cameras) {
    const TestGlobe globe;
    Terrain terrain(globe.file, 4);
    return runExperiment(terrain, cameras);
}

class Experiment : public testing::Test {
protected:
    static void SetUpTestSuite() { _results = std::make_unique<Results>(run(20)); }
    static void TearDownTestSuite() { _results.reset(); }

    static Counts counts(Method method) { return _results->sum().methods[indexOf(method)]; }

    static inline std::unique_ptr<Results> _results;
};

TEST_F(Experiment, SoundMethodsAreNeverWrongAndTighterOnesTestAndDrawFewer) {
    const std::array<Method, 4> fromTight{Method::Hull, Method::Exact, Method::Quadratic, Method::Box};
    for (std::size_t i = 0; i < fromTight.size(); ++i) {
        SCOPED_TRACE(kMethodNames[indexOf(fromTight[i])]);
        const Counts found = counts(fromTight[i]);
        EXPECT_EQ(found.wrongCulls + found.holes + found.lostLeaves + found.wrongInsides, 0U);
        EXPECT_FALSE(_results->worst[indexOf(fromTight[i])]);
        if (i == 0) continue;
        EXPECT_LE(counts(fromTight[i - 1]).tested, found.tested);
        EXPECT_LE(counts(fromTight[i - 1]).drawn, found.drawn);
    }
    // Nearly every leaf is proven either way.
    const std::uint64_t seen = _results->sum().seenLeaves;
    EXPECT_GE(counts(Method::Hull).drawn, seen);
    EXPECT_LE(counts(Method::Hull).drawn - seen, seen / 200);
    EXPECT_EQ(counts(Method::Hull).wrongKeeps, 0U);
}

TEST_F(Experiment, CornersAndThePublishedRuleCullWhatIsSeenAndTheWorstCullIsAProof) {
    for (const Method method : {Method::Corners, Method::Paper}) {
        SCOPED_TRACE(kMethodNames[indexOf(method)]);
        EXPECT_GT(counts(method).wrongCulls, 0U);
        EXPECT_GT(counts(method).holes, 0U);
        EXPECT_GT(counts(method).lostLeaves, 0U);
        EXPECT_LE(counts(method).holes, counts(method).wrongCulls);
        const auto& worst = _results->worst[indexOf(method)];
        ASSERT_TRUE(worst);
        EXPECT_TRUE(worst->isHole);
        EXPECT_TRUE(worst->box.contains(worst->witness.position));
        for (const core::Plane& plane : worst->camera.planes())
            EXPECT_GE(plane.distance(defaultEllipsoid().toEcef(worst->witness.position)), worst->witness.depth);
        EXPECT_EQ(TileBins(defaultEllipsoid(), worst->box).classify(method, Frustum(worst->camera)),
                  core::Side::Outside);
    }
}

TEST_F(Experiment, EveryRunGivesTheSameCounts) {
    EXPECT_EQ(csvOf(run(3)), csvOf(run(3)));
}

namespace fs = std::filesystem;
using test::Outcome;
using test::textOfFile;
using Words = std::vector<std::string>;

class Program : public testing::Test {
protected:
    static Outcome run(Words words) {
        words.insert(words.begin(), PAPER_FILE);
        return test::runStock(test::quoted(words), test::Modules::Absent);
    }
    [[nodiscard]] Words namesIn(const std::string& folder) const {
        Words names;
        for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

    const TestGlobe _globe;
    const test::TemporaryFolder _folder;
    const std::string _csv = _folder / "a.csv";
};

TEST_F(Program, WritesTableAndCsv) {
    const Outcome outcome = run({_globe.file, "--levels", "3", "--cameras", "2", "--csv", _csv});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(namesIn(_folder.path()), Words{"a.csv"});
    for (const char* const part : {"all views", "corners culls a tile of which a point is "})
        EXPECT_NE(outcome.text.find(part), std::string::npos) << outcome.text;
    const std::string csv = textOfFile(_csv);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 6);
    const std::string gtopo30 = SAMPLE_DATA "/dem/gtopo30_w020n90_cut_3E9E_50N54N.tif";
    if (!fs::exists(gtopo30)) GTEST_SKIP() << gtopo30 << " is absent";
    EXPECT_EQ(run({gtopo30, "--levels", "7", "--cameras", "2", "--csv", _csv}).code, 0);
    EXPECT_NE(textOfFile(_csv).find("quadratic"), std::string::npos);
}

TEST_F(Program, SaysWhatIsWrong) {
    test::expectOneLine(run({_folder / "absent.tif"}), "osgbinpaper", "absent.tif");
    test::expectOneLine(run({_folder.write("text.tif", "no raster")}), "osgbinpaper", "text.tif");
    const Words quick{PAPER_FILE, _globe.file, "--levels", "1", "--cameras", "1"};
    const Outcome full = test::runStock("sh -c \"" + test::quoted(quick) + " >/dev/full\"", test::Modules::Absent);
    test::expectOneLine(full, "osgbinpaper", "standard output");
    const Outcome absent = run({_globe.file, "--levels", "1", "--cameras", "1", "--csv", _folder / "absent/a.csv"});
    EXPECT_EQ(absent.code, 1);
    EXPECT_EQ(absent.linesWith("cannot write"), 1) << absent.text;
    EXPECT_EQ(namesIn(_folder.path()), Words{"text.tif"});
}

}  // namespace
}  // namespace osgAnalyticBin::paper
