// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What is culled of photogrammetry sets, through OSG's own pager. The oracle: the same set without culling, of which
// every drawable with a vertex in the field of view has to be drawn.

#include "PhotogrammetryFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/ConvexPlanarOccluder>
#include <osg/Geometry>
#include <osg/OccluderNode>
#include <osg/PagedLOD>

#include <PagedFlight.h>
#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;

using test::CapturedNotes;
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

constexpr double kSeconds = 60.0;

class BoxSets : public test::PhotogrammetryFixture {
protected:
    [[nodiscard]] osg::ref_ptr<BinIndex> keptIndex() const {
        std::string error;
        for (const auto& entry : fs::recursive_directory_iterator(_cache.path()))
            if (entry.is_regular_file()) return BinIndex::read(entry.path().string(), error);
        return nullptr;
    }

    static std::string withoutStamps(const BinIndex& index) {
        const osg::ref_ptr<BinIndex> plain = new BinIndex(index);
        plain->setStamps({});
        std::ostringstream text;
        EXPECT_TRUE(plain->write(text));
        return text.str();
    }

    // A set that is flown over.
    struct Flown {
        explicit Flown(const osg::ref_ptr<osg::Node>& read) : scene(read), flight(*scene, 100000) {}

        // Returns: the drawables of the view when all that it asks for is there.
        std::set<const osg::Drawable*> drawn(const CullView& view) {
            EXPECT_TRUE(flight.load(view));
            flight.frame(view);
            const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
            return test::cull(*scene, view, *visitor).drawn;
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
        for (const osg::Drawable* drawable : all.drawn(everything)) {
            if (hasVertexInside(*drawable, toEye, view) && drawn.count(keyOf(*drawable)) == 0)
                lost.push_back(keyOf(*drawable));
        }
        return lost;
    }

    // The index that is made in the background, if one is, comes at any time.
    std::size_t lostBy(const std::string& options) {
        Flown all(read("method=none"));
        Flown culled(read(options));
        std::size_t count = 0;
        for (const CullView& view : views(25)) count += lost(all, view, culled.keys(view)).size();
        return count;
    }
};

TEST_F(BoxSets, LoseNothingThatIsInView) {
    EXPECT_EQ(lostBy("index=off"), 0U);
    EXPECT_EQ(lostBy("index=auto"), 0U);
    makeIndex();
    EXPECT_EQ(lostBy("index=on"), 0U);
}

// Otherwise the test above says little.
TEST_F(BoxSets, WithOsgsSpheresLoseDrawables) {
    EXPECT_GT(lostBy("method=sphere"), 0U);
}

TEST_F(BoxSets, AskForNoMoreFilesThanSpheres) {
    test::PhotogrammetrySample sample;
    sample.hasFalseSpheres = false;
    sample.towersFrom = 0;  // so that the spheres hold what is below
    write(sample);
    for (const bool isIndexed : {false, true}) {
        if (isIndexed) makeIndex();
        std::size_t fewer = 0;
        for (const CullView& view : views(12)) {
            Flown spheres(read("method=sphere"));
            Flown boxes(read("index=on"));
            const std::set<std::string> bySpheres = spheres.keys(view);
            const std::set<std::string> byBoxes = boxes.keys(view);
            const std::size_t files = test::loadedTiles(*boxes.scene);
            EXPECT_LE(files, test::loadedTiles(*spheres.scene));
            EXPECT_LE(byBoxes.size(), bySpheres.size());
            fewer += test::loadedTiles(*spheres.scene) - files;
        }
        // boxes that hold everything are tighter than spheres
        EXPECT_TRUE(fewer > 0 || !isIndexed);
    }
}

TEST_F(BoxSets, KeepVisibleWhatDoesNotFitTheIndex) {
    test::PhotogrammetrySample low;
    low.towersFrom = 100;  // none
    write(low);
    makeIndex();
    const std::string index = test::textOfFile(binIndexName(_metadata));
    write({});
    ASSERT_EQ(index, test::textOfFile(binIndexName(_metadata)));
    const CapturedNotes notes;
    EXPECT_EQ(lostBy("method=quadratic"), 0U);
    EXPECT_EQ(notes.count("is not as the index knows it"), 1U);
}

TEST_F(BoxSets, GetAnIndexInTheBackgroundWhichIsUsedAtOnceTheNextTime) {
    osg::ref_ptr<osg::Node> scene = read();
    // an index that is being made goes on
    EXPECT_GT(setCullOptions(*scene, {}), 0U);
    ASSERT_TRUE(waitForIndex(*scene, kSeconds));
    EXPECT_FALSE(isIndexAwaited(*scene));
    scene = nullptr;
    const auto kept = keptIndex();
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->stamps().size(), kept->fileCount());
    std::string error;
    const auto byHand = makeBoxIndex(_metadata, 2, {}, error);
    ASSERT_TRUE(byHand) << error;
    EXPECT_TRUE(byHand->stamps().empty());
    EXPECT_EQ(withoutStamps(*kept), withoutStamps(*byHand));

