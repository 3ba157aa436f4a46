// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What the experiment is for: sound methods are never wrong, the published rule and the corners are, and the counts fit
// together.

#include "Experiment.h"
#include "TestGlobe.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::paper {
namespace {

constexpr int kLevels = 4;

class ExperimentTest : public testing::Test {
protected:
    static void SetUpTestSuite() { _results = new Results(run(20)); }
    static void TearDownTestSuite() { delete _results; }

    static Results run(std::size_t cameras) {
        const TestGlobe globe;
        Terrain terrain = globe.terrain(kLevels);
        return runExperiment(terrain, cameras);
    }

    static Counts counts(Method method) { return _results->sum().methods[indexOf(method)]; }

    static Results* _results;
};

Results* ExperimentTest::_results = nullptr;

TEST_F(ExperimentTest, SoundMethodsAreNeverWrong) {
    for (const Method method : {Method::Box, Method::Quadratic, Method::Exact, Method::Hull}) {
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

TEST_F(ExperimentTest, TighterMethodsTestAndDrawFewer) {
    const std::array<Method, 4> fromTight{Method::Hull, Method::Exact, Method::Quadratic, Method::Box};
    EXPECT_GE(counts(Method::Hull).drawn, _results->sum().seenLeaves);
    for (std::size_t i = 1; i < fromTight.size(); ++i) {
        SCOPED_TRACE(kMethodNames[indexOf(fromTight[i])]);
        EXPECT_LE(counts(fromTight[i - 1]).tested, counts(fromTight[i]).tested);
        EXPECT_LE(counts(fromTight[i - 1]).drawn, counts(fromTight[i]).drawn);
    }
}

TEST_F(ExperimentTest, LeavesAreSeenLostOrDrawnInVain) {
    for (const ViewResult& view : _results->views) {
        EXPECT_EQ(view.cameras, 20U);
        for (const Counts& counts : view.methods) {
            EXPECT_LE(counts.lostLeaves, view.seenLeaves);
            // Some leaves are neither proven to be seen nor to be outside.
            EXPECT_GE(counts.drawn, view.seenLeaves - counts.lostLeaves + counts.wrongKeeps);
        }
    }
}

TEST_F(ExperimentTest, NearlyEveryLeafIsProvenEitherWay) {
    const std::uint64_t seen = _results->sum().seenLeaves;
    EXPECT_LE(counts(Method::Hull).drawn - seen, seen / 200);
    EXPECT_EQ(counts(Method::Hull).wrongKeeps, 0U);
}

TEST_F(ExperimentTest, TheWorstCullIsAProof) {
    for (const Method method : {Method::Corners, Method::Paper}) {
        const auto& worst = _results->worst[indexOf(method)];
        ASSERT_TRUE(worst);
        EXPECT_TRUE(worst->isHole);
        EXPECT_TRUE(worst->box.contains(worst->witness.position));
        for (const core::Plane& plane : worst->camera.planes())
            EXPECT_GE(plane.distance(wgs84().toEcef(worst->witness.position)), worst->witness.depth);
        EXPECT_EQ(TileBins(wgs84(), worst->box).classify(method, Frustum(worst->camera)), core::Side::Outside);
    }
}

TEST_F(ExperimentTest, EveryRunGivesTheSameCounts) {
    EXPECT_EQ(csvOf(run(3)), csvOf(run(3)));
}

}  // namespace
}  // namespace osgAnalyticBin::paper
