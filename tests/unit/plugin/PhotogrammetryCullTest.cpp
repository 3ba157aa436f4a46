// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is culled of photogrammetry sets, through OSG's own pager. The oracle: the same set without culling, of which
// every drawable with a vertex in the field of view has to be drawn.

#include "PhotogrammetryFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/Geometry>
#include <osg/PagedLOD>

#include <PagedFlight.h>
#include <algorithm>
#include <set>
#include <sstream>
#include <support/GridMesh.h>
#include <support/Random.h>
#include <support/VisitNodes.h>

namespace osgAnalyticBin {
namespace {

using test::CullView;
using test::PagedFlight;

// A drawable by what it is in the frame of the tiles.
std::string keyOf(const osg::Drawable& drawable) {
    const osg::BoundingBox box = drawable.getBoundingBox();
    std::ostringstream key;
    key << box.xMin() << ' ' << box.yMin() << ' ' << box.zMin() << ' ' << box.xMax() << ' ' << box.yMax() << ' '
        << box.zMax() << ' ' << drawable.asGeometry()->getVertexArray()->getNumElements();
    return key.str();
}

bool hasVertexInside(const osg::Drawable& drawable, const osg::Matrixd& toEye, const CullView& view) {
    const auto& vertices = dynamic_cast<const osg::Vec3Array&>(*drawable.asGeometry()->getVertexArray());
    osg::Polytope frustum;
    frustum.setToUnitFrustum(false, false);
    frustum.transformProvidingInverse(toEye * view.projection);
    const auto& planes = frustum.getPlaneList();
    return std::any_of(vertices.begin(), vertices.end(), [&](const osg::Vec3& vertex) {
        return std::all_of(planes.begin(), planes.end(),
                           [&](const osg::Plane& plane) { return plane.distance(osg::Vec3d(vertex)) > 0.0; });
    });
}

class FalseSpheres : public test::PhotogrammetryFixture {
protected:
    // A set that is flown over.
    struct Flown {
        explicit Flown(const osg::ref_ptr<osg::Node>& read) : scene(read), flight(*scene, 100000) {}

        // Returns: the drawables of the view when all that it asks for is there.
        std::set<const osg::Drawable*> drawn(const CullView& view) {
            EXPECT_TRUE(flight.load(view));
            flight.frame(view);
            return test::cull(*scene, view).drawn;
        }
        std::set<std::string> keys(const CullView& view) {
            std::set<std::string> keys;
            for (const osg::Drawable* drawable : drawn(view)) keys.insert(keyOf(*drawable));
            return keys;
        }

        osg::ref_ptr<osg::Node> scene;
        PagedFlight flight;
    };

    // Low and high, over the set and beside it, wide and narrow.
    static std::vector<CullView> views(int count) {
        const osg::EllipsoidModel earth;
        osg::Matrixd toEcef;
        earth.computeLocalToWorldTransformFromLatLongHeight(osg::DegreesToRadians(47.5), osg::DegreesToRadians(11.2),
                                                            0.0, toEcef);
        test::Random random(101);
        std::vector<CullView> views;
        for (int i = 0; i < count; ++i) {
            const osg::Vec3d eye(random.uniform(-400, 400), random.uniform(-400, 400), random.logUniform(40, 600));
            const osg::Vec3d look(random.uniform(-300, 300), random.uniform(-300, 300), random.uniform(0, 100));
            views.push_back(CullView::lookAt(eye * toEcef, look * toEcef,
                                             osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), toEcef),
                                             random.chance(0.5) ? 20.0 : 60.0));
        }
        return views;
    }

    // What has a vertex in view and is not among the drawn.
    static std::vector<std::string> lost(Flown& all, const CullView& view, const std::set<std::string>& drawn) {
        CullView everything = view;
        everything.cullingMode = osg::CullSettings::NO_CULLING;
        std::vector<std::string> lost;
        const osg::Matrixd toEye = setIn(*all.scene)->getMatrix() * view.modelView;
        for (const osg::Drawable* drawable : all.drawn(everything))
            if (hasVertexInside(*drawable, toEye, view) && drawn.count(keyOf(*drawable)) == 0)
                lost.push_back(keyOf(*drawable));
        return lost;
    }

    std::size_t lostBy(const std::string& options) {
        Flown all(read("method=none")), culled(read(options));
        std::size_t count = 0;
        for (const CullView& view : views(25)) count += lost(all, view, culled.keys(view)).size();
        return count;
    }
};

// OSG's spheres do, or this would say little.
TEST_F(FalseSpheres, LoseNothingThatIsInView) {
    EXPECT_EQ(lostBy(""), 0U);
    EXPECT_GT(lostBy("method=sphere"), 0U);
}

// By what is loaded of them: otherwise their files would be asked for from everywhere.
TEST_F(FalseSpheres, AreCulledBehindTheEye) {
    Flown set(read());
    const std::size_t files = test::loadedTiles(*set.scene);
    const osg::Vec3d middle = setIn(*set.scene)->getMatrix().getTrans();
    const osg::Vec3d eye = middle + middle / middle.length() * 400.0;
    EXPECT_TRUE(set.drawn(CullView::lookAt(eye, eye + middle, osg::Vec3d(0, 0, 1), 60.0)).empty());
    EXPECT_EQ(test::loadedTiles(*set.scene), files);
}