    const CapturedNotes notes;
    scene = read();
    EXPECT_FALSE(isIndexAwaited(*scene));
    EXPECT_EQ(notes.count("Their index is being made"), 0U);
}

TEST_F(BoxSets, GetANewIndexWhenAFileChangesIsAddedOrIsRemoved) {
    const auto isMadeAnew = [&] {
        const osg::ref_ptr<osg::Node> scene = read();
        return isIndexAwaited(*scene) && waitForIndex(*scene, kSeconds);
    };
    EXPECT_TRUE(isMadeAnew());
    fs::resize_file(_folder / test::kFileWithFalseSphere, 300);
    EXPECT_TRUE(isMadeAnew());
    fs::remove(_folder / test::kFileWithFalseSphere);
    EXPECT_TRUE(isMadeAnew());
    fs::copy(_folder / "Data/Tile_+000_+000", _folder / "Data/Tile_+009_+009");
    fs::rename(_folder / "Data/Tile_+009_+009/Tile_+000_+000.osgb",
               _folder / "Data/Tile_+009_+009/Tile_+009_+009.osgb");
    EXPECT_TRUE(isMadeAnew());
    EXPECT_FALSE(isMadeAnew());
}

TEST_F(BoxSets, GiveLoadedTilesTheBoxesOfTheIndexThatIsMade) {
    test::PhotogrammetrySample sample;
    sample.hasFalseSpheres = false;
    write(sample);
    std::size_t fewer = 0;
    for (const CullView& view : views(12)) {
        makeIndex();
        Flown byHand(read());
        fs::remove(binIndexName(_metadata));
        Flown without(read("index=off"));
        Flown late(read("index=off"));
        // the roots are loaded
        setCullOptions(*late.scene, {});
        ASSERT_TRUE(waitForIndex(*late.scene, kSeconds));
        EXPECT_EQ(late.keys(view), byHand.keys(view));
        (void)without.keys(view);
        const std::size_t files = test::loadedTiles(*late.scene);
        EXPECT_EQ(files, test::loadedTiles(*byHand.scene));
        fewer += test::loadedTiles(*without.scene) - files;
    }
    EXPECT_GT(fewer, 0U);
}

TEST_F(BoxSets, KeepVisibleWhatIsLoadedAndDoesNotFitTheIndexThatIsMade) {
    Flown all(read("method=none"));
    Flown culled(read("index=off"));
    for (const CullView& view : views(12)) {
        (void)lost(all, view, {});
        (void)culled.keys(view);
    }
    test::PhotogrammetrySample low;
    low.towersFrom = 100;  // none
    write(low);
    const CapturedNotes notes;
    setCullOptions(*culled.scene, {});
    ASSERT_TRUE(waitForIndex(*culled.scene, kSeconds));
    EXPECT_EQ(notes.count("is not as the index knows it"), 1U);
    for (const CullView& view : views(12)) EXPECT_TRUE(lost(all, view, culled.keys(view)).empty());
}

// Callbacks, culling flags, options and expiry of all nodes, as text.
class Flags : public osg::NodeVisitor {
public:
    Flags() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Node& node) override {
        text << node.className() << bool(node.getCullCallback()) << bool(node.getUpdateCallback())
             << node.getCullingActive();
        if (auto* const paged = dynamic_cast<osg::PagedLOD*>(&node)) {
            text << bool(paged->getDatabaseOptions());
            for (unsigned int i = 0; i < paged->getNumMinimumExpiryTimes(); ++i) text << paged->getMinimumExpiryTime(i);
        }
        text << '\n';
        traverse(node);
    }
    std::ostringstream text;
};

std::string flagsOf(osg::Node& node) {
    Flags flags;
    node.accept(flags);
    return flags.text.str();
}

TEST_F(BoxSets, FollowOtherOptions) {
    makeIndex();
    Flown boxes(read());
    const CullView view = views(1).front();
    const std::size_t culled = boxes.keys(view).size();
    CullOptions none;
    none.method = Method::None;
    EXPECT_EQ(setCullOptions(*boxes.scene, none), 0U);
    EXPECT_GT(boxes.keys(view).size(), culled);
    setCullOptions(*boxes.scene, {});
    EXPECT_EQ(boxes.keys(view).size(), culled);
}

