// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Heights of tiles against samples of the raster, the two proofs that verdicts are set against, and what the experiment
// is for: sound methods are never wrong, the published rule and the corners are, and the counts fit together. The
// proofs come from different code: a plane between tile and frustum from the core, a point in both from sampling. At
// the end the program from outside.

#include "Experiment.h"
#include "Terrain.h"
#include "TileTree.h"

#include <gdal.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <support/FailureText.h>
#include <support/Random.h>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::paper {

/// Mountains and seas that differ everywhere, from -6000 to 6000 m.
[[nodiscard]] inline double hills(double latitudeDeg, double longitudeDeg) {
    constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
    const double p = latitudeDeg * kRadiansPerDegree;
    const double l = longitudeDeg * kRadiansPerDegree;
    return 3000.0 * std::sin(7.0 * p + std::sin(3.0 * l)) + 2000.0 * std::cos(5.0 * l) * std::cos(p) +
           1000.0 * std::sin(23.0 * p) * std::sin(19.0 * l);
}

/// A raster of the hills as a text file in a folder of its own, `spacing` degrees apart, from the south-west corner on;
/// round the globe unless told otherwise.
class TestGlobe {
public:
    explicit TestGlobe(double west = -180.0, double south = -90.0, int columns = 180, int rows = 90,
                       double spacing = 2.0) {
        GDALAllRegister();
        std::ostringstream text;
        text << "ncols " << columns << "\nnrows " << rows << "\nxllcorner " << west << "\nyllcorner " << south
             << "\ncellsize " << spacing << "\n";
        for (int i = rows * columns - 1; i >= 0; --i) {
            const int row = i / columns, column = columns - 1 - i % columns;
            text << std::lround(hills(south + (row + 0.5) * spacing, west + (column + 0.5) * spacing)) << ' ';
        }
        _file = _folder.write("hills.asc", text.str());
    }

    [[nodiscard]] const std::string& file() const { return _file; }

    /// Its terrain, with levels 0 to `deepestLevel`.
    [[nodiscard]] Terrain terrain(int deepestLevel) const { return Terrain(_file, deepestLevel); }

private:
    test::TemporaryFolder _folder;
    std::string _file;
};

namespace {

TileId tileAt(int level, double latitudeDeg, double longitudeDeg) {
    const double size = std::ldexp(22.5, -level);
    return {level, static_cast<int>((longitudeDeg + 180.0) / size), static_cast<int>((latitudeDeg + 90.0) / size)};
}

TEST(Terrain, EveryLevelHoldsTheHeightsAndTheLevelBelow) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(5);
    test::Random random(1);
    double start = 0.0, deep = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const double latitudeDeg = random.uniform(-90.0, 90.0);
        const double longitudeDeg = random.uniform(-180.0, 180.0);
        const double height = terrain.height({latitudeDeg, longitudeDeg});
        for (int level = 0; level <= 5; ++level) {
            const core::Interval& range = terrain.heights(tileAt(level, latitudeDeg, longitudeDeg));
            EXPECT_GE(range.lower, 0.0) << "the sea's surface";
            EXPECT_TRUE(range.contains({height, height})) << latitudeDeg << ' ' << longitudeDeg;
            if (level == 5) continue;
            EXPECT_TRUE(range.contains(terrain.heights(tileAt(level + 1, latitudeDeg, longitudeDeg)))) << level;
        }
        start += terrain.heights(tileAt(0, latitudeDeg, longitudeDeg)).width();
        deep += terrain.heights(tileAt(5, latitudeDeg, longitudeDeg)).width();
    }
    EXPECT_GT(start / 5000.0, 2000.0) << "there were hills to hold";
    EXPECT_LT(deep, 0.5 * start);
}

class TileTreeTest : public testing::Test {
protected:
    template <class Function>
    void forTrees(const Function& function) {
        for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) {
            for (std::size_t number = 0; number < 2; ++number) {
                const Camera camera = randomCamera(_terrain, kind, number);
                function(TileTree(_terrain, camera), camera);
            }
        }
    }

    TestGlobe _globe;
    Terrain _terrain = _globe.terrain(5);
};

