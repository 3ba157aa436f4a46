// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// An application's cull callback on the CoordinateSystemNode that the database's own one stands on: it runs wherever it
// stands in the chain, once a traversal, and what it does not traverse is not drawn. Callbacks on tiles are tested in
// BinInstallerTest.cpp and ForeignDatabaseTest.cpp.

#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osgUtil/UpdateVisitor>

namespace osgAnalyticBin::test {
namespace {

// Counts, and goes on only where it is told to.
class PruningCallback : public osg::NodeCallback {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        ++runs;
        if (isOpen) traverse(node, nv);
    }
    int runs = 0;
    bool isOpen = true;
};

enum class Place { BehindBeforeInstalling, BehindAfterInstalling, InFront };

class NestedDatabaseCallback : public ::testing::TestWithParam<Place> {
protected:
    void SetUp() override {
        _root->setEllipsoidModel(new osg::EllipsoidModel);
        for (const double west : {-10.0, 0.0, 90.0}) {
            const osg::ref_ptr<osg::Group> tile = new osg::Group;
            const core::GeodeticBin extents = extentsDeg(-5, 5, west, west + 10);
            tile->addChild(makeMeshTile(extents, 200.0));
            setStoredBin(*tile, AnalyticBin(extents.withAltitude({-1000.0, 300.0}), 1.0));
            _tiles.watch(*tile, std::to_string(static_cast<int>(west)));
            _root->addChild(tile);
        }
        if (GetParam() == Place::BehindBeforeInstalling) _root->setCullCallback(_gate);
        ASSERT_EQ(installBins(*_root), 3U);
        if (GetParam() == Place::BehindAfterInstalling) _root->addCullCallback(_gate);
        if (GetParam() == Place::InFront) {
            _gate->setNestedCallback(_root->getCullCallback());
            _root->setCullCallback(_gate);
        }
    }

    // From above the meridian of Greenwich: two tiles are in view, the third is not.
    [[nodiscard]] std::set<std::string> reached() {
        return _tiles.in(*_root, ecefDeg(0, 0, 3e6), ecefDeg(0, 0, 0), 60.0);
    }

    void expectTheGateToDecide() {
        _gate->isOpen = true;
        _gate->runs = 0;
        EXPECT_EQ(reached(), (std::set<std::string>{"-10", "0"}));
        EXPECT_EQ(_gate->runs, 1);
        _gate->isOpen = false;
        EXPECT_EQ(reached(), std::set<std::string>());
        EXPECT_EQ(_gate->runs, 2);
    }

    const osg::ref_ptr<osg::CoordinateSystemNode> _root = new osg::CoordinateSystemNode;
    const osg::ref_ptr<PruningCallback> _gate = new PruningCallback;
    ReachedTiles _tiles;
};

TEST_P(NestedDatabaseCallback, RunsOnceAndMayPruneAlsoAfterUpdatesAndFurtherInstallations) {
    expectTheGateToDecide();
    const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
    _root->accept(*visitor);
    expectTheGateToDecide();
    for (const Method method : {Method::Exact, Method::Quadratic}) {
        CullOptions options;
        options.method = method;
        ASSERT_EQ(installBins(*_root, options), 3U);
        _root->accept(*visitor);
        expectTheGateToDecide();
    }
}

std::string placeName(const ::testing::TestParamInfo<Place>& suite) {
    const char* const names[] = {"BehindBeforeInstalling", "BehindAfterInstalling", "InFront"};
    return names[static_cast<int>(suite.param)];
}

INSTANTIATE_TEST_SUITE_P(Places, NestedDatabaseCallback,
                         ::testing::Values(Place::BehindBeforeInstalling, Place::BehindAfterInstalling, Place::InFront),
                         placeName);

}  // namespace
}  // namespace osgAnalyticBin::test
