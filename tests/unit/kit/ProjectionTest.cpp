// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Every kind of projection and view matrix in a real cull traversal. Oracle: samples of each tile, brought to clip
// space by the camera's matrices, and exact lines of sight to the near plane; what a tile of a sample in the picture is
// culled by does not matter. Each kind also has to cull most of what is not seen. Cameras at the end of what numbers
// can say come last: one whose picture is in doubt has no horizon, and one of numbers that are none culls nothing.
// Cameras in scenes: NestedCameraTest.cpp.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// Clip space z -> -z.
osg::Matrixd reversed(const osg::Matrixd& projection) {
    return projection * osg::Matrixd::scale(1.0, 1.0, -1.0);
}

osg::Matrixd infiniteFar(double tangent, double near) {
    return osg::Matrixd(1.0 / tangent, 0, 0, 0, 0, 1.0 / tangent, 0, 0, 0, 0, -1.0, -1.0, 0, 0, -2.0 * near, 0);
}

osg::Matrixd randomFrustum(Random& random, double near = 1.0, double far = 1e8) {
    const double x = random.uniform(-0.8, 0.8);
    const double y = random.uniform(-0.8, 0.8);
    const double width = random.uniform(0.1, 0.6);
    const double height = random.uniform(0.1, 0.6);
    return osg::Matrixd::frustum((x - width) * near, (x + width) * near, (y - height) * near, (y + height) * near, near,
                                 far);
}

osg::Matrixd randomOrtho(Random& random, double near, double far) {
    const double x = random.uniform(-2e6, 2e6);
    const double y = random.uniform(-2e6, 2e6);
    const double width = random.logUniform(1e5, 4e6);
    const double height = random.logUniform(1e5, 4e6);
    return osg::Matrixd::ortho(x - width, x + width, y - height, y + height, near, far);
}

// An oblique near plane, through a random point before the camera.
osg::Matrixd withObliqueNearPlane(osg::Matrixd projection, Random& random) {
    osg::Vec4d plane(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), -1.0, -random.logUniform(1.0, 1e4));
    osg::Matrixd unproject;
    unproject.invert(projection);
    // the corner of the frustum that faces the plane shall stay on the far plane
    const osg::Vec4d corner = osg::Vec4d(plane.x() > 0 ? 1.0 : -1.0, plane.y() > 0 ? 1.0 : -1.0, 1.0, 1.0) * unproject;
    plane *= 2.0 / (plane * corner);
    for (int row = 0; row < 4; ++row) projection(row, 2) = plane[static_cast<unsigned int>(row)] - projection(row, 3);
    return projection;
}

using Matrices = std::function<osg::Matrixd(Random&)>;
using Maker = std::function<CullView(const CameraGlobe&, Random&)>;

struct Kind {
    const char* name;
    Maker view;
    NearPlane nearPlane = NearPlane::AtMinusOne;
    bool hasHorizon = true;  // whether the horizon is worth anything here
};

CullView viewOf(const osg::Matrixd& modelView, const osg::Matrixd& projection) {
    CullView view;
    view.modelView = modelView;
    view.projection = projection;
    return view;
}

Maker anyViewBy(const Matrices& projection) {
    return [projection](const CameraGlobe&, Random& random) {
        const osg::Matrixd view = randomViewMatrix(random);
        return viewOf(view, projection(random));
    };
}

CullView mirroredView(const CameraGlobe&, Random& random) {
    // as for the picture of a plane mirror somewhere on the globe
    const osg::Vec3d normal = osgVector(random.direction());
    const double offset = random.uniform(-1.0, 1.0) * kEarthRadius;
    osg::Matrixd mirror;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) mirror(i, k) -= 2.0 * normal[i] * normal[k];
        mirror(3, i) = 2.0 * offset * normal[i];
    }
    const osg::Matrixd view = mirror * randomViewMatrix(random);
    return viewOf(view, randomFrustum(random));
}

osg::Matrixd randomInfinite(Random& random) {
    return infiniteFar(random.uniform(0.1, 1.0), 1.0);
}

