// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Photogrammetry sets as an application opens them: where they stand, what is said of broken ones, and what is culled
// of them, through OSG's own pager. Oracles of places: the meridian arc, OSG's ellipsoid; of culling: the
// same set without it, of which every drawable with a vertex in the field of view has to be drawn.

#include "DatabaseFixture.h"

#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/InstallBins.h>

#include <osg/CoordinateSystemNode>
#include <osg/Matrixd>
#include <osgDB/ReaderWriter>

#include <PagedFlight.h>
#include <support/CapturedNotes.h>
#include <support/PhotogrammetrySample.h>
#include <support/Random.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

namespace fs = std::filesystem;

using test::CapturedNotes;
using test::ecefDeg;

// A photogrammetry set in a folder of its own.
class Photogrammetry : public ::testing::Test {
protected:
    void SetUp() override { write(true); }

    void write(bool hasFalseSpheres) {
        ASSERT_TRUE(test::PhotogrammetrySample(_folder.path(), hasFalseSpheres).write());
        writeMetadata("ENU:47.5,11.2", "0,0,0");
    }

    void writeMetadata(const std::string& srs, const std::string& origin) const {
        (void)_folder.write("metadata.xml", "<?xml version=\"1.0\"?>\n<ModelMetadata version=\"1\"><SRS>" + srs +
                                                "</SRS><SRSOrigin>" + origin + "</SRSOrigin></ModelMetadata>\n");
    }

    [[nodiscard]] osgDB::ReaderWriter::ReadResult readResult(const std::string& options = "") const {
        const std::string name = _metadata + (options.empty() ? "" : ".(" + options + ")") + ".analyticbin";
        return osgDB::Registry::instance()->readNode(name, nullptr);
    }
    [[nodiscard]] osg::ref_ptr<osg::Node> read(const std::string& options = "") const {
        osgDB::ReaderWriter::ReadResult result = readResult(options);
        return result.getNode();
    }
    [[nodiscard]] std::string errorOfRead() const {
        osgDB::ReaderWriter::ReadResult result = readResult();
        return result.validNode() ? "no error" : result.message();
    }

    // The transform that holds the tiles of a set that was read.
    [[nodiscard]] static osg::MatrixTransform* setIn(osg::Node& scene) {
        auto* const globe = dynamic_cast<osg::CoordinateSystemNode*>(&scene);
        return dynamic_cast<osg::MatrixTransform*>(globe ? globe->getChild(0) : &scene);
    }

    // Where a point of the tiles' frame stands on the globe.
    osg::Vec3d placed(const osg::Vec3d& point) const {
        const osg::ref_ptr<osg::Node> scene = read();
        EXPECT_TRUE(scene) << errorOfRead();
        return scene ? point * setIn(*scene)->getMatrix() : osg::Vec3d();
    }
    void expectError(const std::string& text) const {
        EXPECT_NE(errorOfRead().find(text), std::string::npos) << errorOfRead();
    }
    void expectError(const std::string& srs, const std::string& origin, const std::string& text) const {
        writeMetadata(srs, origin);
        expectError(text);
    }

    test::TemporaryFolder _folder;
    const std::string _metadata = _folder / "metadata.xml";
};

TEST_F(Photogrammetry, StandsWhereEnuSays) {
    EXPECT_NEAR((placed({0, 0, 0}) - ecefDeg(47.5, 11.2, 0.0)).length(), 0.0, 1e-6);
    EXPECT_NEAR((placed({0, 0, 250}) - ecefDeg(47.5, 11.2, 250.0)).length(), 0.0, 1e-6);
    // 100 m to the north are to the north
    const osg::Vec3d north = placed({0, 100, 0}) - placed({0, 0, 0});
    const osg::Vec3d expected = ecefDeg(47.501, 11.2, 0.0) - ecefDeg(47.5, 11.2, 0.0);
    EXPECT_NEAR(north.length(), 100.0, 1e-6);
    EXPECT_GT(north * expected / (north.length() * expected.length()), 1.0 - 1e-8);
}

TEST_F(Photogrammetry, AddsTheOriginInTheFrameOfEnu) {
    writeMetadata("ENU:47.5,11.2", "10,20,30");
    const osg::Vec3d moved = placed({1, 2, 3});
    writeMetadata("ENU:47.5,11.2", "0,0,0");
    EXPECT_NEAR((moved - placed({11, 22, 33})).length(), 0.0, 1e-6);
}