TEST_F(TileTreeTest, NoTileIsBothOutsideAndSeenAndAWitnessIsAPointOfTheTileInTheFrustum) {
    std::size_t outside = 0;
    std::size_t seen = 0;
    forTrees([&](const TileTree& tree, const Camera& camera) {
        for (const auto& tile : tree.tiles) {
            const auto found = findWitness(wgs84(), tile.box, camera);
            EXPECT_FALSE(tile.isOutside && found);
            outside += tile.isOutside ? 1U : 0U;
            seen += found ? 1U : 0U;
            if (!tile.witness) continue;
            EXPECT_TRUE(tile.box.contains(tile.witness->position));
            for (const core::Plane& plane : camera.planes())
                EXPECT_GE(plane.distance(wgs84().toEcef(tile.witness->position)), tile.witness->depth);
            EXPECT_GT(tile.witness->depth, 0.0);
        }
    });
    EXPECT_GT(outside, 1000U);
    EXPECT_GT(seen, 500U);
}

TEST_F(TileTreeTest, TerrainBehindTheGlobeIsNoWitness) {
    const Camera camera = cameraAt(wgs84(), {0.0, 0.0, 1e6}, 0.0, 90.0, 60.0);
    const core::GeodeticBin near = _terrain.bin({0, 8, 4});
    const core::GeodeticBin antipode = _terrain.bin({0, 0, 4});
    EXPECT_TRUE(findTerrainWitness(_terrain, near, camera));
    EXPECT_TRUE(findWitness(wgs84(), antipode, camera));
    EXPECT_FALSE(findTerrainWitness(_terrain, antipode, camera));
}

Results run(std::size_t cameras) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(4);
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
            EXPECT_GE(plane.distance(wgs84().toEcef(worst->witness.position)), worst->witness.depth);
        EXPECT_EQ(TileBins(wgs84(), worst->box).classify(method, Frustum(worst->camera)), core::Side::Outside);
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
    const Outcome outcome = run({_globe.file(), "--levels", "3", "--cameras", "2", "--csv", _csv});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(namesIn(_folder.path()), Words{"a.csv"});
    EXPECT_NE(outcome.text.find("all views"), std::string::npos) << outcome.text;
    const std::string csv = textOfFile(_csv);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 6);
    const std::string gtopo30 = SAMPLE_DATA "/dem/gtopo30_w020n90_cut_3E9E_50N54N.tif";
    if (!fs::exists(gtopo30)) GTEST_SKIP() << gtopo30 << " is absent";
    EXPECT_EQ(run({gtopo30, "--levels", "7", "--cameras", "2", "--csv", _csv}).code, 0);
    EXPECT_NE(textOfFile(_csv).find("quadratic"), std::string::npos);
}

TEST_F(Program, DrawsEveryFigure) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
    const std::string figures = _folder / "my figures";
    const Outcome outcome = run({_globe.file(), "--levels", "4", "--cameras", "20", "--plot", figures});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    Words expected;
    for (const char* const name :
         {"figure1", "figure2", "figure3", "figure4", "figure5", "wrong_cull_corners", "wrong_cull_paper"}) {
        for (const char* const ending : {".csv", ".gp", ".png", ".svg"}) expected.push_back(name + std::string(ending));
        const std::string png = textOfFile(figures + "/" + name + ".png");
        ASSERT_GT(png.size(), 10000U) << name;
        EXPECT_EQ(png.substr(1, 3), "PNG");
        EXPECT_EQ(png.substr(16, 4), std::string("\0\0\x03\xe8", 4)) << name;  // 1000 pixels wide
        EXPECT_NE(textOfFile(figures + "/" + name + ".svg").find("</svg>"), std::string::npos) << name;
    }
    EXPECT_EQ(namesIn(figures), expected);
}

TEST_F(Program, SaysWhatIsWrong) {
    test::expectOneLine(run({_folder / "absent.tif"}), "osgbinpaper", "absent.tif");
    test::expectOneLine(run({_folder.write("text.tif", "no raster")}), "osgbinpaper", "text.tif");
    const Words quick{PAPER_FILE, _globe.file(), "--levels", "1", "--cameras", "1"};
    const Outcome full = test::runStock("sh -c \"" + test::quoted(quick) + " >/dev/full\"", test::Modules::Absent);
    test::expectOneLine(full, "osgbinpaper", "standard output");
    const Outcome absent = run({_globe.file(), "--levels", "1", "--cameras", "1", "--csv", _folder / "absent/a.csv"});
    EXPECT_EQ(absent.code, 1);
    EXPECT_EQ(absent.linesWith("cannot write"), 1) << absent.text;
    EXPECT_EQ(namesIn(_folder.path()), Words{"text.tif"});
}

}  // namespace
}  // namespace osgAnalyticBin::paper