TEST_F(FalseSpheres, AreAllThatIsCulledOtherwiseThanByOsg) {
    test::PhotogrammetrySample sample;
    sample.hasFalseSpheres = false;
    sample.towersFrom = 0;  // so that the spheres hold what is below
    write(sample);
    for (const CullView& view : views(12)) {
        Flown spheres(read("method=sphere")), set(read());
        EXPECT_EQ(set.keys(view), spheres.keys(view));
        EXPECT_EQ(test::loadedTiles(*set.scene), test::loadedTiles(*spheres.scene));
    }
}

// Callbacks, culling flags, options and expiry of all nodes, as text.
std::string flagsOf(osg::Node& scene) {
    std::ostringstream text;
    test::visitNodes(scene, [&](osg::Node& node) {
        text << node.className() << bool(node.getCullCallback()) << bool(node.getUpdateCallback())
             << node.getCullingActive();
        if (auto* const paged = dynamic_cast<osg::PagedLOD*>(&node)) {
            text << bool(paged->getDatabaseOptions());
            for (unsigned int i = 0; i < paged->getNumMinimumExpiryTimes(); ++i) text << paged->getMinimumExpiryTime(i);
        }
        text << '\n';
    });
    return text.str();
}

TEST_F(FalseSpheres, AreAsBeforeWhenBinsAreTakenOff) {
    const osg::ref_ptr<osg::Node> scene = read("method=sphere");
    removeBins(*scene);
    const std::string before = flagsOf(*scene);
    EXPECT_GT(installBins(*scene, {}), 0U);
    EXPECT_NE(flagsOf(*scene), before);
    removeBins(*scene);
    EXPECT_EQ(flagsOf(*scene), before);
}

TEST_F(FalseSpheres, FollowOtherOptions) {
    Flown set(read());
    const CullView view = views(1).front();
    const std::size_t culled = set.keys(view).size();
    EXPECT_EQ(setCullOptions(*set.scene, test::by(Method::None)), 0U);
    EXPECT_GT(set.keys(view).size(), culled);
    setCullOptions(*set.scene, {});
    EXPECT_EQ(set.keys(view).size(), culled);
}

// A mast that stands out of the tile's sphere, below a view that looks over the sphere.
TEST_F(FalseSpheres, ShowWhatAnApplicationAddsBelowATile) {
    Flown flown(read());
    osg::MatrixTransform& set = *setIn(*flown.scene);
    auto& tile = dynamic_cast<osg::PagedLOD&>(*set.getChild(0));
    const osg::Vec3d top(tile.getCenter() + osg::Vec3(0, 0, 1.3F * tile.getRadius()));
    const osg::Vec3d eye(top - osg::Vec3d(3000, 0, 0));
    const osg::Vec3d up = osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), set.getMatrix());
    const CullView view =
        CullView::lookAt(eye * set.getMatrix(), (top + osg::Vec3d(0, 0, 510)) * set.getMatrix(), up, 20.0);
    ASSERT_TRUE(flown.drawn(view).empty());
    const osg::Vec3 ends[] = {osg::Vec3(top) - osg::Vec3(0, 0, 9), osg::Vec3(top)};
    const osg::ref_ptr<osg::Geometry> mast =
        test::makeGeometry(new osg::Vec3Array(2, ends), new osg::DrawArrays(GL_LINES, 0, 2));
    ASSERT_TRUE(tile.getChild(0)->asGroup()->addChild(mast));
    for (int i = 0; i < 2; ++i) EXPECT_EQ(flown.drawn(view).count(mast), 1U);
}

TEST_F(FalseSpheres, LoseNothingInClones) {
    Flown all(read("method=none"));
    const osg::ref_ptr<osg::Node> original = read();
    for (const unsigned int callbacks : {0U, unsigned(osg::CopyOp::DEEP_COPY_CALLBACKS)}) {
        const unsigned int flags = unsigned(osg::CopyOp::DEEP_COPY_NODES) | callbacks;
        Flown clone(osg::clone(original.get(), osg::CopyOp(flags)));
        for (const CullView& view : views(6)) EXPECT_TRUE(lost(all, view, clone.keys(view)).empty());
    }
}

TEST_F(FalseSpheres, MayBeTheRootOfTheScene) {
    writeMetadata("", "0,0,0");
    const osg::ref_ptr<osg::Node> scene = read("method=sphere");
    removeBins(*scene);
    const std::string before = flagsOf(*scene);
    EXPECT_GT(installBins(*scene, {}), 0U);
    EXPECT_GT(setCullOptions(*scene, {}), 0U);
    removeBins(*scene);
    EXPECT_EQ(flagsOf(*scene), before);
}

}  // namespace
}  // namespace osgAnalyticBin
