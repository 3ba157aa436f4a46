// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases that are culled by the rules of the paper and of other programs. Oracles: the rule's own verdict on each
// tile's bin, and what the kit draws of the same database. The rules themselves:
// RivalBinsTest.cpp.

#include "PagedFlight.h"
#include "Rivals.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>

#include <algorithm>
#include <support/CapturedNotes.h>
#include <support/Random.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>
#include <support/VisitNodes.h>

namespace osgAnalyticBin {
namespace {

using core::Side;
using rivals::RivalCullCallback;
using rivals::RivalOptions;
using rivals::Rule;
using test::CullView;

RivalOptions by(Rule rule) {
    RivalOptions options;
    options.rule = rule;
    return options;
}

constexpr Rule kRules[] = {Rule::Paper, Rule::Corners, Rule::Box, Rule::OrientedBox};

CullView randomView(test::Random& random) {
    const glm::dvec3 eye = random.logUniform(6.4e6, 3e7) * random.direction();
    const glm::dvec3 target = 6.378137e6 * random.direction();
    return CullView::lookAt({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, {0.1, 0.2, 0.9},
                            random.uniform(5.0, 90.0));
}

Side verdictOf(Rule rule, const AnalyticBin& bin, const core::Plane& plane) {
    const core::Ellipsoid ellipsoid(osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR);
    const core::GeodeticMapping mapping(ellipsoid);
    switch (rule) {
        case Rule::Paper:
            return rivals::PaperBin(mapping, core::parameterBox(bin.bin())).classify(plane);
        case Rule::Corners:
            return rivals::CornersBin(mapping, core::parameterBox(bin.bin())).classify(plane);
        case Rule::Box:
            return rivals::BoxBin(ellipsoid, bin.bin(), bin.margin()).classify(plane);
        case Rule::OrientedBox:
            break;
    }
    return rivals::OrientedBoxBin(ellipsoid, bin.bin(), bin.margin()).classify(plane);
}

// The start tiles, culled by a rule.
struct Globe {
    explicit Globe(const RivalOptions& options) {
        for (std::size_t i = 0; i < bins.size(); ++i)
            root->addChild(test::makeTile(std::to_string(i), bins[i], visited));
        EXPECT_EQ(rivals::installRivals(*root, options), bins.size());
    }

    const std::set<std::string>& visitedIn(const CullView& view) {
        visited.clear();
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        test::cull(*root, view, *visitor);
        EXPECT_EQ(BinStatistics::of(*visitor).getCounts().tested, bins.size());
        return visited;
    }

    const std::vector<AnalyticBin> bins = test::startTiles();
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    std::set<std::string> visited;
};

TEST(RivalCullCallback, CullsWhatTheRuleHasOutsideOfAPlaneAndTestsEdgesWhereTold) {
    for (const Rule rule : kRules) {
        RivalOptions options = by(rule);
        Globe plain(options);
        options.testsEdges = true;
        Globe withEdges(options);
        test::Random random(20261126);
        std::size_t fewer = 0;
        for (int view = 0; view < 100; ++view) {
            const CullView look = randomView(random);
            const std::vector<osg::Plane> planes = look.sidePlanes();
            const auto& visited = plain.visitedIn(look);
            for (std::size_t i = 0; i < plain.bins.size(); ++i) {
                const bool isOutside = std::any_of(planes.begin(), planes.end(), [&](const osg::Plane& p) {
                    return verdictOf(rule, plain.bins[i], {{p[0], p[1], p[2]}, p[3]}) == Side::Outside;
                });
                EXPECT_EQ(visited.count(std::to_string(i)), isOutside ? 0u : 1u) << "view " << view << ", tile " << i;
            }
            const auto& byEdges = withEdges.visitedIn(look);
            EXPECT_TRUE(std::includes(visited.begin(), visited.end(), byEdges.begin(), byEdges.end()));
            fewer += visited.size() - byEdges.size();
        }
        EXPECT_GT(fewer, 0u);
    }
}

// That it draws what the rules keep: osgbinbench.Program.JudgesEveryMethodByTheReference.
TEST(RivalPlugin, CullsAlsoWhatIsPagedIn) {
    const test::TemporaryFolder folder;
    const std::string file = test::writeSyntheticDatabase(folder.path());
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(file + ".(method=corners).binrival");
    ASSERT_TRUE(scene);
    test::PagedFlight flight(*scene);
    ASSERT_TRUE(flight.load(test::lookDown(1.0)));
    std::size_t tiles = 0, byRule = 0;
    test::visitNodes(*scene, [&](osg::Node& node) {
        if (!dynamic_cast<osg::PagedLOD*>(&node)) return;
        ++tiles;
        byRule += dynamic_cast<RivalCullCallback*>(node.getCullCallback()) ? 1U : 0U;
    });
    EXPECT_EQ(byRule, tiles);
    EXPECT_GT(tiles, 40U) << "32 are in the root file";
}

TEST(RivalPlugin, RefusesWhatItDoesNotKnow) {
    const test::CapturedNotes notes;
    const test::TemporaryFolder folder;
    const std::string file = test::writeSyntheticDatabase(folder.path());
    EXPECT_TRUE(osgDB::readRefNodeFile(file + ".(method=box,horizon=-20000).binrival"));
    for (const char* suffix : {".(method=exact).binrival", ".(growth=0).binrival", ".(speed=9).binrival"})
        EXPECT_FALSE(osgDB::readRefNodeFile(file + suffix)) << suffix;
    EXPECT_FALSE(osgDB::readRefNodeFile(folder / "absent.osgb.(method=box).binrival"));
}

}  // namespace
}  // namespace osgAnalyticBin
