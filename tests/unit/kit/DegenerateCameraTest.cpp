// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Cameras at the end of what numbers can say, in a real cull traversal. Oracle: samples of each tile, brought to clip
// space by the camera's matrices. A camera whose picture is in doubt has no horizon; one of numbers that are none culls
// nothing, whatever the method. Ordinary and merely unusual projections: ProjectionTest.cpp.

#include "CameraGlobe.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <support/CapturedNotes.h>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

using test::CameraGlobe;
using test::CullView;
using test::kOccluderDepth;
using test::Look;
using test::LookTotals;
using test::NearPlane;
using test::osgVector;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kViews = 20;

osg::Vec3d anySample(const CameraGlobe& globe, test::Random& random) {
    const auto& samples = globe.samplesOf(static_cast<std::size_t>(random.integer(0, int(globe.size()) - 1)));
    return samples[static_cast<std::size_t>(random.integer(0, int(samples.size()) - 1))];
}

// A view at a sample, so that even the narrowest picture shows one.
osg::Matrixd viewAtSample(const CameraGlobe& globe, test::Random& random) {
    return osg::Matrixd::lookAt(test::randomEyeAbove(random, 2e4), anySample(globe, random),
                                osgVector(random.direction()));
}

osg::Matrixd homogeneous(osg::Matrixd matrix, double factor) {
    for (int i = 0; i < 16; ++i) matrix.ptr()[i] *= factor;
    return matrix;
}

osg::Matrixd turned(test::Random& random) {
    return osg::Matrixd::rotate(osg::Vec3d(0, 0, 1), osgVector(random.direction()));
}

Look lookOf(CameraGlobe& globe, const CullView& view) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    test::cull(globe.root(), view, *visitor);
    return globe.takeLooks().at(0);
}

using Maker = std::function<CullView(const CameraGlobe&, test::Random&)>;

struct Kind {
    const char* name;
    Maker view;
    bool hasEye = false;  // whether there is no doubt of where it is
};

CullView viewOf(const osg::Matrixd& modelView, const osg::Matrixd& projection) {
    CullView view;
    view.modelView = modelView;
    view.projection = projection;
    return view;
}

const osg::Matrixd kPlain = osg::Matrixd::perspective(50.0, 1.3, 1.0, 1e8);

Maker withProjection(const osg::Matrixd& projection) {
    return [projection](const CameraGlobe& globe, test::Random& random) {
        return viewOf(viewAtSample(globe, random), projection);
    };
}

Maker withView(const std::function<osg::Matrixd(test::Random&)>& view) {
    return [view](const CameraGlobe&, test::Random& random) { return viewOf(view(random), kPlain); };
}

// Reversed depth from 1 at the near plane to 0 at an infinite one, brought to OpenGL's range from -1 to 1.
osg::Matrixd reversedInfinite(double near) {
    return osg::Matrixd(1.5, 0, 0, 0, 0, 1.5, 0, 0, 0, 0, 1.0, -1.0, 0, 0, 2.0 * near, 0);
}

// Depth from 0 to 1, as glClipControl(GL_ZERO_TO_ONE) wants it, reversed and infinite.
osg::Matrixd reversedInfiniteFromZero(double near) {
    return osg::Matrixd(1.5, 0, 0, 0, 0, 1.5, 0, 0, 0, 0, 0, -1.0, 0, 0, near, 0);
}

// Cameras with a picture: what is in it, and not behind the horizon, is kept; and some of the rest is not.
const Kind kTrue[] = {
    {"fov 0.001", withProjection(osg::Matrixd::perspective(0.001, 1.0, 1.0, 1e8))},
    {"fov 179", withProjection(osg::Matrixd::perspective(179.0, 1.0, 1.0, 1e8))},
    {"fov 179.9999", withProjection(osg::Matrixd::perspective(179.9999, 1.0, 1.0, 1e8))},
    {"aspect 1e-6", withProjection(osg::Matrixd::perspective(40.0, 1e-6, 1.0, 1e8))},
    {"negative aspect", withProjection(osg::Matrixd::perspective(40.0, -1e-3, 1.0, 1e8))},
    {"reversed, infinite", withProjection(reversedInfinite(1.0))},
    {"reversed, infinite, from 0", withProjection(reversedInfiniteFromZero(1.0))},
    {"tiny homogeneous", withProjection(homogeneous(kPlain, 1e-150))},
    {"near 1e-30", withProjection(osg::Matrixd::perspective(40.0, 1.0, 1e-30, 1e8))},
    {"eye in the centre", withView([](test::Random& random) {
         return osg::Matrixd::lookAt(osg::Vec3d(), osgVector(random.direction()), osgVector(random.direction()));
     })},
    {"eye in a bin",
     [](const CameraGlobe& globe, test::Random& random) {
         const osg::Vec3d eye = anySample(globe, random);
         return viewOf(osg::Matrixd::lookAt(eye, eye + osgVector(random.direction()), osgVector(random.direction())),
                       kPlain);
     }},
};