// A mast that stands out of the tile's box, though not of its sphere, below a view that looks over the box.
TEST_F(BoxSets, ShowWhatAnApplicationAddsBelowATile) {
    makeIndex();
    Flown boxes(read());
    osg::MatrixTransform& set = *setIn(*boxes.scene);
    auto& tile = dynamic_cast<osg::PagedLOD&>(*set.getChild(0));
    const osg::Vec3d top(tile.getCenter() + osg::Vec3(0, 0, 0.9F * tile.getRadius()));
    const osg::Vec3d eye(top - osg::Vec3d(3000, 0, 0));
    const osg::Vec3d up = osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), set.getMatrix());
    const CullView view =
        CullView::lookAt(eye * set.getMatrix(), (top + osg::Vec3d(0, 0, 510)) * set.getMatrix(), up, 20.0);
    ASSERT_TRUE(boxes.drawn(view).empty());
    const osg::ref_ptr<osg::Geometry> mast = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    vertices->push_back(osg::Vec3(top) - osg::Vec3(0, 0, 9));
    vertices->push_back(osg::Vec3(top));
    mast->setVertexArray(vertices);
    mast->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, 2));
    ASSERT_TRUE(tile.getChild(0)->asGroup()->addChild(mast));
    EXPECT_EQ(boxes.drawn(view).count(mast), 1U);
    EXPECT_EQ(boxes.drawn(view).count(mast), 1U);
}

// A wall before the eye, which hides no box: OSG tests occluders by spheres.
TEST_F(BoxSets, AreCulledByBoxesWhereThereAreOccluders) {
    Flown boxes(read("index=off"));
    const CullView view = views(1).front();
    const std::set<std::string> before = boxes.keys(view);
    const osg::Matrixd toWorld = osg::Matrixd::inverse(view.modelView);
    const osg::ref_ptr<osg::ConvexPlanarOccluder> wall = new osg::ConvexPlanarOccluder;
    for (const osg::Vec3d& corner : {osg::Vec3d(-5, -5, -6), {5, -5, -6}, {5, 5, -6}, {-5, 5, -6}})
        wall->getOccluder().add(osg::Vec3(corner));
    const osg::ref_ptr<osg::OccluderNode> occluder = new osg::OccluderNode;
    occluder->setOccluder(wall);
    occluder->setCullingActive(false);
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(toWorld);
    place->addChild(occluder);
    boxes.scene->asGroup()->addChild(place);
    CullView occluded = view;
    occluded.cullingMode |= osg::CullSettings::SHADOW_OCCLUSION_CULLING;
    EXPECT_EQ(boxes.keys(occluded), before);
}

TEST_F(BoxSets, LetViewersThatDrawOnDemandRest) {
    makeIndex();
    Flown boxes(read());
    const CullView view = views(1).front();
    (void)boxes.keys(view);
    boxes.flight.frames(view, 3);
    EXPECT_FALSE(setIn(*boxes.scene)->getUpdateCallback());
}

TEST_F(BoxSets, LoseNothingInClones) {
    Flown all(read("method=none"));
    const osg::ref_ptr<osg::Node> original = read("index=off");
    for (const unsigned int callbacks : {0U, unsigned(osg::CopyOp::DEEP_COPY_CALLBACKS)}) {
        const unsigned int flags = unsigned(osg::CopyOp::DEEP_COPY_NODES) | callbacks;
        Flown clone(osg::clone(original.get(), osg::CopyOp(flags)));
        for (const CullView& view : views(6)) EXPECT_TRUE(lost(all, view, clone.keys(view)).empty());
    }
}

TEST_F(BoxSets, MayBeTheRootOfTheScene) {
    writeMetadata("", "0,0,0");
    const osg::ref_ptr<osg::Node> scene = read("method=sphere");
    const std::string before = flagsOf(*scene);
    CullOptions options;
    options.index = IndexUse::Off;
    EXPECT_GT(installBins(*scene, options), 0U);
    EXPECT_GT(setCullOptions(*scene, {}), 0U);
    EXPECT_TRUE(isIndexAwaited(*scene));
    EXPECT_TRUE(waitForIndex(*scene, kSeconds));
    removeBins(*scene);
    EXPECT_EQ(flagsOf(*scene), before);
}

}  // namespace
}  // namespace osgAnalyticBin
