// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Traffic.h"

#include "CameraView.h"

#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/HiddenByTerrainCallback.h>

#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/NodeCallback>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osgDB/DatabasePager>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace osgAnalyticBin::viewer {

class Traffic::Counter : public osg::NodeCallback {
public:
    explicit Counter(Drawn& drawn) : _drawn(&drawn) { setTraversesAlways(*this); }
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        ++_drawn->models;
        traverse(node, nv);
    }

private:
    const osg::ref_ptr<Drawn> _drawn;
};

namespace {

constexpr double kHighestModel = 300.0;  // metres above ground
constexpr double kFarthest = 30e3;       // metres, of models about the camera
constexpr double kReach = 2e4;           // metres up and down, where ground is looked for

// An aircraft, some 30 m long, that flies to the north: a few hundred triangles.
osg::ref_ptr<osg::Geode> makeAircraft() {
    const osg::Vec4 kHull(0.95f, 0.95f, 0.98f, 1.0f), kWings(0.85f, 0.15f, 0.1f, 1.0f);
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    const auto add = [&](osg::Shape* shape, const osg::Vec4& colour) {
        const osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(shape);
        drawable->setColor(colour);
        geode->addDrawable(drawable);
    };
    const osg::ref_ptr<osg::Capsule> hull = new osg::Capsule(osg::Vec3(0.0f, 0.0f, 3.0f), 2.0f, 26.0f);
    hull->setRotation(osg::Quat(osg::PI_2, osg::Vec3d(1.0, 0.0, 0.0)));
    add(hull, kHull);
    add(new osg::Box(osg::Vec3(0.0f, 1.0f, 3.0f), 30.0f, 4.0f, 0.5f), kWings);
    add(new osg::Box(osg::Vec3(0.0f, -12.0f, 5.5f), 0.5f, 3.0f, 5.0f), kWings);
    return geode;
}

}  // namespace

Traffic::Traffic(unsigned int count) : _count(count) {}

void Traffic::scatter(osg::Node& scene, const osg::Vec3d& eye, double reach) {
    const flight::Globe globe = flight::globeOf(scene);
    const osg::ref_ptr<osg::Geode> aircraft = makeAircraft();
    _models->removeChildren(0, _models->getNumChildren());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const osg::Vec3d up = globe.vertical(globe.geodetic(eye));
    osg::Vec3d east = osg::Vec3d(0.0, 0.0, 1.0) ^ up;
    if (east.normalize() < 1e-6) east.set(1.0, 0.0, 0.0);
    const osg::Vec3d north = up ^ east;
    for (unsigned int i = 0; i < _count; ++i) {
        const double distance = reach * std::sqrt(share(random)), bearing = 2.0 * osg::PI * share(random);
        const double height = std::max(0.0, kHighestModel * (1.5 * share(random) - 0.5)),
                     heading = 2.0 * osg::PI * share(random);
        const osg::Vec3d place = eye + (east * std::sin(bearing) + north * std::cos(bearing)) * distance;
        core::Geodetic high = globe.geodetic(place), low = high;
        high.altitude = kReach;
        low.altitude = -kReach;
        const auto ground = flight::firstHit(scene, globe.toWorld(high), globe.toWorld(low));
        if (!ground) continue;
        const osg::Vec3d upThere = globe.vertical(high);
        osg::Matrixd turn = osg::Matrixd::rotate(heading, osg::Vec3d(0.0, 0.0, 1.0));
        turn.postMult(osg::Matrixd::rotate(osg::Vec3d(0.0, 0.0, 1.0), upThere));
        turn.postMultTranslate(*ground + upThere * height);
        const osg::ref_ptr<osg::MatrixTransform> model = new osg::MatrixTransform(turn);
        model->addChild(aircraft);
        _models->addChild(model);
    }
    setAsking(_asks);
}

void Traffic::setAsking(bool asks) {
    _asks = asks;
    for (unsigned int i = 0; i < _models->getNumChildren(); ++i) {
        osg::Node& model = *_models->getChild(i);
        model.setCullCallback(nullptr);
        if (asks) model.addCullCallback(new HiddenByTerrainCallback);
        model.addCullCallback(new Counter(*_drawn));
    }
}

TrafficHandler::TrafficHandler(osg::Group& scene, unsigned int count) : _traffic(count) {
    scene.addChild(&_traffic.models());
    addKey('T', "Scatter the models of --traffic about the camera.", [this](osgViewer::View&) { _isDue = true; });
    addKey('G', "Let terrain hide the models of --traffic, or not.",
           [this](osgViewer::View&) { _traffic.setAsking(!_traffic.isAsking()); });
}

void TrafficHandler::draw(osgViewer::View& view, osg::Camera& camera) {
    const osgDB::DatabasePager* const pager = view.getDatabasePager();
    const bool isLoaded = !pager || !(pager->getRequestsInProgress() || pager->requiresUpdateSceneGraph());
    const unsigned int drawn = _traffic.takeDrawn();
    if (_isDue && isLoaded && view.getFrameStamp()->getFrameNumber() > 1) {
        _traffic.scatter(*view.getSceneData(), osg::Vec3d() * camera.getInverseViewMatrix(), kFarthest);
        _isDue = false;
        return;
    }
    const unsigned int models = _traffic.models().getNumChildren();
    const std::string text = std::to_string(drawn) + " of " + std::to_string(models) + " models drawn" +
                             (_traffic.isAsking() ? "" : ", whatever terrain hides");
    _panel->show(camera, {{text, osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f)}});
}

}  // namespace osgAnalyticBin::viewer
