// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The eye above the lowest surface that is shown. Oracle: rays through the picture, met by the surfaces that OSG's rule
// shows: a constant altitude for each tile, its lowest, with walls between tiles. A ray that enters the occluder and
// has not met a surface by then would see what is hidden.

#include "../../osgAnalyticBin/src/node/ShownDepth.h"
#include "CameraGlobe.h"
#include "CullFixture.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin {
namespace {

using test::osgVector;

using core::GeodeticBin;
using core::HorizonEye;
using test::CullView;
using test::Random;

constexpr double kRadius = 6378137.0;
constexpr double kPolarRadius = 6356752.3142;
constexpr double kRoom = 1.05;  // documented
constexpr int kLevels = 3;

core::Ellipsoid earth() {
    return core::Ellipsoid(kRadius, kPolarRadius);
}

glm::dvec3 toUnitSpace(const glm::dvec3& v) {
    return {v.x / kRadius, v.y / kRadius, v.z / kPolarRadius};
}
// A tile of the synthetic tree, with its four parts when they are loaded.
struct Tile {
    core::Interval latitude, longitude;
    double surface = 0.0, low = 0.0, high = 0.0;  // metres
    float cutoff = 0.0f;                          // nearer than that its parts are shown
    glm::dvec3 center{0.0};
    std::vector<Tile> parts;
    bool isUncertain = false;  // all that is loaded may be shown
    osg::ref_ptr<AnalyticBinCullCallback> callback;
};

struct Terrain {
    double deepShare = 0.1;
    double loadedShare = 0.6;
    double airShare = 0.5;  // of bins that reach far above their surfaces
    osg::LOD::RangeMode mode = osg::LOD::DISTANCE_FROM_EYE_POINT;
    double movedShare = 0.0;  // of start tiles below a transform
    bool hasCallbackInFront = false;
};

osg::ref_ptr<osg::Group> nodeOf(Tile& tile, const Terrain& terrain, const osg::Matrixd& localToEcef) {
    const GeodeticBin extents(tile.latitude, tile.longitude, {tile.low, tile.high});
    tile.callback = new AnalyticBinCullCallback(AnalyticBin(extents), osg::EllipsoidModel());
    tile.callback->setSurface(AnalyticBin(extents.withAltitude({tile.surface, tile.surface})));
    if (!localToEcef.isIdentity()) tile.callback->setLocalToEcef(localToEcef);
    osg::ref_ptr<osg::Group> node = new osg::Group;
    if (tile.cutoff > 0.0f) {
        const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
        node = paged;
        paged->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        paged->setCenter(osgVector(tile.center) * osg::Matrixd::inverse(localToEcef));
        paged->setRadius(1.0f);
        paged->setRangeMode(terrain.mode);
        paged->addChild(new osg::Geode, tile.cutoff, 1e10f);
        paged->setFileName(1, "parts");
        paged->setRange(1, 0.0f, tile.cutoff);
        if (!tile.parts.empty()) {
            const osg::ref_ptr<osg::Group> parts = new osg::Group;
            for (Tile& part : tile.parts) parts->addChild(nodeOf(part, terrain, localToEcef));
            paged->addChild(parts);
        }
    }
    node->setCullingActive(false);
    if (terrain.hasCallbackInFront) node->addCullCallback(new osg::NodeCallback);
    node->addCullCallback(tile.callback);
    return node;
}

// A globe of 32 start tiles, 45 degrees wide.
class DeepGlobe {
public:
    DeepGlobe(const Terrain& terrain, Random& random) : _terrain(terrain), _random(random) {
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 8; ++x) {
                const GeodeticBin bin = GeodeticBin::fromDegrees({-90.0 + 45.0 * y, -45.0 + 45.0 * y},
                                                                 {-180.0 + 45.0 * x, -135.0 + 45.0 * x}, {0.0, 0.0});
                const bool isMoved = random.chance(terrain.movedShare);
                _tiles.push_back(made(bin, 0, isMoved || terrain.mode != osg::LOD::DISTANCE_FROM_EYE_POINT));
                _moved.push_back(isMoved);
            }
        }
    }

    // To be called when the tiles are as they are to be.
    void build() {
        const osg::Matrixd turn =
            osg::Matrixd::rotate(0.7, osg::Vec3d(0.1, 0.2, 1.0)) * osg::Matrixd::translate(1e5, 0, 0);
        for (std::size_t i = 0; i < _tiles.size(); ++i) {
            if (!_moved[i]) {
                root->addChild(nodeOf(_tiles[i], _terrain, osg::Matrixd()));
                continue;
            }
            const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(turn);
            transform->addChild(nodeOf(_tiles[i], _terrain, turn));
            root->addChild(transform);
        }
    }

    // The altitude of the surface that OSG shows there from the eye; the lowest where that is uncertain.
    [[nodiscard]] double shownAltitude(double latitude, double longitude, const glm::dvec3& eye) const {
        return shownAt(*find(_tiles, latitude, longitude), latitude, longitude, eye);
    }

    [[nodiscard]] Tile& start(std::size_t i) { return _tiles[i]; }

    template <class Visit>
    void forEachShown(const glm::dvec3& eye, const Visit& visit) const {
        for (const Tile& tile : _tiles) forEachShown(tile, eye, visit);
    }

    osg::ref_ptr<osg::Group> root = new osg::Group;