#ifdef OSGANALYTICBIN_PROJ
// On its central meridian the transverse Mercator projection is the meridian arc by its scale.
TEST_F(Photogrammetry, StandsWhereAMapSays) {
    constexpr double kArc = 5262834.8670;  // metres from the equator to 47.5 degrees, by quadrature
    const double northing = 0.9996 * kArc;
    writeMetadata("EPSG:32632", "500000," + std::to_string(northing) + ",600");
    // the tangent touches at the middle of the set, some metres up
    EXPECT_NEAR((placed({0, 0, 0}) - ecefDeg(47.5, 9.0, 600.0)).length(), 0.0, 0.01);
    EXPECT_NEAR((placed({0, 0, 100}) - ecefDeg(47.5, 9.0, 700.0)).length(), 0.0, 0.01);
    // metres of the map are longer on the earth
    EXPECT_NEAR((placed({100, 0, 0}) - placed({0, 0, 0})).length(),
                100.0 / 0.9996 * (1.0 + 650.0 / osg::WGS_84_RADIUS_EQUATOR), 0.01);
}

TEST_F(Photogrammetry, LeavesTheCurvedEarthAsDocumented) {
    writeMetadata("EPSG:32632", "500000,5260000,0");
    const osg::Vec3d far = placed({0, 5000, 0});
    double latitude = 0.0, longitude = 0.0, height = 0.0;
    osg::EllipsoidModel().convertXYZToLatLongHeight(far.x(), far.y(), far.z(), latitude, longitude, height);
    EXPECT_NEAR(height, 5000.0 * 5000.0 / (2.0 * 6.37e6), 0.1);
}

TEST_F(Photogrammetry, StandsWhereEarthCentredCoordinatesSay) {
    const osg::Vec3d origin = ecefDeg(47.5, 11.2, 0.0);
    writeMetadata("EPSG:4978",
                  std::to_string(origin.x()) + ',' + std::to_string(origin.y()) + ',' + std::to_string(origin.z()));
    EXPECT_NEAR((placed({3, 4, 5}) - (origin + osg::Vec3d(3, 4, 5))).length(), 0.0, 1e-3);
}

TEST_F(Photogrammetry, IsRefusedWhereThePlaceCannotBeKnown) {
    expectError("EPSG:99999999", "0,0,0", "EPSG:99999999\" is not known to PROJ");
    expectError("EPSG:4326", "0,0,0", "coordinates in degrees");
    expectError("EPSG:32632", "1e30,1e30,0", "are SRS and SRSOrigin right?");
}
#else
TEST_F(Photogrammetry, IsRefusedWhereThePlaceCannotBeKnown) {
    expectError("EPSG:32632", "0,0,0", "built with PROJ");
}
#endif

TEST_F(Photogrammetry, WithoutAReferenceSystemStandsInItsOwnCoordinates) {
    writeMetadata("", "0,0,0");
    const CapturedNotes notes;
    const osg::ref_ptr<osg::Node> scene = read();
    ASSERT_TRUE(scene);
    EXPECT_EQ(notes.count("has no SRS"), 1U);
    EXPECT_TRUE(setIn(*scene)->getMatrix().isIdentity());
    EXPECT_TRUE(isPhotogrammetrySet(*scene));
}

TEST_F(Photogrammetry, SaysWhatIsWrongWithItsMetadata) {
    for (const char* text : {"", "<ModelMeta", "\x89PNG"}) {
        (void)_folder.write("metadata.xml", text);
        expectError("no element ModelMetadata");
    }
    expectError("ENU:47.5", "0,0,0", "ENU:LATITUDE,LONGITUDE");
    expectError("ENU:97.5,11", "0,0,0", "ENU:LATITUDE,LONGITUDE");
    expectError("ENU:47.5,11", "0,0", "three numbers");
    expectError("ENU:47.5,11", "0,nan,0", "three numbers");
}

