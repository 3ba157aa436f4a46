// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Whole viewers that draw into pbuffers: several views of one scene, slave cameras, stereo and shadows, in all of
// osgViewer's threading models. Oracle: the picture without any culling, pixel for pixel. Needs a display (Xvfb will
// do); skipped where no graphics context can be made.

#include "CullFixture.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowedScene>
#include <osgShadow/ViewDependentShadowMap>
#include <osgViewer/CompositeViewer>
#include <osgViewer/Renderer>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

using Threading = osgViewer::ViewerBase::ThreadingModel;

constexpr double kEarthRadius = 6378137.0;
constexpr int kSize = 128;
constexpr unsigned int kFrames = 3;

// A mesh with random heights, in a colour for each post.
osg::ref_ptr<osg::Geode> makeMesh(const core::GeodeticBin& box, int posts, double relief, test::Random& random) {
    const osg::EllipsoidModel wgs84;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
    osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (int y = 0; y < posts; ++y) {
        for (int x = 0; x < posts; ++x) {
            const bool atEdge = x == 0 || y == 0 || x + 1 == posts || y + 1 == posts;  // no cracks between tiles
            osg::Vec3d p;
            wgs84.convertLatLongHeightToXYZ(box.latitude().lower + box.latitude().width() * y / (posts - 1),
                                            box.longitude().lower + box.longitude().width() * x / (posts - 1),
                                            atEdge ? 0.0 : random.uniform(0.0, relief), p.x(), p.y(), p.z());
            vertices->push_back(osg::Vec3(p));
            p.normalize();
            normals->push_back(osg::Vec3(p));
            const auto shade = [&] { return static_cast<float>(random.uniform(0.3, 1.0)); };
            colours->push_back(osg::Vec4(shade(), shade(), shade(), 1.0f));
            if (x + 1 == posts || y + 1 == posts) continue;
            const auto at = [&](int dx, int dy) { return static_cast<GLushort>((y + dy) * posts + x + dx); };
            for (const GLushort i : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)}) {
                triangles->push_back(i);
            }
        }
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices.get());
    geometry->setNormalArray(normals.get());
    geometry->setColorArray(colours.get());
    geometry->addPrimitiveSet(triangles.get());
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry.get());
    return geode;
}

osg::ref_ptr<osg::Group> makeTiles(const std::vector<AnalyticBin>& bins, int posts, const CullOptions& options) {
    osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    test::Random random(130);
    for (const AnalyticBin& bin : bins) {
        osg::ref_ptr<osg::Group> tile = new osg::Group;
        tile->addChild(makeMesh(bin.bin(), posts, 8000.0, random));
        setStoredBin(*tile, bin);
        root->addChild(tile);
    }
    installBins(*root, options);
    return root;
}

CullOptions optionsOf(Method method) {
    CullOptions options;
    options.method = method;
    options.horizonUse = HorizonUse::Given;
    options.horizon = -130000.0;  // the sag of coarse meshes
    return options;
}

osg::ref_ptr<osg::GraphicsContext> makeContext(int width, int height) {
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = width;
    traits->height = height;
    traits->pbuffer = true;
    traits->doubleBuffer = false;
    traits->readDISPLAY();
    return osg::GraphicsContext::createGraphicsContext(traits.get());
}

// Reads a camera's viewport after it is drawn.
class Reader : public osg::Camera::DrawCallback {
public:
    void operator()(osg::RenderInfo& info) const override {
        const osg::Viewport& viewport = *info.getCurrentCamera()->getViewport();
        image->readPixels(int(viewport.x()), int(viewport.y()), int(viewport.width()), int(viewport.height()), GL_RGBA,
                          GL_UNSIGNED_BYTE);
    }
    osg::ref_ptr<osg::Image> image = new osg::Image;
};

using Pictures = std::vector<osg::ref_ptr<osg::Image>>;

// Draws a few frames. Returns: a picture for each camera, and in `tested` the tiles that its last traversal tested.
class Gallery {
public:
    explicit Gallery(Threading threading) : _viewer(new osgViewer::CompositeViewer) {
        _viewer->setThreadingModel(threading);
        _viewer->setKeyEventSetsDone(0);
    }

    osgViewer::View& addView(osg::Node& scene, const osg::Matrixd& view, const osg::Matrixd& projection) {
        const osg::ref_ptr<osgViewer::View> added = new osgViewer::View;
        _viewer->addView(added.get());
        added->setLightingMode(osg::View::NO_LIGHT);
        setUp(*added->getCamera());
        added->getCamera()->setViewMatrix(view);
        added->getCamera()->setProjectionMatrix(projection);
        added->setSceneData(&scene);
        return *added;
    }

    void addSlave(osgViewer::View& view, const osg::Matrixd& projectionOffset, const osg::Matrixd& viewOffset) {
        const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
        setUp(*camera);
        view.addSlave(camera.get(), projectionOffset, viewOffset);
    }

    Pictures draw() {
        _viewer->realize();
        for (unsigned int frame = 0; frame < kFrames; ++frame) _viewer->frame();
        _viewer->stopThreading();
        countTiles();
        Pictures pictures;
        for (const auto& reader : _readers) pictures.push_back(reader->image);
        return pictures;
    }

    unsigned int outside = 0;

private:
    void setUp(osg::Camera& camera) {
        camera.setGraphicsContext(makeContext(kSize, kSize));
        camera.setViewport(0, 0, kSize, kSize);
        camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera.setClearColor(osg::Vec4(0, 0, 0, 1));
        _readers.push_back(new Reader);
        camera.setFinalDrawCallback(_readers.back().get());
    }

    void countTiles() {
        osgViewer::ViewerBase::Cameras cameras;
        _viewer->getCameras(cameras);
        for (osg::Camera* camera : cameras) {
            auto* renderer = dynamic_cast<osgViewer::Renderer*>(camera->getRenderer());
            for (unsigned int i = 0; renderer && i < 2; ++i) {
                osgUtil::CullVisitor* visitor = renderer->getSceneView(i)->getCullVisitor();
                const BinStatistics* statistics = visitor ? BinStatistics::find(*visitor) : nullptr;
                if (statistics) outside += statistics->getCounts().outside;
            }
        }
    }

    osg::ref_ptr<osgViewer::CompositeViewer> _viewer;
    std::vector<osg::ref_ptr<Reader>> _readers;
};

std::size_t differingPixels(const osg::Image& a, const osg::Image& b) {
    if (!a.valid() || a.getTotalSizeInBytes() != b.getTotalSizeInBytes()) return ~std::size_t{0};
    std::size_t count = 0;
    for (unsigned int i = 0; i < a.getTotalSizeInBytes(); i += 4) {
        if (std::memcmp(a.data() + i, b.data() + i, 4) != 0) ++count;
    }
    return count;
}

// Pixels that are not black.
std::size_t coveredPixels(const osg::Image& image) {
    std::size_t count = 0;
    for (unsigned int i = 0; i < image.getTotalSizeInBytes(); i += 4) {
        if (image.data()[i] != 0 || image.data()[i + 1] != 0 || image.data()[i + 2] != 0) ++count;
    }
    return count;
}

osg::Matrixd lookAt(const osg::Vec3d& eye, const osg::Vec3d& center, const osg::Vec3d& up) {
    return osg::Matrixd::lookAt(eye, center, up);
}

// Two views of one globe, the first with two slaves beside it.
Pictures drawViews(Threading threading, Method method, unsigned int& outside, bool stereo = false) {
    const osg::ref_ptr<osg::Group> globe = makeTiles(test::startTiles(), 9, optionsOf(method));
    // threads of osgViewer may or may not light the first frames of slaves
    globe->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    Gallery gallery(threading);
    osgViewer::View& first =
        gallery.addView(*globe, lookAt({kEarthRadius + 4e6, 1e6, 0}, {kEarthRadius, 3e6, 2e6}, {0, 0, 1}),
                        osg::Matrixd::perspective(50.0, 1.0, 1e5, 3e7));
    gallery.addSlave(first, osg::Matrixd::translate(0.9, 0.0, 0.0), osg::Matrixd());
    gallery.addSlave(first, osg::Matrixd::scale(0.7, 1.3, 1.0), osg::Matrixd::rotate(-0.3, 0.0, 1.0, 0.2));
    gallery.addView(*globe, lookAt({-1e7, 2e6, 3e7}, {0, 0, 0}, {0, 1, 0}),
                    osg::Matrixd::ortho(-3e6, 7e6, -5e6, 5e6, 1e6, 6e7));
    if (stereo) {
        const osg::ref_ptr<osg::DisplaySettings> settings = new osg::DisplaySettings;
        settings->setStereo(true);
        settings->setStereoMode(osg::DisplaySettings::HORIZONTAL_SPLIT);
        settings->setEyeSeparation(0.3f);
        first.setFusionDistance(osgUtil::SceneView::USE_FUSION_DISTANCE_VALUE, 5e5f);
        first.setDisplaySettings(settings.get());
    }
    Pictures pictures = gallery.draw();
    outside = gallery.outside;
    return pictures;
}

bool canDraw() {
    const osg::ref_ptr<osg::GraphicsContext> context = makeContext(16, 16);
    return context && context->realize();
}

class Viewers : public testing::TestWithParam<Threading> {};

TEST_P(Viewers, DrawTheSamePicturesAsWithoutCulling) {
    if (!canDraw()) GTEST_SKIP() << "no graphics context";
    unsigned int outside = 0;
    unsigned int none = 0;
    const Pictures truth = drawViews(GetParam(), Method::None, none);
    const Pictures bins = drawViews(GetParam(), Method::Quadratic, outside);
    ASSERT_EQ(truth.size(), 4u);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_EQ(differingPixels(*bins[i], *truth[i]), 0u) << "camera " << i;
        EXPECT_GT(coveredPixels(*truth[i]), std::size_t{kSize * kSize / 10}) << "camera " << i;
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(differingPixels(*truth[i], *truth[k]), 100u);
    }
    EXPECT_EQ(none, 0u);
    EXPECT_GT(outside, 200u);
}