private:
    Tile made(const GeodeticBin& extents, int level, bool isUncertain) {
        Tile tile;
        tile.latitude = extents.latitude();
        tile.longitude = extents.longitude();
        tile.surface =
            _random.chance(_terrain.deepShare) ? -_random.logUniform(500.0, 15000.0) : _random.uniform(-400.0, 3000.0);
        tile.low = tile.high = tile.surface;
        tile.center = earth().toEcef({tile.latitude.middle(), tile.longitude.middle(), 0.0});
        tile.isUncertain = isUncertain;
        if (level + 1 < kLevels) {
            tile.cutoff = static_cast<float>(_random.logUniform(5e5, 2e7));
            if (_random.chance(_terrain.loadedShare)) {
                for (const GeodeticBin& quarter : extents.quarters()) {
                    tile.parts.push_back(made(quarter, level + 1, isUncertain));
                    tile.low = std::min(tile.low, tile.parts.back().low);
                    tile.high = std::max(tile.high, tile.parts.back().high);
                }
            }
        }
        if (_random.chance(_terrain.airShare)) tile.high = std::max(tile.high, 9000.0);
        return tile;
    }

    static const Tile* find(const std::vector<Tile>& tiles, double latitude, double longitude) {
        const auto found = std::find_if(tiles.begin(), tiles.end(), [&](const Tile& tile) {
            return tile.latitude.contains(latitude) && tile.longitude.contains(longitude);
        });
        return found == tiles.end() ? &tiles.back() : &*found;
    }

    static bool isFine(const Tile& tile, const glm::dvec3& eye) {
        return !tile.parts.empty() && glm::distance(eye, tile.center) < static_cast<double>(tile.cutoff);
    }

    static double shownAt(const Tile& tile, double latitude, double longitude, const glm::dvec3& eye) {
        if (tile.parts.empty()) return tile.surface;
        const double fine = shownAt(*find(tile.parts, latitude, longitude), latitude, longitude, eye);
        if (tile.isUncertain) return std::min(tile.surface, fine);
        return isFine(tile, eye) ? fine : tile.surface;
    }

    template <class Visit>
    static void forEachShown(const Tile& tile, const glm::dvec3& eye, const Visit& visit) {
        const bool fine = isFine(tile, eye);
        if (tile.isUncertain || !fine) visit(tile);
        if (fine || (tile.isUncertain && !tile.parts.empty())) {
            for (const Tile& part : tile.parts) forEachShown(part, eye, visit);
        }
    }

    const Terrain _terrain;
    Random& _random;
    std::vector<Tile> _tiles;
    std::vector<bool> _moved;
};

struct Picture {
    glm::dvec3 eye{0.0}, forward{0.0}, right{0.0}, up{0.0};
    double fov = 40.0;  // degrees

    Picture(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& roll, double degrees)
        : eye(from), forward(glm::normalize(to - from)), fov(degrees) {
        right = glm::normalize(glm::cross(forward, roll));
        up = glm::cross(right, forward);
    }

    [[nodiscard]] CullView view() const {
        return CullView::lookAt(osgVector(eye), osgVector(eye + forward * 1e6), osgVector(up), fov);
    }

    // Coordinates of the picture run from -1 to 1.
    [[nodiscard]] glm::dvec3 ray(double x, double y) const {
        const double reach = std::tan(fov * 3.14159265358979323846 / 360.0);
        return glm::normalize(forward + right * (x * reach) + up * (y * reach));
    }
};

