// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles in the manner of FlightGear's, all of them loaded. Pictures of the same database: osgbinbench's
// SceneryTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/TileSurface.h>

#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osgDB/ReadFile>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <support/Random.h>
#include <support/SceneryDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

// By the order in which they are met: two scenes of the same files have the same numbers.
using Numbers = std::set<std::size_t>;

class Numbering : public osg::NodeVisitor {
public:
    Numbering() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Drawable& drawable) override { numbers.emplace(&drawable, numbers.size()); }

    std::map<const osg::Drawable*, std::size_t> numbers;
};

// What of `all` is not in `some`.
Numbers without(const Numbers& all, const Numbers& some) {
    Numbers left;
    std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::inserter(left, left.end()));
    return left;
}

bool holds(const Numbers& all, const Numbers& some) {
    return without(some, all).empty();
}

struct Scenery {
    Scenery() {
        root = osgDB::readRefNodeFile(writeSceneryDatabase(folder.path()));
        osg::Group& tiles = *root->asGroup();
        for (unsigned int i = 0; i < tiles.getNumChildren(); ++i) {
            auto& tile = dynamic_cast<osg::PagedLOD&>(*tiles.getChild(i));
            putBelow(tile, readBelow(tile));
        }
        root->accept(numbering);
    }

    [[nodiscard]] Numbers drawnIn(CullView view, osg::CullSettings::CullingMode mode) {
        view.cullingMode = mode;
        Numbers drawn;
        for (const osg::Drawable* const drawable : cull(*root, view, *visitor, ++frame).drawn)
            drawn.insert(numbering.numbers.at(drawable));
        return drawn;
    }

    TemporaryFolder folder;
    osg::ref_ptr<osg::Node> root;
    Numbering numbering;
    osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    unsigned int frame = 0;
};

CullView randomView(Random& random) {
    const double latitude = random.uniform(0.05, 0.7), longitude = random.uniform(0.1, 1.9);
    const osg::Vec3d eye = ecefDeg(latitude, longitude, random.logUniform(400.0, 30000.0));
    const double reach = random.logUniform(0.005, 0.3);
    const osg::Vec3d at =
        ecefDeg(latitude + reach * random.uniform(-1.0, 1.0), longitude + reach * random.uniform(-1.0, 1.0), 150.0);
    return CullView::lookAt(eye, at, eye, 60.0);
}

// OSG decides which features are small enough to be left out, with bins and without.
TEST(Scenery, LosesNoSmallFeaturesButThoseThatOsgDrops) {
    constexpr auto kSides = osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING;
    constexpr auto kSmall = osg::CullSettings::SMALL_FEATURE_CULLING;
    constexpr auto kBoth = static_cast<osg::CullSettings::CullingMode>(kSides | kSmall);
    Scenery stock, withBins;
    installBins(*withBins.root);
    Random random(1802);
    std::size_t dropped = 0;
    for (int i = 0; i < 40; ++i) {
        const CullView view = randomView(random);
        const Numbers all = stock.drawnIn(view, kSides), large = stock.drawnIn(view, kBoth);
        const Numbers allWithBins = withBins.drawnIn(view, kSides), largeWithBins = withBins.drawnIn(view, kBoth);
        const Numbers small = without(all, large), smallWithBins = without(allWithBins, largeWithBins);
        EXPECT_TRUE(holds(all, allWithBins)) << i;
        EXPECT_TRUE(holds(small, smallWithBins)) << i;
        dropped += smallWithBins.size();
    }
    EXPECT_GT(dropped, 20u) << "nothing is tested";
}

// A tile in ECEF, about which OSG has a larger sphere than the one about its bin.
osg::ref_ptr<osg::PagedLOD> tileInEcef() {
    const osg::ref_ptr<osg::MatrixTransform> frame = makeMeshTile(extentsDeg(35, 36, 45, 46), 0.0);
    const osg::ref_ptr<osg::Node> mesh = frame->getChild(0);
    auto& vertices = dynamic_cast<osg::Vec3Array&>(*drawableOf(*mesh)->asGeometry()->getVertexArray());
    for (osg::Vec3& vertex : vertices) vertex = osg::Vec3d(vertex) * frame->getMatrix();
    osg::ref_ptr<osg::PagedLOD> tile = makePaged(mesh, "no.osgb", 1.0f);
    setStoredBin(*tile, tileSurface(*mesh, osg::EllipsoidModel(), osg::Matrixd()).bin);
    return tile;
}

TEST(Scenery, LosesNoTileThatIsSmallerThanItsSphere) {
    for (const bool isFamily : {true, false}) {
        const osg::ref_ptr<osg::CoordinateSystemNode> stock = new osg::CoordinateSystemNode,
                                                      withBins = new osg::CoordinateSystemNode;
        for (const auto& root : {stock, withBins}) {
            root->setEllipsoidModel(new osg::EllipsoidModel);
            root->addChild(tileInEcef());
        }
        ASSERT_EQ(installBins(*withBins), 1u);
        if (!isFamily) withBins->addCullCallback(new osg::NodeCallback);
        const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
        std::size_t drawn = 0;
        for (double distance = 5e6; distance < 2e8; distance *= 1.01) {
            CullView view = CullView::lookAt(ecefDeg(35.5, 45.5, distance), ecefDeg(35.5, 45.5, 0), {0, 0, 1}, 60.0);
            view.cullingMode |= osg::CullSettings::SMALL_FEATURE_CULLING;
            const std::size_t all = cull(*stock, view, *visitor).drawn.size();
            EXPECT_GE(cull(*withBins, view, *visitor).drawn.size(), all) << distance << isFamily;
            drawn += all;
        }
        EXPECT_GT(drawn, 20u);
        EXPECT_LT(drawn, 350u);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
