// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What the experiment is for: sound methods are never wrong, the published rule and the corners are, and the counts fit
// together.

#include "Experiment.h"
#include "TestGlobe.h"

#include <gtest/gtest.h>

#include <memory>

namespace osgAnalyticBin::paper {
namespace {

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

TEST_F(Experiment, LeavesAreSeenLostOrDrawnInVain) {
    for (const ViewResult& view : _results->views) {
        EXPECT_EQ(view.cameras, 20U);
        for (const Counts& counts : view.methods) {
            EXPECT_LE(counts.lostLeaves, view.seenLeaves);
            // Some leaves are neither proven to be seen nor to be outside.
            EXPECT_GE(counts.drawn, view.seenLeaves - counts.lostLeaves + counts.wrongKeeps);
        }
    }
}

TEST_F(Experiment, EveryRunGivesTheSameCounts) {
    EXPECT_EQ(csvOf(run(3)), csvOf(run(3)));
}

}  // namespace
}  // namespace osgAnalyticBin::paper