const Kind kKinds[] = {
    {"off-axis", anyViewBy([](Random& random) { return randomFrustum(random); })},
    {"mirror", mirroredView},
    {"infinite far", anyViewBy(randomInfinite)},
    {"reversed depth", anyViewBy([](Random& random) { return reversed(randomFrustum(random)); }), NearPlane::AtPlusOne,
     false},
    {"reversed depth, infinite far", anyViewBy([](Random& random) { return reversed(randomInfinite(random)); }),
     NearPlane::AtPlusOne, false},
    {"oblique near plane",
     anyViewBy([](Random& random) { return withObliqueNearPlane(randomFrustum(random), random); })},
    {"deep near plane",
     anyViewBy([](Random& random) { return randomFrustum(random, random.logUniform(1e4, 2e7), 1e9); }),
     NearPlane::AtMinusOne, false},
    {"orthographic", anyViewBy([](Random& random) { return randomOrtho(random, -5e7, 1e8); })},
    {"orthographic, near plane anywhere",
     anyViewBy([](Random& random) { return randomOrtho(random, random.uniform(-3e7, 3e7), 1e8); }),
     NearPlane::AtMinusOne, false},
    {"orthographic, reversed depth", anyViewBy([](Random& random) { return reversed(randomOrtho(random, -5e7, 1e8)); }),
     NearPlane::AtPlusOne, false},
    {"orthographic, near beyond far", anyViewBy([](Random& random) { return randomOrtho(random, 1e8, -5e7); }),
     NearPlane::AtMinusOne, false},
};

constexpr int kViews = 20;
constexpr int kSides = osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING;

Look lookOf(CameraGlobe& globe, const CullView& view) {
    (void)cull(globe.root(), view);
    return globe.takeLooks().at(0);
}

// Sums over random views of a kind, in which no tile is missing. `beginning`: where sight begins.
LookTotals totalsOf(const Kind& kind, CameraGlobe& globe, std::uint64_t seed, NearPlane beginning,
                    int cullingMode = kSides, std::optional<double> occluder = std::nullopt) {
    Random random(seed);
    LookTotals totals;
    for (int i = 0; i < kViews; ++i) {
        CullView view = kind.view(globe, random);
        view.cullingMode = cullingMode;
        EXPECT_TRUE(totals.add(globe, lookOf(globe, view), beginning, occluder).empty()) << kind.name << ", view " << i;
    }
    return totals;
}

TEST(Projections, NoTileInThePictureIsCulledAndMostOthersAre) {
    for (const Method method : {Method::Quadratic, Method::Exact}) {
        CameraGlobe globe(by(method));
        for (const Kind& kind : kKinds) {
            // what near and far planes cut off is kept where only the sides cull
            const LookTotals bySides = totalsOf(kind, globe, 70, NearPlane::AtTheEye);
            EXPECT_LT(bySides.reached, bySides.tiles / 2) << kind.name;
            const LookTotals byAll = totalsOf(kind, globe, 72, kind.nearPlane, osg::CullSettings::VIEW_FRUSTUM_CULLING);
            for (const LookTotals& totals : {bySides, byAll})
                EXPECT_LT(totals.reached, 1.6 * double(totals.seen) + 1.0 * kViews) << kind.name;
        }
    }
}

TEST(Projections, TheHorizonHidesNothingInThePicture) {
    CameraGlobe globe(horizonOptions());
    CameraGlobe without;
    for (const Kind& kind : kKinds) {
        const LookTotals totals = totalsOf(kind, globe, 71, kind.nearPlane, kSides, kOccluderDepth);
        const LookTotals plain = totalsOf(kind, without, 71, kind.nearPlane);
        EXPECT_TRUE(!kind.hasHorizon || double(totals.reached) < 0.9 * double(plain.reached)) << kind.name;
    }
}

osg::Matrixd alongX(double eye) {
    return osg::Matrixd::lookAt(osg::Vec3d(eye, 0, 0), osg::Vec3d(eye + 1.0, 0, 0), osg::Vec3d(0, 0, 1));
}

// With near and far computed, OSG draws nothing that is wholly behind the eye of an orthographic camera.
TEST(Projections, WhatIsBehindAnOrthographicEyeHidesNothing) {
    CameraGlobe globe(horizonOptions());
    CullView view;
    view.modelView = alongX(0.0);
    view.projection = osg::Matrixd::ortho(-8e6, 8e6, -8e6, 8e6, -1e8, 1e8);
    view.computeNearFar = osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
    EXPECT_EQ(lookOf(globe, view).reached.size(), 128u);
    // before the occluder, but not before the terrain
    view.modelView = alongX(-kEarthRadius + 0.5 * kOccluderDepth);
    EXPECT_EQ(lookOf(globe, view).reached.size(), 128u);
    view.modelView = alongX(-1e7);
    EXPECT_LT(lookOf(globe, view).reached.size(), 100u);
    view.modelView = alongX(0.0);
    view.computeNearFar = osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
    EXPECT_LT(lookOf(globe, view).reached.size(), 100u);
}