INSTANTIATE_TEST_SUITE_P(ThreadingModels, Viewers,
                         testing::Values(Threading::SingleThreaded, Threading::CullDrawThreadPerContext,
                                         Threading::DrawThreadPerContext,
                                         Threading::CullThreadPerCameraDrawThreadPerContext));

TEST(ViewersInStereo, DrawTheSamePicturesAsWithoutCulling) {
    if (!canDraw()) GTEST_SKIP() << "no graphics context";
    unsigned int count = 0;
    const Pictures flat = drawViews(Threading::SingleThreaded, Method::Quadratic, count);
    const Pictures truth = drawViews(Threading::SingleThreaded, Method::None, count, true);
    const Pictures bins = drawViews(Threading::SingleThreaded, Method::Quadratic, count, true);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_EQ(differingPixels(*bins[i], *truth[i]), 0u) << "camera " << i;
    }
    EXPECT_GT(differingPixels(*flat[0], *truth[0]), 1000u);
}

std::vector<AnalyticBin> region() {
    std::vector<AnalyticBin> tiles;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 12; ++x) {
            tiles.emplace_back(
                core::GeodeticBin::fromDegrees({40.0 + y, 41.0 + y}, {-6.0 + x, -5.0 + x}, {0.0, 8000.0}));
        }
    }
    return tiles;
}

osg::Vec3d onEarth(double latitude, double longitude, double altitude) {
    osg::Vec3d p;
    osg::EllipsoidModel().convertLatLongHeightToXYZ(osg::DegreesToRadians(latitude), osg::DegreesToRadians(longitude),
                                                    altitude, p.x(), p.y(), p.z());
    return p;
}

// With a fit that does not follow what is kept, so that pictures can be compared.
class StillShadowMap : public osgShadow::ViewDependentShadowMap {
public:
    void cullShadowCastingScene(osgUtil::CullVisitor* visitor, osg::Camera* camera) const override {
        camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        ViewDependentShadowMap::cullShadowCastingScene(visitor, camera);
    }
};

// Mountains in the light of a low sun, with casters on all sides of the picture.
osg::ref_ptr<osg::Image> drawMountains(Method method, bool shadows, unsigned int& outside) {
    const osg::ref_ptr<osg::Group> tiles = makeTiles(region(), 17, optionsOf(method));
    const osg::ref_ptr<osgShadow::ViewDependentShadowMap> technique = shadows ? new StillShadowMap : nullptr;
    const osg::ref_ptr<osgShadow::ShadowedScene> scene = new osgShadow::ShadowedScene(technique.get());
    scene->getShadowSettings()->setShadowMapProjectionHint(osgShadow::ShadowSettings::ORTHOGRAPHIC_SHADOW_MAP);
    scene->getShadowSettings()->setComputeNearFarModeOverride(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    const osg::Vec3d ground = onEarth(46.0, 0.0, 0.0);
    osg::Vec3d up = ground;
    up.normalize();
    osg::Vec3d toLight = osg::Vec3d(0, 1, 0) + up * 0.15;
    toLight.normalize();
    const osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
    sun->getLight()->setPosition(osg::Vec4(osg::Vec3(toLight), 0.0f));
    sun->getLight()->setDiffuse(osg::Vec4(1, 1, 1, 1));
    scene->addChild(sun);
    scene->addChild(tiles);
    Gallery gallery(Threading::SingleThreaded);
    osgViewer::View& view = gallery.addView(*scene, lookAt(onEarth(43.0, 0.0, 6e4), ground, {0, 0, 1}),
                                            osg::Matrixd::perspective(30.0, 1.0, 2e4, 1.2e6));
    view.getCamera()->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    const Pictures pictures = gallery.draw();
    outside = gallery.outside;
    return pictures.at(0);
}

TEST(ViewersWithShadows, CastersOutsideOfThePictureStillCast) {
    if (!canDraw()) GTEST_SKIP() << "no graphics context";
    unsigned int outside = 0;
    const osg::ref_ptr<osg::Image> bins = drawMountains(Method::Quadratic, true, outside);
    EXPECT_GT(outside, 50u);
    const osg::ref_ptr<osg::Image> truth = drawMountains(Method::None, true, outside);
    const osg::ref_ptr<osg::Image> bright = drawMountains(Method::None, false, outside);
    EXPECT_EQ(differingPixels(*bins, *truth), 0u);
    EXPECT_GT(coveredPixels(*truth), std::size_t{kSize * kSize / 4});
    EXPECT_GT(differingPixels(*truth, *bright), std::size_t{kSize * kSize / 20});  // there are shadows
}

}  // namespace
}  // namespace osgAnalyticBin