TEST_F(Photogrammetry, SaysWhatIsWrongWithItsFolder) {
    fs::rename(_folder / "Data", _folder / "Elsewhere");
    expectError("no folder Data");
    fs::create_directory(_folder / "Data");
    expectError("holds no tile");
    const CapturedNotes notes;
    (void)osgDB::Registry::instance()->readNode("http://host.invalid/set/metadata.xml.analyticbin", nullptr);
    EXPECT_EQ(notes.count("not from a server"), 1U);
}

TEST_F(Photogrammetry, LeavesOutTilesThatAreMissingOrBrokenWithOneWarningEach) {
    const std::string folder = _folder / "Data/Tile_+000_+000";
    fs::remove_all(folder);
    fs::create_directory(folder);
    (void)_folder.write("Data/Tile_+002_+002/Tile_+002_+002.osgb", "broken");
    fs::remove(_folder / "Data/Tile_+002_+001/Tile_+002_+001.osgb");
    fs::remove(_folder / "Data/Tile_+002_+001/Tile_+002_+001_L1_0.osgb");
    const CapturedNotes notes;
    const osg::ref_ptr<osg::Node> scene = read();
    ASSERT_TRUE(scene);
    EXPECT_EQ(notes.count("2 folders have no root file, the first is \"Data/Tile_+000_+000\""), 1U);
    EXPECT_EQ(notes.count("1 root files cannot be read, the first is \"Data/Tile_+002_+002/"), 1U);
    EXPECT_EQ(setIn(*scene)->getNumChildren(), 6U);
}

TEST_F(Photogrammetry, FindsRootFilesByTheNamesOfTheOthers) {
    const std::string folder = _folder / "Data/Tile_+000_+000";
    fs::rename(folder, _folder / "Data/Block");
    const CapturedNotes notes;
    const osg::ref_ptr<osg::Node> scene = read();
    ASSERT_TRUE(scene);
    EXPECT_EQ(setIn(*scene)->getNumChildren(), 9U);
    EXPECT_EQ(notes.count("no root file"), 0U);
}

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

class FalseSpheres : public Photogrammetry {
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

// Nor is what stands above them: the pager would keep it, and all views would look at it.
TEST_F(FalseSpheres, LeaveTheLevelsAboveThemToBeCulled) {
    Flown set(read());
    const osg::Vec3d middle = setIn(*set.scene)->getMatrix().getTrans(), up = middle / middle.length();
    const CullView down = CullView::lookAt(middle + up * 300.0, middle, osg::Vec3d(0, 0, 1), 90.0);
    const CullView away = CullView::lookAt(middle + up * 300.0, middle + up * 900.0, osg::Vec3d(0, 0, 1), 60.0);
    const auto lastVisit = [&set] {
        unsigned int last = 0;
        test::visitNodes(*set.scene, [&last](osg::Node& node) {
            const auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
            if (paged) last = std::max(last, paged->getFrameNumberOfLastTraversal());
        });
        return last;
    };
    EXPECT_TRUE(set.flight.load(down));
    const unsigned int before = lastVisit();
    set.flight.frames(away, 3);
    EXPECT_EQ(lastVisit(), before);
    set.flight.frame(down);
    EXPECT_GT(lastVisit(), before);
    // what the application never has culled, in a tile with a false sphere
    osg::Node& tile = *setIn(*set.scene)->getChild(1);
    tile.asGroup()->getChild(0)->asGroup()->getChild(0)->setCullingActive(false);
    const unsigned int then = lastVisit();
    set.flight.frames(away, 3);
    EXPECT_GT(lastVisit(), then);
}

TEST_F(FalseSpheres, AreAllThatIsCulledOtherwiseThanByOsg) {
    write(false);
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

// Below a globe, and as the root of the scene.
TEST_F(FalseSpheres, AreAsBeforeWhenBinsAreTakenOff) {
    for (const char* const srs : {"ENU:47.5,11.2", ""}) {
        writeMetadata(srs, "0,0,0");
        const osg::ref_ptr<osg::Node> scene = read("method=sphere");
        removeBins(*scene);
        const std::string before = flagsOf(*scene);
        EXPECT_GT(installBins(*scene, {}), 0U);
        EXPECT_NE(flagsOf(*scene), before);
        EXPECT_GT(setCullOptions(*scene, {}), 0U);
        removeBins(*scene);
        EXPECT_EQ(flagsOf(*scene), before) << srs;
    }
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

}  // namespace
}  // namespace osgAnalyticBin