// Cameras whose picture is in doubt: what may be in it is kept, and nothing is hidden.
const Kind kDoubtful[] = {
    {"near = far", withProjection(osg::Matrixd::perspective(40.0, 1.0, 1e3, 1e3))},
    {"near = far, orthographic", withProjection(osg::Matrixd::ortho(-1e6, 1e6, -1e6, 1e6, 1e3, 1e3))},
    {"no width", withProjection(osg::Matrixd::ortho(0, 0, -1e6, 1e6, 1.0, 1e8))},
    {"squares that underflow", withProjection(homogeneous(kPlain, 1e-161)), true},
    {"squares that overflow", withProjection(homogeneous(kPlain, 1e160)), true},
    {"looking at itself", withView([](test::Random&) {
         return osg::Matrixd::lookAt(osg::Vec3d(9e6, 0, 0), osg::Vec3d(9e6, 0, 0), osg::Vec3d(0, 0, 1));
     })},
    {"looking up", withView([](test::Random&) {
         return osg::Matrixd::lookAt(osg::Vec3d(9e6, 0, 0), osg::Vec3d(), osg::Vec3d(1, 0, 0));
     })},
    {"flat view",
     [](const CameraGlobe& globe, test::Random& random) {
         // of rank two, though rounding gives it some inverse
         const osg::Matrixd turn = turned(random);
         const osg::Matrixd flat = turn * osg::Matrixd::scale(1.0, 1.0, 0.0) * osg::Matrixd::inverse(turn);
         return viewOf(flat * viewAtSample(globe, random), kPlain);
     }},
    {"view of rank one",
     [](const CameraGlobe& globe, test::Random& random) {
         const osg::Matrixd turn = turned(random);
         return viewOf(turn * osg::Matrixd::scale(0.0, 1.0, 0.0) * viewAtSample(globe, random), kPlain);
     }},
    {"projective view",
     [](const CameraGlobe& globe, test::Random& random) {
         osg::Matrixd view = viewAtSample(globe, random);
         for (int row = 0; row < 3; ++row) view(row, 3) = random.uniform(-1e-6, 1e-6);
         return viewOf(view, kPlain);
     }},
    {"negative homogeneous view",
     [](const CameraGlobe& globe, test::Random& random) {
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
        CameraGlobe globe(test::horizonOptions(method));
        for (const Kind& kind : kTrue) {
            test::Random random(90);
            LookTotals totals;
            for (int i = 0; i < kViews; ++i) {
                CullView view = kind.view(globe, random);
                const Look look = lookOf(globe, view);
                EXPECT_TRUE(totals.add(globe, look, NearPlane::AtTheEye, kOccluderDepth).empty())
                    << kind.name << ", view " << i;
            }
            EXPECT_LT(totals.reached, 0.9 * double(totals.tiles)) << kind.name;
        }
    }
}

TEST(DegenerateCameras, InDoubtKeepWhatMayBeInThePictureAndHideNothing) {
    for (const Method method : {Method::Quadratic, Method::Exact}) {
        CameraGlobe globe(test::horizonOptions(method));
        for (const Kind& kind : kDoubtful) {
            test::Random random(91);
            for (int i = 0; i < kViews; ++i) {
                for (const CullView& view : inAllModes(kind.view(globe, random))) {
                    LookTotals totals;
                    const bool isCutOff = view.cullingMode & osg::CullSettings::NEAR_PLANE_CULLING;
                    const NearPlane nearPlane = isCutOff ? NearPlane::AtMinusOne : NearPlane::AtTheEye;
                    const std::optional<double> occluder = kind.hasEye ? std::optional(kOccluderDepth) : std::nullopt;
                    EXPECT_TRUE(totals.add(globe, lookOf(globe, view), nearPlane, occluder).empty())
                        << kind.name << ", view " << i << ", culling " << view.cullingMode;
                }
            }
        }
    }
}

// Squares of their normals are subnormal, so that OSG gets their length wrong by up to a tenth.
TEST(DegenerateCameras, PlanesWithoutUnitLengthDecideNothing) {
    CameraGlobe globe;
    test::Random random(94);
    LookTotals totals;
    for (int i = 0; i < 2000; ++i) {
        const double scale = random.logUniform(1e-162, 1e-160);
        const osg::Matrixd small = viewAtSample(globe, random) * osg::Matrixd::scale(scale, scale, scale);
        EXPECT_TRUE(totals.add(globe, lookOf(globe, viewOf(small, kPlain))).empty()) << "view " << i;
    }
}

TEST(DegenerateCameras, ThatAreNoNumbersCullNothingByAnyMethod) {
    for (const Method method : {Method::Quadratic, Method::Exact, Method::Sphere, Method::None}) {
        CameraGlobe globe(test::horizonOptions(method));
        test::Random random(92);
        for (const double bad : {kNaN, kInfinity, -kInfinity}) {
            for (int place = 0; place < 32; ++place) {
                CullView view = viewOf(viewAtSample(globe, random), kPlain);
                const CullView good = view;
                (place < 16 ? view.modelView : view.projection).ptr()[place % 16] = bad;
                for (const CullView& each : inAllModes(view)) {
                    // planes that the number takes no part in are as good as before
                    const Look look = lookOf(globe, each);
                    LookTotals totals;
                    EXPECT_TRUE(totals.add(globe, look).empty()) << methodName(method) << ' ' << bad << ' ' << place;
                    if (place < 16) {
                        EXPECT_EQ(look.reached.size(), globe.size())
                            << methodName(method) << ' ' << bad << ' ' << place;
                    }
                }
            }
        }
    }
}

// A frame that squeezes the globe flat tells nothing of where a plane is on it.
TEST(DegenerateCameras, AFrameWithoutAnInverseMeansVisible) {
    test::Random random(93);
    for (int i = 0; i < 50; ++i) {
        const osg::Matrixd turn = turned(random);
        const osg::Matrixd flat = turn * osg::Matrixd::scale(1.0, 1.0, 0.0) * osg::Matrixd::inverse(turn);
        osg::Matrixd projective;
        projective(0, 3) = 1e-7;
        osg::Matrixd unknown;
        unknown(3, 1) = kNaN;
        for (const osg::Matrixd& matrix : {flat, projective, unknown}) {
            const test::CapturedNotes notes;
            const osg::ref_ptr<AnalyticBinCullCallback> callback =
                new AnalyticBinCullCallback(test::startTiles().front(), osg::EllipsoidModel());
            callback->setLocalToEcef(matrix);
            EXPECT_FALSE(callback->getBin().valid());
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin
