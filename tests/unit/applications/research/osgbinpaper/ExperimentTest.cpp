// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What the experiment is for: sound methods are never wrong, the published rule and the corners are, and the counts fit
// together.

#include "Claims.h"
#include "Experiment.h"
#include "Output.h"
#include "TestGlobe.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::paper {
namespace {

constexpr int kLevels = 4;

class ExperimentTest : public testing::Test {
protected:
    static void SetUpTestSuite() { _results = new Results(run(1, 20)); }
    static void TearDownTestSuite() { delete _results; }

    static Results run(std::uint64_t seed, std::size_t cameras) {
        const TestGlobe globe;
        Terrain terrain = globe.terrain(kLevels);
        Progress silent(true);
        return runExperiment(terrain, {cameras, seed, 3.0, false}, silent);
    }

    static Counts counts(Method method) { return sumOf(_results->sum().methods[indexOf(method)]); }

    static Results* _results;
};

Results* ExperimentTest::_results = nullptr;

TEST_F(ExperimentTest, SoundMethodsAreNeverWrong) {
    for (const Method method : {Method::Sphere, Method::Box, Method::Quadratic, Method::Exact, Method::Hull}) {
        SCOPED_TRACE(kMethodNames[indexOf(method)]);
        EXPECT_EQ(counts(method).wrongCulls, 0U);
        EXPECT_EQ(counts(method).holes, 0U);
        EXPECT_EQ(counts(method).lostLeaves, 0U);
        EXPECT_EQ(counts(method).wrongInsides, 0U);
        EXPECT_FALSE(_results->worst[indexOf(method)]);
    }
}

TEST_F(ExperimentTest, CornersAndThePublishedRuleCullWhatIsSeen) {
    for (const Method method : {Method::Corners, Method::Paper}) {
        SCOPED_TRACE(kMethodNames[indexOf(method)]);
        EXPECT_GT(counts(method).wrongCulls, 0U);
        EXPECT_GT(counts(method).holes, 0U);
        EXPECT_GT(counts(method).lostLeaves, 0U);
        EXPECT_LE(counts(method).holes, counts(method).wrongCulls);
    }
}

TEST_F(ExperimentTest, TighterMethodsTestAndKeepFewer) {
    const std::array<Method, 4> fromTight{Method::Hull, Method::Exact, Method::Quadratic, Method::Sphere};
    EXPECT_GE(counts(Method::Hull).drawn, _results->sum().seen());
    EXPECT_GE(counts(Method::Box).drawn, counts(Method::Exact).drawn);
    for (std::size_t i = 1; i < fromTight.size(); ++i) {
        SCOPED_TRACE(kMethodNames[indexOf(fromTight[i])]);
        EXPECT_LE(counts(fromTight[i - 1]).tested, counts(fromTight[i]).tested);
        EXPECT_LE(counts(fromTight[i - 1]).kept, counts(fromTight[i]).kept);
        EXPECT_LE(counts(fromTight[i - 1]).drawn, counts(fromTight[i]).drawn);
    }
}

TEST_F(ExperimentTest, LeavesAreSeenLostOrDrawnInVain) {
    for (std::size_t method = 0; method < kMethods; ++method) {
        SCOPED_TRACE(kMethodNames[method]);
        const ViewResult sum = _results->sum();
        for (std::size_t level = 0; level <= kLevels; ++level) {
            const Counts& counts = sum.methods[method][level];
            EXPECT_LE(counts.drawn, sum.leaves[level]);
            EXPECT_LE(counts.drawn, counts.kept);
            EXPECT_LE(counts.lostLeaves, sum.seenLeaves[level]);
            // Some leaves are neither proven to be seen nor to be outside.
            EXPECT_GE(counts.drawn, sum.seenLeaves[level] - counts.lostLeaves + counts.wrongKeeps);
        }
        for (std::size_t level = kLevels + 1; level <= HeightPyramid::kDeepest; ++level)
            EXPECT_EQ(sum.methods[method][level].tested, 0U);
    }
}

TEST_F(ExperimentTest, NearlyEveryLeafIsProvenEitherWay) {
    const std::uint64_t seen = _results->sum().seen();
    EXPECT_LE(counts(Method::Hull).drawn - seen, seen / 200);
    EXPECT_EQ(counts(Method::Hull).wrongKeeps, 0U);
}

TEST_F(ExperimentTest, TheWorstCullIsAProof) {
    for (const Method method : {Method::Corners, Method::Paper}) {
        const auto& worst = _results->worst[indexOf(method)];
        ASSERT_TRUE(worst);
        EXPECT_TRUE(worst->isHole);
        EXPECT_TRUE(worst->box.contains(worst->witness));
        for (const core::Plane& plane : worst->camera.planes())
            EXPECT_GE(plane.distance(wgs84().toEcef(worst->witness)), worst->depth);
        const MethodBins bins = methodBins(wgs84(), {worst->box});
        core::Side side = core::Side::Inside;
        withBins(bins, method, [&](const auto& own) { side = classify(own.front(), Frustum(worst->camera)); });
        EXPECT_EQ(side, core::Side::Outside);
    }
}

TEST_F(ExperimentTest, TheSameSeedGivesTheSameCounts) {
    const std::string first = csvOf(run(1, 3), kLevels);
    EXPECT_EQ(csvOf(run(1, 3), kLevels), first);
    EXPECT_NE(csvOf(run(2, 3), kLevels), first);
}

TEST_F(ExperimentTest, FindingsNameBothClaims) {
    std::string text;
    for (const std::string& line : findings(*_results)) text += line + "\n";
    EXPECT_NE(text.find("Not by the published rule: corners " + std::to_string(counts(Method::Corners).wrongCulls)),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("With a proven remainder they do: quadratic 0"), std::string::npos) << text;
    EXPECT_NE(text.find("about 50 % fewer"), std::string::npos) << text;
}

}  // namespace
}  // namespace osgAnalyticBin::paper
