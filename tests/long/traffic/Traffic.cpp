// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Models about the poses of camera paths over a database: how many have a pixel, how many are drawn, how long a frame
// takes. Exit code: 1 where a model that has a pixel is left out, or a picture differs.

#include "Traffic.h"

#include "BenchViewer.h"
#include "CameraView.h"

#include <osg/Material>
#include <osgDB/ReadFile>

#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

using namespace osgAnalyticBin;

namespace {

constexpr double kReach = 30e3;  // metres
constexpr int kTimed = 5;        // frames
constexpr int kWidth = 960, kHeight = 540;
constexpr unsigned int kModels = 2000;
constexpr const char* kUsage =
    "osganalyticbin_traffic DATABASE PATH.csv ...\n"
    "Needs a display. Columns: models in view by their spheres; with a pixel; drawn; milliseconds of a frame without "
    "and\n"
    "with the question for terrain, and their ratio.\n";

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
    explicit Bench(const std::string& database)
        : _database(osgDB::readRefNodeFile(database)),
          _traffic(kModels),
          _viewer(kWidth, kHeight, osgViewer::ViewerBase::SingleThreaded) {
        if (!_database) throw std::runtime_error(database + " cannot be read");
        _scene->addChild(_database);
        _scene->addChild(&_traffic.models());
        _camera->setViewport(0, 0, kWidth, kHeight);
        _viewer.show(*_scene, _camera->getCullingMode());
    }

    // Returns: whether all that has a pixel is drawn.
    bool measure(const flight::CameraPose& pose) {
        flight::placeCamera(*_camera, pose, flight::globeOf(*_database));
        _viewer.setView(*_camera);
        drawUntilIdle();
        _traffic.scatter(*_database, osg::Vec3d() * _camera->getInverseViewMatrix(), kReach);
        const Picture without = look(false), with = look(true);
        std::size_t lost = 0;
        for (const unsigned int model : without.models) lost += with.models.count(model) == 0;
        const bool isSame = bench::differingPixels(*without.image, *with.image) == 0;
        std::printf("%-14s %6u %6zu %6u %8.1f %8.1f %6.2f", pose.name.c_str(), without.drawn, without.models.size(),
                    with.drawn, without.milliseconds, with.milliseconds, with.milliseconds / without.milliseconds);
        if (lost > 0) std::printf("  %zu models lost", lost);
        if (!isSame) std::printf("  pictures differ");
        std::printf("\n");
        std::fflush(stdout);
        _inView += without.drawn, _withPixel += without.models.size(), _drawn += with.drawn;
        _timeWithout += without.milliseconds, _timeWith += with.milliseconds;
        return lost == 0 && isSame;
    }

    void printSum() const {
        std::printf("%-14s %6zu %6zu %6zu %8.1f %8.1f %6.2f\n", "sum", _inView, _withPixel, _drawn, _timeWithout,
                    _timeWith, _timeWith / _timeWithout);
    }

private:
    struct Picture {
        unsigned int drawn = 0;
        std::set<unsigned int> models;
        double milliseconds = 0.0;
        osg::ref_ptr<osg::Image> image;
    };

    // What hides is prepared in updates after all is there.
    void drawUntilIdle() {
        constexpr int kIdleFrames = 20;
        constexpr double kLongest = 60.0;  // seconds
        for (int idle = 0; idle < kIdleFrames; ++idle) (void)_viewer.drawUntilLoaded(kLongest);
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

    static std::set<unsigned int> modelsIn(const osg::Image& image) {
        std::set<unsigned int> models;
        for (unsigned int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
            const unsigned char* const p = image.data(pixel % kWidth, pixel / kWidth);
            const unsigned int model = p[0] << 16U | p[1] << 8U | p[2];
            if (model > 0 && model <= kModels) models.insert(model);
        }
        return models;
    }

    Picture look(bool asks) {
        _traffic.setAsking(asks);
        drawUntilIdle();
        Picture picture;
        _viewer.startTimes();
        for (int i = 0; i < kTimed; ++i) {
            (void)_traffic.takeDrawn();
            _viewer.timeFrame();
            picture.drawn = _traffic.takeDrawn();
        }
        for (const bench::FrameTimes& times : _viewer.takeTimes()) picture.milliseconds += times.frameMs / kTimed;
        setPainted(true);
        picture.image = _viewer.pictureOf(*_scene, *_camera, _camera->getCullingMode());
        picture.models = modelsIn(*picture.image);
        setPainted(false);
        return picture;
    }

    osg::ref_ptr<osg::Node> _database;
    const osg::ref_ptr<osg::Group> _scene = new osg::Group;
    const osg::ref_ptr<osg::Camera> _camera = new osg::Camera;
    viewer::Traffic _traffic;
    bench::BenchViewer _viewer;
    std::size_t _inView = 0, _withPixel = 0, _drawn = 0;
    double _timeWithout = 0.0, _timeWith = 0.0;
};

int run(std::vector<std::string> files) {
    if (files.size() < 2) return std::fputs(kUsage, stderr), 2;
    Bench bench(files.front());
    files.erase(files.begin());
    const auto path = flight::readCameraPathFiles(files);
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
