// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Terrain that hides terrain. Oracle: rays through all triangles, in long double. That nothing is hidden that a ray
// reaches, on globes and in maps, from one eye and from any in a box: tests/long/soundness/OcclusionSoundness.cpp.

#include "CoreTest.h"
#include "OcclusionScene.h"

#include <cstring>

namespace osgAnalyticBin::test {
namespace {

constexpr int kRays = 24;

// Whether such a column alone hides a body.
bool hides(HorizonBuffer buffer, const EarthColumn& column, const BinHull& body) {
    buffer.add(columnsOf(column));
    return buffer.hides(buffer.outlineOf(body));
}

// The points within `reach` metres of a point.
BinHull ball(const glm::dvec3& centre, double reach) {
    BinHull body{};
    for (std::size_t i = 0; i < 8; ++i) body.setCorner(i, centre);
    body.reach = reach;
    return body;
}

TEST(HorizonBuffer, HidesMuchOfWhatNoRayReaches) {
    Random random(1705);
    int hidden = 0, unseen = 0;
    for (int i = 0; i < 40; ++i) {
        const OcclusionScene scene(random, false);
        HorizonBuffer buffer = bufferOf(scene);
        for (const GroundTile& tile : scene.tiles) addTile(buffer, scene, tile, 8);
        for (const auto& [part, outline] : frontToBack(scene, buffer)) {
            const bool isHidden = buffer.hides(outline);
            bool isAhead = false, isSeen = false;
            for (int ray = 0; ray < kRays && !isSeen; ++ray) {
                const RealVector point = scene.topOf(random, part);
                if (!isBeforeTheCamera(scene, point)) continue;
                isAhead = true;
                isSeen = !scene.isBlocked(point);
            }
            if (!isAhead || isSeen) continue;
            ++unseen;
            hidden += isHidden;
        }
    }
    std::printf("%d quarters of bins and parts whose tops no ray reaches, %d hidden\n", unseen, hidden);
    EXPECT_GT(10 * hidden, 3 * unseen);
}

// In the frame of an eye at the origin that looks along y, with z up: the point at (x, y) in the picture.
glm::dvec3 pointAt(double x, double y, double forward) {
    return {x * forward, forward, y * forward};
}

// A wall across a part of the picture, upright before the eye.
EarthColumn wallAt(double forward, const core::Interval& across, const core::Interval& up, double error = 1e-6) {
    EarthColumn wall;
    for (std::size_t i = 0; i < 4; ++i) {
        const double x = i % 2 == 0 ? across.lower : across.upper;
        wall.top[i] = pointAt(x, up.upper, forward);
        wall.bottom[i] = pointAt(x, up.lower, forward);
    }
    wall.error = error;
    return wall;
}

EarthColumn randomColumn(Random& random) {
    const double forward = random.logUniform(1e3, 1e5), x = random.uniform(-1.2, 1.2), y = random.uniform(-0.1, 0.1);
    const double size = random.logUniform(0.003, 0.3), depth = random.uniform(0.0, 0.5);
    EarthColumn column;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto corner = [&](double low) {
            return pointAt(x + size * random.uniform(-1.0, 1.0), low + size * random.uniform(-2.0, 2.0),
                           forward * random.uniform(0.9, 1.1));
        };
        column.top[i] = corner(y);
        column.bottom[i] = corner(y - depth);
    }
    column.error = forward * random.logUniform(1e-10, 1e-4);
    return column;
}

// A column whose corners are wrong by up to the error that it states.
EarthColumn perturbed(Random& random, EarthColumn column) {
    for (auto* corners : {&column.top, &column.bottom})
        for (glm::dvec3& corner : *corners) corner += 0.999 * column.error * random.direction();
    return column;
}

// Whether a line of sight meets the column before it comes to the point: one of the triangles between its corners.
bool isBehind(const EarthColumn& column, const RealVector& point) {
    std::array<glm::dvec3, 8> corners;
    std::copy(column.bottom.begin(), column.bottom.end(),
              std::copy(column.top.begin(), column.top.end(), corners.begin()));
    for (std::size_t a = 0; a < 8; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            for (std::size_t c = 0; c < b; ++c)
                if (meets({corners[a], corners[b], corners[c]}, {0, 0, 0}, point)) return true;
        }
    }
    return false;
}

