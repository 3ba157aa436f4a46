// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases that change how they are culled while they are shown. Oracle: the same database, read anew with the method.

#include "KitTest.h"
#include "PagedFlight.h"

#include <osg/Stats>

#include <cstdio>

namespace osgAnalyticBin::test {
namespace {

CullOptions by(Method method) {
    CullOptions options;
    options.method = method;
    return options;
}

std::set<const osg::Node*> inactiveNodes(osg::Node& scene) {
    std::set<const osg::Node*> nodes;
    visitNodes(scene, [&](osg::Node& node) {
        if (!node.getCullingActive()) nodes.insert(&node);
    });
    return nodes;
}

unsigned int valuesIn(osg::Node& scene) {
    unsigned int values = 0;
    visitNodes(scene, [&](osg::Node& node) {
        if (node.getUserDataContainer()) values += node.getUserDataContainer()->getNumUserObjects();
    });
    return values;
}

class SwitchedCulling : public ::testing::Test {
protected:
    void SetUp() override {
        _file = writeSyntheticDatabase(_folder.path());
        ASSERT_FALSE(_file.empty());
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> read(Method method) const {
        osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(_file);
        installBins(*scene, by(method));
        return scene;
    }

    [[nodiscard]] std::multiset<std::string> drawnAfresh(Method method, const CullView& view) const {
        const osg::ref_ptr<osg::Node> scene = read(method);
        PagedFlight flight(*scene);
        EXPECT_TRUE(flight.load(view));
        return flight.drawn();
    }

    TemporaryFolder _folder;
    std::string _file;
};

TEST_F(SwitchedCulling, DrawsWhatTheMethodDrawsAfreshAlsoWhatIsPagedInLater) {
    const osg::ref_ptr<osg::Node> scene = read(Method::Quadratic);
    PagedFlight flight(*scene);
    ASSERT_TRUE(flight.load(lookDown(+1)));
    double side = -1.0;
    for (const Method method : {Method::Sphere, Method::None, Method::Exact, Method::Sphere, Method::Quadratic}) {
        setCullOptions(*scene, by(method));
        ASSERT_TRUE(flight.load(lookDown(-side)));
        EXPECT_EQ(flight.drawn(), drawnAfresh(method, lookDown(-side)))
            << methodName(method) << ", tiles loaded before";
        ASSERT_TRUE(flight.load(lookDown(side)));
        EXPECT_EQ(flight.drawn(), drawnAfresh(method, lookDown(side))) << methodName(method) << ", tiles loaded later";
        side = -side;
    }
}

/// Bins that take turns with stock OSG.
class ComparedCulling : public SwitchedCulling {
protected:
    static constexpr double kTurn = 2.0;  // seconds

    void SetUp() override {
        SwitchedCulling::SetUp();
        setenv("OSGANALYTICBIN_COMPARE", "2", 1);
        _scene = read(Method::Quadratic);
        unsetenv("OSGANALYTICBIN_COMPARE");
    }

    osg::ref_ptr<osg::Node> _scene;
};

TEST_F(ComparedCulling, DrawsInEachTurnWhatItsMethodDraws) {
    const auto bins = drawnAfresh(Method::Quadratic, lookDown(1)), spheres = drawnAfresh(Method::Sphere, lookDown(1));
    const CapturedNotes notices(osg::NOTICE);
    PagedFlight flight(*_scene);
    for (const bool isStock : {false, true, false, true}) {
        EXPECT_TRUE(flight.framesUntil(lookDown(1), [&] {
            const bool isItsTurn = (static_cast<int>(flight.time() / kTurn) % 2 == 1) == isStock;
            return isItsTurn && flight.drawn() == (isStock ? spheres : bins);
        })) << isStock;
    }
    int binTiles = 0, stockTiles = 0;
    double binMs = 0.0, stockMs = 0.0;
    ASSERT_EQ(
        std::sscanf(notices.text().c_str(),
                    "osgAnalyticBin: a view with bins %d tiles, cull %lf ms; with stock OSG %d tiles, cull %lf ms\n",
                    &binTiles, &binMs, &stockTiles, &stockMs),
        4)
        << notices.text();
    EXPECT_GT(binTiles, 0);
    EXPECT_LT(binTiles, stockTiles);
    EXPECT_GT(binMs, 0.0);
    EXPECT_GT(stockMs, 0.0);
}

TEST_F(ComparedCulling, IsInTheStatisticsOfEachCamera) {
    CullView view = lookDown(1);
    view.camera = new osg::Camera;
    view.camera->setStats(new osg::Stats("camera"));
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    const std::size_t bins = cull(*_scene, view, *visitor, 1, 0.5 * kTurn).drawn.size();
    const std::size_t stock = cull(*_scene, view, *visitor, 2, 1.5 * kTurn).drawn.size();
    EXPECT_LT(bins, stock);
    const auto valueOf = [&](unsigned int frame, const std::string& name) {
        double value = -1.0;
        (void)view.camera->getStats()->getAttribute(frame, name, value);
        return value;
    };
    EXPECT_EQ(valueOf(1, "Bins tiles drawn"), static_cast<double>(bins));
    EXPECT_GT(valueOf(1, "Bins database cull ms"), 0.0);
    EXPECT_EQ(valueOf(2, "Stock OSG tiles drawn"), static_cast<double>(stock));
    EXPECT_GT(valueOf(2, "Stock OSG database cull ms"), 0.0);
    EXPECT_EQ(valueOf(2, "Bins tiles drawn"), -1.0) << "of the other turn";
}

TEST_F(SwitchedCulling, IsNotComparedByAMalformedVariable) {
    const CapturedNotes notices;
    for (const char* const text : {"soon", "-1", "nan", ""}) {
        setenv("OSGANALYTICBIN_COMPARE", text, 1);
        const osg::ref_ptr<osg::Node> scene = read(Method::Quadratic);
        PagedFlight flight(*scene);
        unsetenv("OSGANALYTICBIN_COMPARE");
        const auto bins = drawnAfresh(Method::Quadratic, lookDown(1));
        EXPECT_TRUE(flight.framesUntil(lookDown(1), [&] { return flight.time() > 1.0 && flight.drawn() == bins; }))
            << text;
    }
    EXPECT_EQ(notices.count("a view with bins"), 0u);
    EXPECT_EQ(notices.count("not a number of seconds"), 1u);
}

TEST_F(SwitchedCulling, LeavesFlagsAndValuesAsTheApplicationSetThem) {
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(_file);
    osg::Node& own = *scene->asGroup()->getChild(3)->asGroup()->getChild(0);
    own.setCullingActive(false);  // by the database itself
    const unsigned int values = valuesIn(*scene);
    installBins(*scene, by(Method::None));
    for (const Method method : {Method::None, Method::Quadratic, Method::None, Method::Sphere}) {
        EXPECT_EQ(inactiveNodes(*scene), std::set<const osg::Node*>{&own});
        setCullOptions(*scene, by(method));
    }
    EXPECT_EQ(inactiveNodes(*scene), std::set<const osg::Node*>{&own});
    EXPECT_EQ(valuesIn(*scene), values);
    removeBins(*scene);
    EXPECT_EQ(scene->getCullCallback(), nullptr);
}

}  // namespace
}  // namespace osgAnalyticBin::test