// Asks for the eye in a real cull traversal.
class Asker : public osg::NodeCallback {
public:
    Asker(double startDepth, double deepest) : depth(startDepth), _deepest(deepest) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        osg::CullStack& cullStack = *nv->asCullStack();
        const auto viewpoint = Viewpoint::of(cullStack, *nv, false);
        if (viewpoint)
            eye = eyeAboveWhatIsShown(*node->asGroup(), *nv, cullStack, *viewpoint, earth(), {}, _deepest, depth);
    }

    double depth;
    std::optional<HorizonEye> eye;

private:
    double _deepest;
};

struct Answer {
    std::optional<HorizonEye> eye;
    double found = 0.0;  // depth of the lowest surface
};

constexpr double kUndeclared = std::numeric_limits<double>::infinity();

Answer ask(osg::Group& database, const Picture& picture, double startDepth = 0.0, double deepest = kUndeclared) {
    const osg::ref_ptr<Asker> asker = new Asker(startDepth, deepest);
    database.setCullCallback(asker);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    test::cull(database, picture.view(), *visitor);
    database.setCullCallback(nullptr);
    return {asker->eye, asker->depth};
}

bool hidesPoint(const HorizonEye& eye, const glm::dvec3& point) {
    const core::Geodetic g = earth().toGeodetic(point);
    const GeodeticBin bin({g.latitude, g.latitude}, {g.longitude, g.longitude}, {g.altitude, g.altitude});
    return eye.hides(core::HorizonBin(earth(), bin));
}

// The depth of the occluder that an eye was made for, by where it begins to hide points of the ellipsoid.
double occluderDepth(const HorizonEye& eye, const glm::dvec3& from) {
    const glm::dvec3 toEye = glm::normalize(toUnitSpace(from));
    const glm::dvec3 side = glm::normalize(glm::cross(toEye, glm::dvec3(0.3, 0.5, 0.8)));
    const auto pointAt = [&](double angle) {
        return (toEye * std::cos(angle) + side * std::sin(angle)) * glm::dvec3(kRadius, kRadius, kPolarRadius);
    };
    double seen = 0.0;
    double hidden = 3.14159265358979323846;
    for (int i = 0; i < 60; ++i) {
        const double angle = 0.5 * (seen + hidden);
        (hidesPoint(eye, pointAt(angle)) ? hidden : seen) = angle;
    }
    double shallow = 0.0;
    double deep = 1e6;
    for (int i = 0; i < 60; ++i) {
        const double depth = 0.5 * (shallow + deep);
        const auto other = HorizonEye::fromEye(earth(), depth, from);
        // an eye inside the occluder has to have a deeper one
        (!other || hidesPoint(*other, pointAt(hidden)) ? shallow : deep) = depth;
    }
    return shallow;
}

// Where the ray enters the occluder, in metres from the eye.
std::optional<double> entry(const glm::dvec3& eye, const glm::dvec3& ray, double depth) {
    const double scale = 1.0 - depth / kPolarRadius;
    const glm::dvec3 e = toUnitSpace(eye) / scale;
    const glm::dvec3 v = toUnitSpace(ray) / scale;
    const double a = glm::dot(v, v);
    const double b = glm::dot(e, v);
    const double c = glm::dot(e, e) - 1.0;
    const double discriminant = b * b - a * c;
    if (discriminant <= 0.0 || b >= 0.0) return std::nullopt;
    return (-b - std::sqrt(discriminant)) / a;
}

// Whether the ray has met a shown surface when it has gone so far.
bool isStopped(const DeepGlobe& globe, const glm::dvec3& eye, const glm::dvec3& ray, double distance) {
    const auto isBelow = [&](double t) {
        const core::Geodetic g = earth().toGeodetic(eye + ray * t);
        return g.altitude <= globe.shownAltitude(g.latitude, g.longitude, eye);
    };
    if (isBelow(distance)) return true;
    constexpr double kStep = 200.0;
    for (double t = distance; t > 0.0 && earth().toGeodetic(eye + ray * t).altitude < 3000.0; t -= kStep) {
        if (isBelow(t)) return true;
    }
    return false;
}