TEST(HorizonBuffer, HidesOnlyWhatIsInThePictureOfEarthInFront) {
    Random random(1707);
    int hidden = 0;
    for (int scene = 0; scene < 4000; ++scene) {
        std::vector<EarthColumn> columns;
        HorizonBuffer buffer(0.0, kAcross);
        const int count = random.integer(1, 30);
        for (int i = 0; i < count; ++i) {
            const EarthColumn column = randomColumn(random);
            buffer.add(columnsOf(column));
            columns.push_back(perturbed(random, column));
        }
        for (int i = 0; i < 300; ++i) {
            // close to an edge of a picture, or anywhere
            const EarthColumn& near = columns[static_cast<std::size_t>(random.integer(0, count - 1))];
            const glm::dvec3 a = random.pick(random.chance(0.6) ? near.top : near.bottom);
            const glm::dvec3 b = random.pick(random.chance(0.6) ? near.top : near.bottom);
            const double share = random.chance(0.5) ? random.uniform() : random.sign() * random.logUniform(1e-5, 1e-1);
            const double x = (1.0 - share) * a.x / a.y + share * b.x / b.y;
            const double y =
                (1.0 - share) * a.z / a.y + share * b.z / b.y - random.sign() * random.logUniform(1e-6, 1e-1);
            // mostly front to back, or no answer would be yes
            const double forward = random.chance(0.1) ? random.logUniform(1e3, 2e5) : 1e3 * std::pow(200.0, i / 300.0);
            const double size = forward * random.logUniform(1e-9, 1e-2);
            BinHull body{};
            for (std::size_t corner = 0; corner < 8; ++corner)
                body.setCorner(corner, pointAt(x, y, forward) + random.uniform(0.0, size) * random.direction());
            body.reach = random.chance(0.5) ? size : 1e-9 * size;
            if (!buffer.hides(buffer.outlineOf(body))) continue;
            const glm::dvec3 point =
                body.corner(static_cast<std::size_t>(random.integer(0, 7))) + 0.999 * body.reach * random.direction();
            if (std::abs(point.x) > point.y) continue;
            ++hidden;
            ASSERT_TRUE(std::any_of(columns.begin(), columns.end(),
                                    [&](const EarthColumn& column) { return isBehind(column, real(point)); }))
                << "scene " << scene;
        }
    }
    EXPECT_GT(hidden, 12000);
}

// An error to the side lowers a steep line by more than an error downward does.
TEST(HorizonBuffer, LowersSteepLinesByTheErrorsOfTheirCorners) {
    constexpr double kForward = 1000.0, kSlope = 2.0;
    EarthColumn column;
    for (std::size_t i = 0; i < 4; ++i) {
        const double x = i % 2 == 0 ? 0.0 : 0.5;
        column.top[i] = pointAt(x, kSlope * x, kForward);
        column.bottom[i] = pointAt(x, -1.0, kForward);
    }
    column.error = 1.0;
    // the errors of a corner's place in the picture; |x| is at most 0.5, |y| at most 1
    const double across = 1.5 * column.error / (kForward - column.error);
    const double upward = 2.0 * column.error / (kForward - column.error);
    const double error = upward + kSlope * across;
    // this line rises to the right: in a strip it is lowest at the left end
    const double strip = kAcross.width() / static_cast<double>(HorizonBuffer::kStrips), left = 0.25;
    const auto hidesBelowTheLine = [&](double below) {
        return hides(HorizonBuffer(0.0, kAcross), column,
                     ball(pointAt(left + 0.3 * strip, kSlope * left - below, 2.0 * kForward), 1e-6));
    };
    EXPECT_FALSE(hidesBelowTheLine(0.95 * error));
    EXPECT_TRUE(hidesBelowTheLine(1.05 * error));
}

// Random terrain has few ends as steep as a wall's, and eyes aside look past those first.
TEST(HorizonBuffer, HidesNothingThatEyesSeePastTheEndOfAWall) {
    constexpr double kForward = 1000.0, kEnd = 0.3, kTop = 0.1;
    const EarthColumn wall = wallAt(kForward, {-kEnd, kEnd}, {-1.0, kTop}, 0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 eyes(0.0);
        eyes[axis] = 20.0;
        HorizonBuffer buffer(0.0, kAcross, 0.0, 0.0, eyes);
        buffer.add(columnsOf(wall));
        for (const bool isAbove : {false, true}) {
            bool isHidden = false;
            for (double inside = 0.0; inside < 0.1; inside += 1e-4) {
                const glm::dvec3 point =
                    isAbove ? pointAt(0.0, kTop - inside, 5.0 * kForward) : pointAt(kEnd - inside, 0.0, 5.0 * kForward);
                isHidden = buffer.hides(buffer.outlineOf(ball(point, 1e-6)));
                for (const double side : {-0.999, 0.999}) {
                    EarthColumn seen = wall;
                    for (auto* corners : {&seen.top, &seen.bottom})
                        for (glm::dvec3& corner : *corners) corner -= side * eyes;
                    ASSERT_TRUE(!isHidden || isBehind(seen, real(point - side * eyes)))
                        << "axis " << axis << ", " << inside << " inside";
                }
            }
            EXPECT_TRUE(isHidden) << "axis " << axis;
        }
    }
}

