// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Models about the poses of camera paths over a database: how many have a pixel, how many are drawn, how long a frame
// takes. Exit code: 1 where a model that has a pixel is left out, or a picture differs.

#include "Traffic.h"

#include "CameraView.h"
#include "FrameCapture.h"
#include "WithoutAnisotropy.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/Geode>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/Timer>
#include <osgDB/DatabasePager>
#include <osgDB/ReadFile>
#include <osgViewer/Viewer>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace osgAnalyticBin;

namespace {

constexpr double kReach = 30e3;  // metres
constexpr int kTimed = 5;        // frames
constexpr const char* kUsage =
    "osganalyticbin_traffic DATABASE PATH.csv ... [--models N] [--size WIDTHxHEIGHT] [--compute-near]\n"
    "Needs a display. Columns: models in view by their spheres; with a pixel; drawn; milliseconds of a frame without "
    "and "
    "with\nthe question for terrain, and their ratio. --compute-near: OSG computes near and far planes.\n";

// Everything in one colour, whatever its lights and textures.
void paint(osg::Node& node, unsigned int colour) {
    osg::StateSet& states = *node.getOrCreateStateSet();
    const auto kAll = osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    const auto part = [&](unsigned int shift) { return static_cast<float>((colour >> shift) & 255U) / 255.0f; };
    const osg::Vec4 black(0.0f, 0.0f, 0.0f, 1.0f);
    material->setColorMode(osg::Material::OFF);
    for (const auto set : {&osg::Material::setAmbient, &osg::Material::setDiffuse, &osg::Material::setSpecular})
        ((*material).*set)(osg::Material::FRONT_AND_BACK, black);
    material->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(part(16), part(8), part(0), 1.0f));
    states.setAttributeAndModes(material, osg::StateAttribute::ON | kAll);
    states.setMode(GL_LIGHTING, osg::StateAttribute::ON | kAll);
    states.setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF | kAll);
}

class Bench {
public:
    Bench(const std::string& database, unsigned int models, int width, int height, bool computesNear)
        : _traffic(models), _computesNear(computesNear) {
        _database = osgDB::readRefNodeFile(database);
        if (!_database) throw std::runtime_error(database + " cannot be read");
        _scene->addChild(_database);
        _scene->addChild(&_traffic.models());
        _viewer.setSceneData(_scene);
        _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        _viewer.setUpViewInWindow(0, 0, width, height);
        _viewer.getCamera()->setClearColor(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
        _viewer.setRealizeOperation(new flight::WithoutAnisotropy);
        flight::makeComparable(*_viewer.getCamera());
        _viewer.getCamera()->addFinalDrawCallback(_capture);
        _viewer.realize();
        if (!_viewer.isRealized()) throw std::runtime_error("no window can be opened");
    }

    // Returns: whether all that has a pixel is drawn.
    bool measure(const flight::CameraPose& given) {
        flight::CameraPose pose = given;
        if (_computesNear) pose.nearPlane = pose.farPlane = 0.0;
        osg::Camera& camera = *_viewer.getCamera();
        const flight::Globe globe = flight::globeOf(*_database);
        if (_computesNear) camera.setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
        flight::placeCamera(camera, pose, globe);
        drawUntilIdle();
        _traffic.scatter(*_database, osg::Vec3d() * camera.getInverseViewMatrix(), kReach);
        const Picture without = look(false), with = look(true);
        std::size_t lost = 0;
        for (const unsigned int model : without.models) lost += with.models.count(model) == 0;
        const bool isSame =
            std::memcmp(without.image->data(), with.image->data(), without.image->getTotalSizeInBytes()) == 0;
        const std::size_t spheres = countSpheres();
        std::printf("%-14s %6u %6zu %6zu %6u %8.1f %8.1f %6.2f", pose.name.c_str(), without.drawn,
                    without.models.size(), spheres, with.drawn, without.milliseconds, with.milliseconds,
                    with.milliseconds / without.milliseconds);
        if (lost > 0) std::printf("  %zu models lost", lost);
        if (!isSame) std::printf("  pictures differ");
        std::printf("\n");
        std::fflush(stdout);
        _inView += without.drawn, _withPixel += without.models.size(), _spheres += spheres, _drawn += with.drawn;
        _timeWithout += without.milliseconds, _timeWith += with.milliseconds;
        return lost == 0 && (isSame || _computesNear);
    }

    void printSum() const {
        std::printf("%-14s %6zu %6zu %6zu %6zu %8.1f %8.1f %6.2f\n", "sum", _inView, _withPixel, _spheres, _drawn,
                    _timeWithout, _timeWith, _timeWith / _timeWithout);
    }

private:
    struct Picture {
        unsigned int drawn = 0;
        std::set<unsigned int> models;
        double milliseconds = 0.0;
        osg::ref_ptr<osg::Image> image;
    };

    void drawUntilIdle() {
        constexpr int kIdleFrames = 20;
        for (int idle = 0; idle < kIdleFrames;) {
            _viewer.frame();
            const osgDB::DatabasePager& pager = *_viewer.getDatabasePager();
            idle = pager.getRequestsInProgress() || pager.requiresUpdateSceneGraph() ? 0 : idle + 1;
        }
    }

    osg::ref_ptr<osg::Image> drawOnce() {
        _capture->request(_viewer.getFrameStamp()->getFrameNumber() + 1);
        _viewer.frame();
        return _capture->take();
    }

    void setPainted(bool isPainted) {
        const auto set = [&](osg::Node& node, unsigned int colour) {
            node.setStateSet(nullptr);
            if (isPainted) paint(node, colour);
        };
        set(*_database, 0);
        for (unsigned int i = 0; i < _traffic.models().getNumChildren(); ++i)
            set(*_traffic.models().getChild(i), i + 1);
    }

    static std::set<unsigned int> modelsIn(const osg::Image* image) {
        if (!image) throw std::runtime_error("a picture was never drawn");
        std::set<unsigned int> models;
        for (int row = 0; row < image->t(); ++row) {
            for (int column = 0; column < image->s(); ++column) {
                const unsigned char* const p =
                    image->data(static_cast<unsigned int>(column), static_cast<unsigned int>(row));
                const unsigned int model = p[0] << 16U | p[1] << 8U | p[2];
                if (model > 0) models.insert(model);
            }
        }
        return models;
    }

    // How many models would have a pixel if they filled their spheres.
    std::size_t countSpheres() {
        const osg::ref_ptr<osg::Geode> ball = new osg::Geode;
        osg::Group& models = _traffic.models();
        if (models.getNumChildren() == 0) return 0;
        const osg::BoundingSphere bound = models.getChild(0)->asGroup()->getChild(0)->getBound();
        ball->addDrawable(new osg::ShapeDrawable(new osg::Sphere(bound.center(), bound.radius())));
        _traffic.setAsking(false);
        for (unsigned int i = 0; i < models.getNumChildren(); ++i) models.getChild(i)->asGroup()->addChild(ball);
        setPainted(true);
        // the sphere about a ball's box is larger
        osg::Camera& camera = *_viewer.getCamera();
        const float smallest = camera.getSmallFeatureCullingPixelSize();
        camera.setSmallFeatureCullingPixelSize(smallest * std::sqrt(3.0f));
        (void)drawOnce();
        const osg::ref_ptr<osg::Image> image = drawOnce();
        camera.setSmallFeatureCullingPixelSize(smallest);
        setPainted(false);
        for (unsigned int i = 0; i < models.getNumChildren(); ++i) models.getChild(i)->asGroup()->removeChild(ball);
        return modelsIn(image.get()).size();
    }

    Picture look(bool asks) {
        _traffic.setAsking(asks);
        drawUntilIdle();
        Picture picture;
        (void)drawOnce();
        const osg::Timer_t begin = osg::Timer::instance()->tick();
        // reading a picture back waits for it
        for (int i = 0; i < kTimed; ++i) (void)drawOnce();
        picture.milliseconds = osg::Timer::instance()->delta_m(begin, osg::Timer::instance()->tick()) / kTimed;
        setPainted(true);
        (void)_traffic.takeDrawn();
        picture.image = drawOnce();
        picture.drawn = _traffic.takeDrawn();
        picture.models = modelsIn(picture.image.get());
        setPainted(false);
        return picture;
    }

    osg::ref_ptr<osg::Node> _database;
    const osg::ref_ptr<osg::Group> _scene = new osg::Group;
    viewer::Traffic _traffic;
    const bool _computesNear;
    osgViewer::Viewer _viewer;
    const osg::ref_ptr<flight::FrameCapture> _capture = new flight::FrameCapture;
    std::size_t _inView = 0, _withPixel = 0, _spheres = 0, _drawn = 0;
    double _timeWithout = 0.0, _timeWith = 0.0;
};

int run(const std::vector<std::string>& words) {
    std::vector<std::string> files;
    unsigned int models = 2000;
    int width = 960, height = 540;
    bool computesNear = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--compute-near")
            computesNear = true;
        else if (words[i] == "--models" && i + 1 < words.size())
            models = static_cast<unsigned int>(std::strtoul(words[++i].c_str(), nullptr, 10));
        else if (words[i] == "--size" && i + 1 < words.size())
            std::sscanf(words[++i].c_str(), "%dx%d", &width, &height);
        else
            files.push_back(words[i]);
    }
    if (files.size() < 2) return std::fputs(kUsage, stderr), 2;
    const std::string database = files.front();
    files.erase(files.begin());
    const auto path = flight::readCameraPathFiles(files);
    Bench bench(database, models, width, height, computesNear);
    bool isRight = true;
    for (const flight::CameraPose& pose : path) isRight = bench.measure(pose) && isRight;
    bench.printSum();
    return isRight ? 0 : 1;
}

}  // namespace

int main(int count, char** values) {
    try {
        return run({values + 1, values + count});
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "osganalyticbin_traffic: %s\n", failure.what());
        return 1;
    }
}