TEST(Projections, ATiltedNearPlaneCutsTheGlobeOpenAtOneSide) {
    CameraGlobe globe(test::horizonOptions());
    CullView view = CullView::lookAt({3e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 60.0);
    LookTotals totals;
    for (const double tilt : {0.0, 1.2, -1.2}) {
        view.projection = osg::Matrixd::ortho(-8e6, 8e6, -8e6, 8e6, 1e6, 1e8);
        view.projection(0, 2) = tilt * view.projection(0, 0);
        const Look look = lookOf(globe, view);
        EXPECT_TRUE(totals.add(globe, look, NearPlane::AtMinusOne, kOccluderDepth).empty()) << tilt;
        EXPECT_EQ(look.reached.size() < 128u, tilt == 0.0) << tilt;
    }
}

// Two orthographic cameras that share side planes and view matrix see different things if their near planes differ.
TEST(Projections, CamerasThatDifferInTheNearPlaneAloneAreToldApart) {
    CameraGlobe globe(horizonOptions());
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    for (const double near : {1e6, 3e7, 1e6}) {
        const osg::ref_ptr<osg::Projection> projection =
            new osg::Projection(osg::Matrixd::ortho(-8e6, 8e6, -8e6, 8e6, near, 1e8));
        projection->setCullingActive(false);
        projection->addChild(&globe.root());
        scene->addChild(projection);
    }
    CullView view = CullView::lookAt({3e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 60.0);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    cull(*scene, view, *visitor);
    const std::vector<Look> looks = globe.takeLooks();
    ASSERT_EQ(looks.size(), 3u);
    LookTotals totals;
    for (const Look& look : looks) EXPECT_TRUE(totals.add(globe, look, NearPlane::AtMinusOne, kOccluderDepth).empty());
    EXPECT_LT(looks[0].reached.size(), looks[1].reached.size());
    EXPECT_EQ(looks[0].reached, looks[2].reached);
}

osg::Vec3d anySample(const CameraGlobe& globe, Random& random) {
    const auto& samples = globe.samplesOf(static_cast<std::size_t>(random.integer(0, int(globe.size()) - 1)));
    return samples[static_cast<std::size_t>(random.integer(0, int(samples.size()) - 1))];
}

// A view at a sample, so that even the narrowest picture shows one.
osg::Matrixd viewAtSample(const CameraGlobe& globe, Random& random) {
    return osg::Matrixd::lookAt(randomEyeAbove(random, 2e4), anySample(globe, random), osgVector(random.direction()));
}

osg::Matrixd homogeneous(osg::Matrixd matrix, double factor) {
    for (int i = 0; i < 16; ++i) matrix.ptr()[i] *= factor;
    return matrix;
}

osg::Matrixd turned(Random& random) {
    return osg::Matrixd::rotate(osg::Vec3d(0, 0, 1), osgVector(random.direction()));
}

const osg::Matrixd kPlain = osg::Matrixd::perspective(50.0, 1.3, 1.0, 1e8);

Maker withProjection(const osg::Matrixd& projection) {
    return [projection](const CameraGlobe& globe, Random& random) {
        return viewOf(viewAtSample(globe, random), projection);
    };
}

Maker withView(const Matrices& view) {
    return [view](const CameraGlobe&, Random& random) { return viewOf(view(random), kPlain); };
}

// Depth from 0 to 1, as glClipControl(GL_ZERO_TO_ONE) wants it, reversed and infinite.
osg::Matrixd reversedInfiniteFromZero(double near) {
    return osg::Matrixd(1.5, 0, 0, 0, 0, 1.5, 0, 0, 0, 0, 0, -1.0, 0, 0, near, 0);
}

// Cameras with a picture: what is in it, and not behind the horizon, is kept; and some of the rest is not.
const Kind kTrue[] = {
    {"fov 0.001", withProjection(osg::Matrixd::perspective(0.001, 1.0, 1.0, 1e8))},
    {"fov 179.9999", withProjection(osg::Matrixd::perspective(179.9999, 1.0, 1.0, 1e8))},
    {"reversed, infinite, from 0", withProjection(reversedInfiniteFromZero(1.0))},
    {"tiny homogeneous", withProjection(homogeneous(kPlain, 1e-150))},
    {"near 1e-30", withProjection(osg::Matrixd::perspective(40.0, 1.0, 1e-30, 1e8))},
    {"eye in the centre", withView([](Random& random) {
         return osg::Matrixd::lookAt(osg::Vec3d(), osgVector(random.direction()), osgVector(random.direction()));
     })},
    {"eye in a bin",
     [](const CameraGlobe& globe, Random& random) {
         const osg::Vec3d eye = anySample(globe, random);
         return viewOf(osg::Matrixd::lookAt(eye, eye + osgVector(random.direction()), osgVector(random.direction())),
                       kPlain);
     }},
};

// Cameras whose picture is in doubt, but not where their eye is.
const std::vector<Kind> kWithEye{{"squares that underflow", withProjection(homogeneous(kPlain, 1e-161))},
                                 {"squares that overflow", withProjection(homogeneous(kPlain, 1e160))}};

// Cameras whose picture is in doubt: what may be in it is kept, and nothing is hidden.
const std::vector<Kind> kDoubtful{
    {"near = far", withProjection(osg::Matrixd::perspective(40.0, 1.0, 1e3, 1e3))},
    {"no width", withProjection(osg::Matrixd::ortho(0, 0, -1e6, 1e6, 1.0, 1e8))},
    {"looking at itself", withView([](Random&) {
         return osg::Matrixd::lookAt(osg::Vec3d(9e6, 0, 0), osg::Vec3d(9e6, 0, 0), osg::Vec3d(0, 0, 1));
     })},
    {"flat view",
     [](const CameraGlobe& globe, Random& random) {
         // of rank two, though rounding gives it some inverse
         const osg::Matrixd turn = turned(random);
         const osg::Matrixd flat = turn * osg::Matrixd::scale(1.0, 1.0, 0.0) * osg::Matrixd::inverse(turn);
         return viewOf(flat * viewAtSample(globe, random), kPlain);
     }},
    {"projective view",
     [](const CameraGlobe& globe, Random& random) {
         osg::Matrixd view = viewAtSample(globe, random);
         for (int row = 0; row < 3; ++row) view(row, 3) = random.uniform(-1e-6, 1e-6);
         return viewOf(view, kPlain);
     }},
    {"negative homogeneous view",
     [](const CameraGlobe& globe, Random& random) {
         return viewOf(homogeneous(viewAtSample(globe, random), -1.0), kPlain);
     }},
};

std::vector<CullView> inAllModes(CullView view) {
    using Settings = osg::CullSettings;
    std::vector<CullView> views;
    for (const auto mode : {Settings::VIEW_FRUSTUM_SIDES_CULLING, Settings::VIEW_FRUSTUM_CULLING}) {
        for (const auto depths :
             {Settings::DO_NOT_COMPUTE_NEAR_FAR, Settings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES}) {
            view.cullingMode = mode;
            view.computeNearFar = depths;
            views.push_back(view);
        }
    }
    return views;
}

TEST(DegenerateCameras, WithAPictureCullSoundlyAndDoCull) {
    for (const Method method : {Method::Quadratic, Method::Exact}) {
        CameraGlobe globe(horizonOptions(method));
        for (const Kind& kind : kTrue) {
            const LookTotals totals = totalsOf(kind, globe, 90, NearPlane::AtTheEye, kSides, kOccluderDepth);
            EXPECT_LT(totals.reached, 0.9 * double(totals.tiles)) << kind.name;
        }
    }
}

TEST(DegenerateCameras, InDoubtKeepWhatMayBeInThePictureAndHideNothing) {
    for (const Method method : {Method::Quadratic, Method::Exact}) {
        CameraGlobe globe(horizonOptions(method));
        const auto keepsWhatIsSeen = [&](const Kind& kind, const std::optional<double>& occluder) {
            Random random(91);
            for (int i = 0; i < kViews / 2; ++i) {
                for (const CullView& view : inAllModes(kind.view(globe, random))) {
                    LookTotals totals;
                    const bool isCutOff = view.cullingMode & osg::CullSettings::NEAR_PLANE_CULLING;
                    const NearPlane nearPlane = isCutOff ? NearPlane::AtMinusOne : NearPlane::AtTheEye;
                    EXPECT_TRUE(totals.add(globe, lookOf(globe, view), nearPlane, occluder).empty())
                        << kind.name << ", view " << i << ", culling " << view.cullingMode;
                }
            }
        };
        for (const Kind& kind : kWithEye) keepsWhatIsSeen(kind, kOccluderDepth);
        for (const Kind& kind : kDoubtful) keepsWhatIsSeen(kind, std::nullopt);
    }
}

TEST(DegenerateCameras, OfZerosOrOfNoNumbersCullNothingByAnyMethod) {
    for (const Method method : {Method::Quadratic, Method::Exact, Method::Sphere, Method::None}) {
        CameraGlobe globe(horizonOptions(method));
        Random random(92);
        for (const double bad : {kNaN, -kInfinity}) {
            for (int place = 0; place < 32; ++place) {
                CullView view = viewOf(viewAtSample(globe, random), kPlain);
                (place < 16 ? view.modelView : view.projection).ptr()[place % 16] = bad;
                for (const CullView& each : inAllModes(view)) {
                    // planes that the number takes no part in are as good as before
                    const Look look = lookOf(globe, each);
                    LookTotals totals;
                    EXPECT_TRUE(totals.add(globe, look).empty()) << methodName(method) << ' ' << bad << ' ' << place;
                    EXPECT_TRUE(place >= 16 || look.reached.size() == globe.size()) << methodName(method) << place;
                }
            }
        }
        const osg::Matrixd zero(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
        for (const CullView& view : {viewOf(zero, kPlain), viewOf(viewAtSample(globe, random), zero)})
            for (const CullView& each : inAllModes(view)) EXPECT_EQ(lookOf(globe, each).reached.size(), globe.size());
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