TEST(HorizonBuffer, FindsBallsBesideThePicture) {
    Random random(1719);
    int beside = 0;
    for (int trial = 0; trial < 300000; ++trial) {
        const double radius = random.logUniform(1e-3, 1e6);
        const glm::dvec3 centre = random.logUniform(1e-2, 10.0) * radius * random.direction();
        const glm::dvec3 eyes = random.logUniform(1e-6, 1.0) * radius * glm::abs(random.direction());
        const core::Interval across{random.uniform(-3.0, 0.0), random.uniform(0.1, 3.0)};
        const HorizonBuffer buffer(random.logUniform(1e-3, 1e7), across, 0.0, 0.0, eyes);
        if (!buffer.isBeside({centre, radius})) continue;
        ++beside;
        // the point that is nearest to a side of the picture, from a corner of the box of eyes, or any other one
        const double side = random.pick(std::array<double, 2>{across.lower, across.upper});
        const glm::dvec3 normal = random.sign() * glm::normalize(glm::dvec3(1.0, -side, 0.0));
        const glm::dvec3 point = centre + radius * (random.chance(0.5) ? normal : random.direction());
        const glm::dvec3 from = point - eyes * glm::dvec3(random.sign(), random.sign(), random.sign());
        ASSERT_TRUE(from.y < 0.0 || from.x < across.lower * from.y || from.x > across.upper * from.y)
            << "trial " << trial;
    }
    EXPECT_GT(beside, 40000);
}

#ifdef OSGANALYTICBIN_SIMD

// Vectors of any width and single numbers give the same outlines and the same pictures, bit for bit.
TEST(HorizonBuffer, IsTheSameForAllInstructionSets) {
    Random random(1720);
    std::vector<OcclusionScene> scenes;
    std::vector<glm::dvec3> eyes;
    for (int i = 0; i < 20; ++i) {
        scenes.emplace_back(random, true, i % 4 == 3);
        eyes.push_back(randomEyes(random, scenes.back()));
    }
    const auto picture = [&](std::vector<double>& numbers) {
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            const OcclusionScene& scene = scenes[i];
            HorizonBuffer buffer = bufferOf(scene, eyes[i]);
            for (const GroundTile& tile : scene.tiles) addTile(buffer, scene, tile, std::size_t{2} << i % 3);
            for (const auto& [part, outline] : frontToBack(scene, buffer)) {
                numbers.push_back(buffer.hides(outline));
                numbers.insert(numbers.end(), {outline.nearest, outline.across.lower, outline.across.upper,
                                               outline.heights.lower, outline.heights.upper, outline.distance});
            }
            for (std::size_t strip = 0; strip < HorizonBuffer::kStrips; ++strip) {
                numbers.push_back(buffer.covered(strip).lower);
                numbers.push_back(buffer.covered(strip).upper);
            }
            numbers.push_back(buffer.nearestEarth());
        }
    };
    std::vector<double> scalar;
    core::kernels::activeOcclusion = core::kernels::kScalarOcclusion;
    picture(scalar);
    forEachTarget([&](const char* target) {
        std::vector<double> vector;
        picture(vector);
        ASSERT_EQ(vector.size(), scalar.size());
        EXPECT_EQ(std::memcmp(vector.data(), scalar.data(), vector.size() * sizeof(double)), 0) << target;
    });
}

#endif

// Random terrain has few bodies just in front of a wall: earth waits in lists of those that are about as far.
TEST(HorizonBuffer, HidesNothingJustInFrontOfEarth) {
    Random random(1741);
    for (int trial = 0; trial < 2000; ++trial) {
        const double forward = random.logUniform(1e3, 4e3), share = random.logUniform(1e-5, 0.1);
        const EarthColumn column = wallAt(forward, {-0.5, 0.5}, {-0.5, 0.5}, 0.0);
        const auto isHidden = [&](double at) {
            return hides(HorizonBuffer(0.0, kAcross), column, ball(pointAt(0.0, 0.0, at), 1e-6));
        };
        ASSERT_FALSE(isHidden((1.0 - share) * forward)) << share;
        ASSERT_TRUE(isHidden((1.0 + share) * forward)) << share;
    }
}