Picture randomPicture(Random& random, double lowestEye) {
    const glm::dvec3 direction = random.direction();
    const core::Geodetic below = earth().toGeodetic(direction * kRadius);
    const glm::dvec3 eye = earth().toEcef({below.latitude, below.longitude, lowestEye + random.logUniform(20.0, 2e7)});
    // towards the horizon, where the occluder matters
    const double dip = std::acos(std::min(1.0, (kRadius - 5000.0) / glm::length(eye)));
    const glm::dvec3 side = glm::normalize(glm::cross(direction, random.direction()));
    const double angle = dip * random.uniform(0.5, 1.1) + 1e-4;
    const glm::dvec3 target = (direction * std::cos(angle) + side * std::sin(angle)) * kRadius;
    return Picture(eye, target, random.chance(0.5) ? direction : random.direction(), random.logUniform(0.05, 90.0));
}

struct DepthTally {
    int eyes = 0;
    int entered = 0;  // rays that entered the occluder
};

// Nothing that is seen is hidden from the eye.
void expectNothingSeenIsHidden(const DeepGlobe& globe, const Picture& picture, const HorizonEye& eye, Random& random,
                               DepthTally& tally) {
    // less than what the depth is found to
    const double depth = occluderDepth(eye, picture.eye) + 0.5;
    ++tally.eyes;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 ray = picture.ray(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        const auto distance = entry(picture.eye, ray, depth);
        if (!distance) continue;
        ++tally.entered;
        ASSERT_TRUE(isStopped(globe, picture.eye, ray, *distance)) << "depth " << depth << " fov " << picture.fov;
    }
}

// The deepest surface shown on tiles that come within `room` of what the eye sees over the horizon.
double deepestNear(const DeepGlobe& globe, const Picture& picture, double depth) {
    constexpr double kAngle = 0.06;
    const glm::dvec3 toEye = toUnitSpace(picture.eye);
    const double occluder = 1.0 - depth / kPolarRadius;
    const double horizon =
        std::acos(std::min(1.0, occluder / glm::length(toEye))) + std::acos(std::min(1.0, occluder / 1.0015));
    double deepest = 0.0;
    globe.forEachShown(picture.eye, [&](const Tile& tile) {
        for (int i = 0; i < 81; ++i) {
            const glm::dvec3 point =
                toUnitSpace(earth().toEcef({tile.latitude.lower + tile.latitude.width() * (i % 9) / 8.0,
                                            tile.longitude.lower + tile.longitude.width() * (i / 9) / 8.0, 0.0}));
            const double cosine = glm::dot(point, toEye) / (glm::length(point) * glm::length(toEye));
            if (std::acos(std::clamp(cosine, -1.0, 1.0)) <= horizon + kAngle)
                deepest = std::max(deepest, -tile.surface);
        }
    });
    return deepest;
}

DepthTally fly(const Terrain& terrain, std::uint64_t stream, int globes, bool startsDeep = false) {
    Random random(stream);
    DepthTally tally;
    for (int trial = 0; trial < globes; ++trial) {
        DeepGlobe globe(terrain, random);
        globe.build();
        for (int shot = 0; shot < 12; ++shot) {
            const Picture picture = randomPicture(random, -15000.0 * random.uniform());
            const core::Geodetic at = earth().toGeodetic(picture.eye);
            if (at.altitude <= globe.shownAltitude(at.latitude, at.longitude, picture.eye) + 10.0) continue;
            const double start = startsDeep ? random.uniform(0.0, 20000.0) : 0.0;
            const Answer answer = ask(*globe.root, picture, start);
            if (!answer.eye) {
                // an eye above the globe finds a horizon
                EXPECT_LT(at.altitude, 0.0);
                continue;
            }
            expectNothingSeenIsHidden(globe, picture, *answer.eye, random, tally);
            if (testing::Test::HasFatalFailure()) return tally;

            const double depth = occluderDepth(*answer.eye, picture.eye);
            EXPECT_LE(answer.found, depth + 1.0);
            if (at.altitude > 0.0) {
                EXPECT_LE(depth, std::max(start, kRoom * deepestNear(globe, picture, depth)) + 1.0);
            }
            // where the first search ends the next one begins
            const Answer next = ask(*globe.root, picture, answer.found);
            EXPECT_TRUE(next.eye || at.altitude < 0.0);
            if (next.eye && at.altitude > 0.0) {
                EXPECT_NEAR(occluderDepth(*next.eye, picture.eye), answer.found, 1.0);
            }
        }
    }
    return tally;
}

TEST(ShownDepth, HidesNothingThatIsSeen) {
    for (const double deepShare : {0.02, 0.3, 1.0}) {
        for (const double airShare : {0.0, 1.0}) {
            Terrain terrain;
            terrain.deepShare = deepShare;
            terrain.airShare = airShare;
            const DepthTally tally = fly(terrain, 2100, 40);
            EXPECT_GT(tally.eyes, 200);
            EXPECT_GT(tally.entered, 3000);
        }
    }
}

