// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases that are culled by the rules of the paper and of other programs. Oracles: the rule's own verdict on each
// tile's bin, and what the kit draws of the same database. The rules themselves: ComparisonBinsTest.cpp,
// BoxBinsTest.cpp.

#include "InstallRivals.h"
#include "PagedFlight.h"
#include "RivalCullCallback.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <gtest/gtest.h>
#include <osgDB/ReadFile>

#include <algorithm>
#include <support/CapturedNotes.h>
#include <support/Random.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>
#include <support/View.h>
#include <support/VisitNodes.h>

namespace osgAnalyticBin {
namespace {

using core::Side;
using rivals::RivalCullCallback;
using rivals::RivalOptions;
using rivals::Rule;
using test::CullView;
using test::lookDown;
using test::PagedFlight;

RivalOptions by(Rule rule) {
    RivalOptions options;
    options.rule = rule;
    return options;
}

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

TEST(RivalCullCallback, CullsWhatTheRuleHasOutsideOfAPlane) {
    const std::vector<AnalyticBin> bins = test::startTiles();
    for (const Rule rule : {Rule::Paper, Rule::Corners, Rule::Box, Rule::OrientedBox}) {
        std::set<std::string> visited;
        const osg::ref_ptr<osg::Group> root = new osg::Group;
        for (std::size_t i = 0; i < bins.size(); ++i)
            root->addChild(test::makeTile(std::to_string(i), bins[i], visited));
        ASSERT_EQ(rivals::installRivals(*root, by(rule)), bins.size());
        test::Random random(20261126);
        for (int view = 0; view < 40; ++view) {
            const CullView look = randomView(random);
            visited.clear();
            const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
            test::cull(*root, look, *visitor);
            for (std::size_t i = 0; i < bins.size(); ++i) {
                const std::vector<osg::Plane> planes = look.sidePlanes();
                const bool isOutside = std::any_of(planes.begin(), planes.end(), [&](const osg::Plane& p) {
                    return verdictOf(rule, bins[i], {{p[0], p[1], p[2]}, p[3]}) == Side::Outside;
                });
                EXPECT_EQ(visited.count(std::to_string(i)), isOutside ? 0u : 1u) << "view " << view << ", tile " << i;
            }
            EXPECT_EQ(BinStatistics::of(*visitor).getCounts().tested, bins.size());
        }
    }
}

TEST(RivalCullCallback, TestsEdgesWhereTold) {
    for (const Rule rule : {Rule::Paper, Rule::Corners, Rule::Box, Rule::OrientedBox}) {
        std::set<std::string> visited, visitedByEdges;
        const osg::ref_ptr<osg::Group> plain = new osg::Group;
        const osg::ref_ptr<osg::Group> withEdges = new osg::Group;
        for (const AnalyticBin& bin : test::startTiles()) {
            const std::string name = bin.toText();
            plain->addChild(test::makeTile(name, bin, visited));
            withEdges->addChild(test::makeTile(name, bin, visitedByEdges));
        }
        RivalOptions options = by(rule);
        rivals::installRivals(*plain, options);
        options.testsEdges = true;
        rivals::installRivals(*withEdges, options);
        test::Random random(33);
        std::size_t fewer = 0;
        for (int view = 0; view < 200; ++view) {
            const CullView look = randomView(random);
            visited.clear();
            visitedByEdges.clear();
            test::cull(*plain, look, *osg::ref_ptr(new osgUtil::CullVisitor));
            test::cull(*withEdges, look, *osg::ref_ptr(new osgUtil::CullVisitor));
            EXPECT_TRUE(std::includes(visited.begin(), visited.end(), visitedByEdges.begin(), visitedByEdges.end()));
            fewer += visited.size() - visitedByEdges.size();
        }
        EXPECT_GT(fewer, 0u);
    }
}

class RivalPlugin : public ::testing::Test {
protected:
    void SetUp() override {
        _file = test::writeSyntheticDatabase(_folder.path());
        ASSERT_FALSE(_file.empty());
    }

    [[nodiscard]] std::multiset<std::string> drawnAs(const std::string& suffix, double side = 1.0) const {
        const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(_file + suffix);
        EXPECT_TRUE(scene) << suffix;
        PagedFlight flight(*scene);
        EXPECT_TRUE(flight.load(lookDown(side)));
        return flight.drawn();
    }

    test::TemporaryFolder _folder;
    std::string _file;
};

TEST_F(RivalPlugin, CullsAlsoWhatIsPagedInLater) {
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(_file + ".(method=corners).binrival");
    ASSERT_TRUE(scene);
    PagedFlight flight(*scene);
    std::size_t before = 0;
    for (const double side : {1.0, -1.0}) {
        ASSERT_TRUE(flight.load(lookDown(side)));
        std::size_t tiles = 0;
        std::size_t byRule = 0;
        test::visitNodes(*scene, [&](osg::Node& node) {
            osg::Callback* const first = node.getCullCallback();
            for (osg::Callback* at = first; at; at = at->getNestedCallback()) {
                if (!dynamic_cast<AnalyticBinCullCallback*>(at)) continue;
                ++tiles;
                byRule += dynamic_cast<RivalCullCallback*>(first) ? 1 : 0;
            }
        });
        EXPECT_EQ(byRule, tiles);
        EXPECT_GT(tiles, before + 8) << "nothing was paged in";
        before = tiles;
    }
}

TEST_F(RivalPlugin, DrawsWhatTheRuleKeeps) {
    const auto none = drawnAs(".(method=none).analyticbin");
    const auto bins = drawnAs(".(method=exact,horizon=off,edges=off).analyticbin");
    const auto boxes = drawnAs(".(method=box).binrival");
    const auto tight = drawnAs(".(method=orientedbox).binrival");
    const auto holds = [](const auto& more, const auto& fewer) {
        return std::includes(more.begin(), more.end(), fewer.begin(), fewer.end());
    };
    EXPECT_TRUE(holds(none, boxes) && holds(boxes, bins) && holds(tight, bins)) << "boxes are sound";
    EXPECT_LT(tight.size(), none.size());
    const auto withHorizon = drawnAs(".(method=box,horizon=-20000).binrival");
    EXPECT_TRUE(holds(boxes, withHorizon) && holds(withHorizon, drawnAs(".(horizon=-20000).analyticbin")));
    EXPECT_LE(drawnAs(".(method=paper).binrival").size(), none.size());
}

TEST_F(RivalPlugin, RefusesWhatItDoesNotKnow) {
    const test::CapturedNotes notes;
    for (const char* suffix : {".(method=exact).binrival", ".(growth=0).binrival", ".(speed=9).binrival"})
        EXPECT_FALSE(osgDB::readRefNodeFile(_file + suffix)) << suffix;
    EXPECT_FALSE(osgDB::readRefNodeFile(_folder / "absent.osgb.(method=box).binrival"));
}

}  // namespace
}  // namespace osgAnalyticBin