// If two depths are equal after rounding, the body that is drawn first stays visible: for the eye farthest back, too.
TEST(HorizonBuffer, HidesOnlyWhatADepthBufferTellsFromEarth) {
    constexpr double kForward = 1000.0, kDepthStep = 1e-5;
    const EarthColumn column = wallAt(kForward, {-0.5, 0.5}, {-0.5, 0.5});
    const auto isHidden = [&](double forward, double depthStep, double back) {
        return hides(HorizonBuffer(0.0, kAcross, 0.0, depthStep, {0.0, back, 0.0}), column,
                     ball(pointAt(0.0, 0.0, forward), 1e-6));
    };
    EXPECT_TRUE(isHidden(kForward + 0.001, 0.0, 0.0));
    for (const double back : {0.0, 200.0}) {
        const double farthestEqual = 1.0 / (1.0 / (kForward + back) - kDepthStep) - back;
        EXPECT_FALSE(isHidden(farthestEqual - 0.01, kDepthStep, back));
        EXPECT_TRUE(isHidden(farthestEqual + 0.01, kDepthStep, back));
    }
}

TEST(HorizonBuffer, LeavesOutWhatHasNoPlaceInThePicture) {
    const core::Ellipsoid earth = wgs84();
    // looks north
    const core::Frame eye{earth.toEcef({0.0, 0.0, 1000.0}), {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
    const auto fromEye = [&](const core::Geodetic& place) {
        const glm::dvec3 from = earth.toEcef(place) - eye.origin;
        return glm::dvec3(glm::dot(from, eye.x), glm::dot(from, eye.y), glm::dot(from, eye.z));
    };
    const auto wall = [&](double from, double to) {
        EarthColumn column;
        for (std::size_t i = 0; i < 4; ++i) {
            column.top[i] = fromEye({i < 2 ? from : to, i % 2 == 0 ? -0.01 : 0.01, 3000.0});
            column.bottom[i] = fromEye({i < 2 ? from : to, i % 2 == 0 ? -0.01 : 0.01, -3000.0});
        }
        column.error = 1e-6;
        return column;
    };
    const auto bodyOf = [&](const core::GeodeticBin& bin) {
        return core::BinBody(earth, bin, 0.0, eye).quarters().front();
    };
    const BinHull behind = bodyOf(core::GeodeticBin({0.005, 0.007}, {-0.001, 0.003}, {0.0, 500.0}));
    const BinHull behindTheEye = bodyOf(core::GeodeticBin({-0.006, -0.004}, {-0.001, 0.003}, {0.0, 500.0}));
    const auto isHidden = [&](const EarthColumn& column, const BinHull& body) {
        return hides(HorizonBuffer(glm::length(eye.origin), kAcross), column, body);
    };
    EXPECT_TRUE(isHidden(wall(0.002, 0.003), behind));
    EXPECT_FALSE(isHidden(wall(0.007, 0.008), behind));  // farther
    HorizonBuffer nearPlaneIsFar(glm::length(eye.origin), kAcross);
    EXPECT_TRUE(nearPlaneIsFar.raiseLowest(0.0));
    EXPECT_FALSE(hides(nearPlaneIsFar, wall(0.002, 0.003), behind));
    EXPECT_FALSE(isHidden(wall(0.002, 0.0056), behind));  // partly
    EXPECT_FALSE(isHidden(wall(-0.001, 0.003), behind));  // about the eye
    EXPECT_FALSE(isHidden(wall(-0.003, -0.002), behindTheEye));
    EarthColumn broken = wall(0.002, 0.003);
    broken.top[2].y = std::nan("");
    EXPECT_FALSE(isHidden(broken, behind));
    // an error that is forgotten, and corners as near as rounding allows
    EarthColumn close = wall(0.002, 0.003);
    close.error = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        close.top[i] = {i == 0 ? -1e-8 : 1e-8, 1e-8, 1e-8};
        close.bottom[i] = {i == 0 ? -1e-8 : 1e-8, 1e-8, -1e-8};
    }
    EXPECT_FALSE(isHidden(close, behind));
    BinHull endless = behind, nowhere = behind;
    for (const double reach : {-1.0, kNaN, 1e9}) {
        endless.reach = reach;
        EXPECT_FALSE(isHidden(wall(0.002, 0.003), endless)) << reach;
    }
    nowhere.z[5] = kNaN;
    EXPECT_FALSE(isHidden(wall(0.002, 0.003), nowhere));
}

}  // namespace
}  // namespace osgAnalyticBin::test