TEST(ShownDepth, HidesNothingThatIsSeenWhereverTheSearchStarts) {
    EXPECT_GT(fly(Terrain(), 2101, 30, true).entered, 1000);
}

TEST(ShownDepth, CountsAllThatIsLoadedWhereSizesOnScreenChoose) {
    Terrain terrain;
    terrain.mode = osg::LOD::PIXEL_SIZE_ON_SCREEN;
    EXPECT_GT(fly(terrain, 2102, 30).entered, 1000);
}

TEST(ShownDepth, CountsAllThatIsLoadedBelowATransform) {
    Terrain terrain;
    terrain.movedShare = 0.5;
    EXPECT_GT(fly(terrain, 2103, 30).entered, 1000);
}

TEST(ShownDepth, FindsTilesBehindOtherCallbacks) {
    Terrain terrain;
    terrain.hasCallbackInFront = true;
    EXPECT_GT(fly(terrain, 2104, 20).entered, 1000);
}

// A flat globe seen from 1000 km above 22.5 east, 22.5 north, straight down: tile 20 is below the eye, tile 21 east of
// it.
class FlatGlobe : public testing::Test {
protected:
    FlatGlobe() {
        Terrain terrain;
        terrain.deepShare = 0.0;
        terrain.loadedShare = 0.0;
        Random random(1);
        globe = std::make_unique<DeepGlobe>(terrain, random);
        for (std::size_t i = 0; i < 32; ++i) setAltitude(i, -100.0);
    }

    void setAltitude(std::size_t i, double altitude) {
        Tile& tile = globe->start(i);
        tile.surface = tile.low = altitude;
        tile.high = std::max(altitude, 0.0);
    }

    static Picture pictureOf(double degrees) {
        const double angle = 22.5 * 3.14159265358979323846 / 180.0;
        return Picture(earth().toEcef({angle, angle, 1e6}), glm::dvec3(0.0), {0.0, 0.0, 1.0}, degrees);
    }

    static constexpr std::size_t kBelow = 20, kFarSide = 8;
    std::unique_ptr<DeepGlobe> globe;
};

TEST_F(FlatGlobe, HasItsDepthInTheFirstFrame) {
    globe->build();
    const Picture picture = pictureOf(40.0);
    const Answer first = ask(*globe->root, picture);
    ASSERT_TRUE(first.eye);
    EXPECT_NEAR(first.found, 100.0, 1e-9);
    EXPECT_NEAR(occluderDepth(*first.eye, picture.eye), 100.0, 0.5);
    const Answer second = ask(*globe->root, picture, first.found);
    ASSERT_TRUE(second.eye);
    EXPECT_NEAR(occluderDepth(*second.eye, picture.eye), 100.0, 0.5);
}

TEST_F(FlatGlobe, IsAsDeepAsItsDeepestTileInView) {
    setAltitude(kBelow, -9000.0);
    globe->build();
    EXPECT_NEAR(ask(*globe->root, pictureOf(40.0)).found, 9000.0, 1e-9);
}

TEST_F(FlatGlobe, IsNoDeeperForTilesBehindItOrBesideTheView) {
    setAltitude(kFarSide, -9000.0);
    setAltitude(kBelow - 1, -8000.0);
    globe->build();
    EXPECT_NEAR(ask(*globe->root, pictureOf(1.0)).found, 100.0, 1e-9);
}

TEST_F(FlatGlobe, HasNoHorizonWhereADepthInViewIsUnknown) {
    globe->start(kBelow).low = globe->start(kFarSide).low = -300.0;
    globe->build();
    globe->start(kFarSide).callback->setSurface(AnalyticBin());
    EXPECT_TRUE(ask(*globe->root, pictureOf(40.0)).eye);
    globe->start(kBelow).callback->setSurface(AnalyticBin());
    const Answer answer = ask(*globe->root, pictureOf(40.0), 500.0);
    EXPECT_FALSE(answer.eye);
    EXPECT_EQ(answer.found, 0.0);
}

