// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Stereo, as osgUtil::SceneView culls it: once for each eye, each with a visitor and matrices of its own. Oracle:
// samples of the tiles, projected by the matrices that DisplaySettings gives the eyes.

#include "CameraGlobe.h"

#include <gtest/gtest.h>
#include <osg/DisplaySettings>
#include <osgUtil/SceneView>

#include <algorithm>
#include <cmath>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

using osg::DisplaySettings;
using test::CameraGlobe;
using test::kEarthRadius;
using test::kOccluderDepth;
using test::Look;
using test::LookTotals;
using test::NearPlane;

// The eyes are this far apart for a screen at 0.5 m: a planet on the table.
constexpr double kEyeScale = 2e6;

struct Stereo {
    explicit Stereo(const CullOptions& options, DisplaySettings::StereoMode mode) : globe(options) {
        settings->setStereo(true);
        settings->setStereoMode(mode);
        view->setDefaults();
        view->setDisplaySettings(settings.get());
        view->setViewport(0, 0, 640, 480);
        view->setSceneData(&globe.root());
        view->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        view->setFusionDistance(osgUtil::SceneView::USE_FUSION_DISTANCE_VALUE,
                                static_cast<float>(kEyeScale * settings->getScreenDistance()));
        view->setFrameStamp(new osg::FrameStamp);
    }

    std::vector<Look> cull(const osg::Matrixd& modelView, const osg::Matrixd& projection) {
        view->setViewMatrix(modelView);
        view->setProjectionMatrix(projection);
        view->cull();
        return globe.takeLooks();
    }

    CameraGlobe globe;
    osg::ref_ptr<DisplaySettings> settings = new DisplaySettings;
    osg::ref_ptr<osgUtil::SceneView> view = new osgUtil::SceneView;
};

const DisplaySettings::StereoMode kModes[] = {DisplaySettings::QUAD_BUFFER,       DisplaySettings::ANAGLYPHIC,
                                              DisplaySettings::HORIZONTAL_SPLIT,  DisplaySettings::VERTICAL_SPLIT,
                                              DisplaySettings::LEFT_EYE,          DisplaySettings::RIGHT_EYE,
                                              DisplaySettings::VERTICAL_INTERLACE};

TEST(Stereo, EachEyeKeepsWhatItSees) {
    for (const DisplaySettings::StereoMode mode : kModes) {
        for (const bool horizon : {false, true}) {
            Stereo stereo(horizon ? test::horizonOptions() : CullOptions(), mode);
            const std::optional<double> depth = horizon ? std::optional(kOccluderDepth) : std::nullopt;
            test::Random random(110);
            LookTotals totals;
            std::size_t different = 0;
            for (int i = 0; i < 6; ++i) {
                const osg::Matrixd modelView = test::randomViewMatrix(random, 2e5);
                const osg::Matrixd projection = osg::Matrixd::perspective(random.uniform(20, 60), 1.3, 1.0, 1e8);
                const std::vector<Look> looks = stereo.cull(modelView, projection);
                const bool oneEye = mode == DisplaySettings::LEFT_EYE || mode == DisplaySettings::RIGHT_EYE;
                ASSERT_EQ(looks.size(), oneEye ? 1u : 2u);
                const DisplaySettings& settings = *stereo.settings;
                for (std::size_t eye = 0; eye < looks.size(); ++eye) {
                    const bool left = mode != DisplaySettings::RIGHT_EYE && eye == 0;
                    EXPECT_EQ(looks[eye].projection,
                              left ? settings.computeLeftEyeProjectionImplementation(projection)
                                   : settings.computeRightEyeProjectionImplementation(projection));
                    EXPECT_EQ(looks[eye].modelView,
                              left ? settings.computeLeftEyeViewImplementation(modelView, kEyeScale)
                                   : settings.computeRightEyeViewImplementation(modelView, kEyeScale));
                    EXPECT_TRUE(totals.add(stereo.globe, looks[eye], NearPlane::AtMinusOne, depth).empty())
                        << "mode " << mode << ", view " << i << ", eye " << eye;
                }
                if (!oneEye && looks[0].reached != looks[1].reached) ++different;
            }
            EXPECT_LT(double(totals.reached), 1.5 * double(totals.seen) + 12.0) << mode;
            EXPECT_LT(totals.reached, totals.tiles / 2) << mode;
            if (mode == DisplaySettings::HORIZONTAL_SPLIT) {
                EXPECT_GT(different, 0u);
            }
        }
    }
}

TEST(Stereo, MasksOfTheEyesChooseTiles) {
    Stereo stereo({}, DisplaySettings::HORIZONTAL_SPLIT);
    for (std::size_t i = 0; i < stereo.globe.size(); ++i) stereo.globe.tile(i).setNodeMask(i % 2 ? 0x1 : 0x2);
    stereo.view->setCullMaskLeft(0x1);
    stereo.view->setCullMaskRight(0x3);
    stereo.globe.root().setNodeMask(~0u);
    const std::vector<Look> looks = stereo.cull(
        osg::Matrixd::lookAt(osg::Vec3d(kEarthRadius + 2e6, 0, 0), osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1)),
        osg::Matrixd::perspective(30.0, 1.3, 1.0, 1e8));
    ASSERT_EQ(looks.size(), 2u);
    const auto isEven = [](std::size_t tile) { return tile % 2 == 0; };
    EXPECT_TRUE(std::none_of(looks[0].reached.begin(), looks[0].reached.end(), isEven));
    EXPECT_TRUE(std::any_of(looks[1].reached.begin(), looks[1].reached.end(), isEven));
    LookTotals totals;
    EXPECT_TRUE(totals.add(stereo.globe, looks[1]).empty());
    EXPECT_LT(totals.reached, 40u);
    EXPECT_GT(looks[0].reached.size(), 0u);
}

}  // namespace
}  // namespace osgAnalyticBin