TEST_F(FlatGlobe, IsAsDeepAsDeclaredWhereADepthInViewIsUnknown) {
    globe->start(kBelow).low = -300.0;
    globe->build();
    const Picture picture = pictureOf(40.0);
    EXPECT_NEAR(ask(*globe->root, picture, 0.0, 700.0).found, 100.0, 1e-9);
    globe->start(kBelow).callback->setSurface(AnalyticBin());
    const Answer answer = ask(*globe->root, picture, 0.0, 700.0);
    ASSERT_TRUE(answer.eye);
    EXPECT_NEAR(occluderDepth(*answer.eye, picture.eye), 700.0, 0.5);
}

TEST_F(FlatGlobe, IsNeverDeeperThanDeclared) {
    setAltitude(kBelow, -9000.0);
    globe->build();
    const Picture picture = pictureOf(40.0);
    for (const double start : {0.0, 700.0, 20000.0}) {
        const Answer answer = ask(*globe->root, picture, start, 700.0);
        ASSERT_TRUE(answer.eye);
        EXPECT_NEAR(occluderDepth(*answer.eye, picture.eye), 700.0, 0.5);
    }
}

TEST_F(FlatGlobe, NeedsNoDepthWhereTheBinIsAboveTheRest) {
    globe->build();
    globe->start(kBelow).callback->setSurface(AnalyticBin());
    EXPECT_NEAR(ask(*globe->root, pictureOf(40.0)).found, 100.0, 1e-9);
}

TEST_F(FlatGlobe, HasNoHorizonWhereATileIsOfAnotherShape) {
    globe->build();
    globe->start(kBelow).callback->setTerrainShape(TerrainShape{2.0, 1.0});
    EXPECT_FALSE(ask(*globe->root, pictureOf(40.0)).eye);
}

TEST_F(FlatGlobe, IsNoDeeperForAnotherDatabaseInsideIt) {
    globe->build();
    Terrain terrain;
    terrain.deepShare = 0.0;
    terrain.loadedShare = 0.0;
    Random random(2);
    DeepGlobe other(terrain, random);
    for (std::size_t i = 0; i < 32; ++i) other.start(i).surface = other.start(i).low = -7000.0;
    other.build();
    const osg::ref_ptr<osg::CoordinateSystemNode> inside = new osg::CoordinateSystemNode;
    inside->addChild(other.root);
    globe->root->addChild(inside);
    const Picture picture = pictureOf(40.0);
    EXPECT_NEAR(ask(*globe->root, picture).found, 100.0, 1e-9);
    EXPECT_NEAR(ask(*other.root, picture).found, 7000.0, 1e-9);
}

// Adds a tile without parts, its bin as flat as its surface. Degrees.
void addFlatTile(osg::Group& root, core::Interval latitude, core::Interval longitude, double altitude) {
    const AnalyticBin bin(GeodeticBin::fromDegrees(latitude, longitude, {altitude, altitude}));
    const osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback(bin, osg::EllipsoidModel());
    callback->setSurface(bin);
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    tile->setCullCallback(callback);
    root.addChild(tile);
}

TEST(ShownDepth, FindsABasinThatLinesOfSightPassHighAbove) {
    // Looking east along the equator past the limb, 4500 m below the ellipsoid at its nearest, over tiles of a basin
    // at -9000 m that are all below the picture.
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    addFlatTile(*root, {-1.0, 1.0}, {-1.0, 0.5}, -3000.0);
    for (int i = 10; i < 100; ++i) addFlatTile(*root, {-0.025, 0.025}, {0.05 * i, 0.05 * (i + 1)}, -9000.0);
    const glm::dvec3 eye = earth().toEcef({0.0, 0.0, 2000.0});
    const double toLimb = std::acos((kRadius - 4500.0) / (kRadius + 2000.0));
    const glm::dvec3 limb = earth().toEcef({0.0, toLimb, -4500.0});
    const Picture picture(eye, limb, {1.0, 0.0, 0.0}, 0.1);

    const auto shallow = HorizonEye::fromEye(earth(), 3000.0, eye);
    ASSERT_TRUE(shallow);
    ASSERT_TRUE(hidesPoint(*shallow, earth().toEcef({0.0, 2.5 * toLimb, -4000.0})));
    const auto distance = entry(eye, picture.ray(0.0, 0.0), 3000.0);
    ASSERT_TRUE(distance);
    EXPECT_GT(earth().toGeodetic(eye + picture.ray(0.0, 0.0) * *distance).longitude, 0.5 * kDegree);

    const Answer answer = ask(*root, picture, 3000.0);
    ASSERT_TRUE(answer.eye);
    EXPECT_NEAR(answer.found, 9000.0, 1e-9);
}

}  // namespace
}  // namespace osgAnalyticBin
