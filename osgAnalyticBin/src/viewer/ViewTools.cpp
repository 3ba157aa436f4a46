// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewTools.h"

#include <osgAnalyticBin/TileFinder.h>

#include <osgGA/GUIActionAdapter>
#include <osgGA/GUIEventAdapter>
#include <osgViewer/View>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

class GlobeFinder : public osg::NodeVisitor {
public:
    GlobeFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override {
        if (!found) traverse(node);
    }
    void apply(osg::CoordinateSystemNode& node) override {
        if (!found && node.getEllipsoidModel() && hasValidRadii(*node.getEllipsoidModel())) {
            found = SceneGlobe{node.getEllipsoidModel(), osg::computeLocalToWorld(getNodePath())};
        }
        apply(static_cast<osg::Node&>(node));
    }

    std::optional<SceneGlobe> found;
};

class BoundsComputer : public osg::NodeVisitor {
public:
    BoundsComputer() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }

    void apply(osg::Node& node) override {
        traverse(node);
        (void)node.getBound();
    }
};

bool draws(osg::Camera& camera) {
    const CameraCulling* culling = CameraCulling::find(camera);
    return camera.getGraphicsContext() && camera.getViewport() && !(culling && culling->isFollowing());
}

}  // namespace

void computeBounds(osg::Node& node) {
    BoundsComputer computer;
    node.accept(computer);
}

osgViewer::View* viewOf(osgGA::GUIActionAdapter& action) {
    return dynamic_cast<osgViewer::View*>(action.asView());
}

bool isTaken(const osgGA::GUIEventAdapter& event) {
    return event.getHandled() && event.getEventType() != osgGA::GUIEventAdapter::FRAME;
}

std::vector<osg::Camera*> drawingCameras(osgViewer::View& view) {
    std::vector<osg::Camera*> cameras;
    if (draws(*view.getCamera())) cameras.push_back(view.getCamera());
    for (unsigned int i = 0; i < view.getNumSlaves(); ++i) {
        const osg::View::Slave& slave = view.getSlave(i);
        if (slave._useMastersSceneData && slave._camera && draws(*slave._camera)) cameras.push_back(slave._camera);
    }
    return cameras;
}

std::optional<SceneGlobe> globeOf(osg::Node& scene) {
    GlobeFinder finder;
    scene.accept(finder);
    return finder.found;
}

std::optional<osg::Vec3d> SceneGlobe::intersection(const osg::Vec3d& eye, const osg::Vec3d& direction) const {
    const osg::Matrixd toGlobe = osg::Matrixd::inverse(toWorld);
    const double a = ellipsoid->getRadiusEquator();
    const double b = ellipsoid->getRadiusPolar();
    const auto toUnit = [&](const osg::Vec3d& v) { return osg::Vec3d(v.x() / a, v.y() / a, v.z() / b); };
    const osg::Vec3d start = toUnit(eye * toGlobe);
    const osg::Vec3d along = toUnit(osg::Matrixd::transform3x3(direction, toGlobe));
    const double half = start * along;
    const double discriminant = half * half - along.length2() * (start.length2() - 1.0);
    if (!(discriminant >= 0.0)) return std::nullopt;
    const double distance = (-half - std::sqrt(discriminant)) / along.length2();
    if (!(distance > 0.0)) return std::nullopt;
    return eye + direction * distance;
}

osg::Vec3d SceneGlobe::vertical(const osg::Vec3d& position) const {
    const osg::Vec3d ecef = position * osg::Matrixd::inverse(toWorld);
    osg::Vec3d up = osg::Matrixd::transform3x3(ellipsoid->computeLocalUpVector(ecef.x(), ecef.y(), ecef.z()), toWorld);
    up.normalize();
    return up;
}

double SceneGlobe::altitude(const osg::Vec3d& position) const {
    const osg::Vec3d ecef = position * osg::Matrixd::inverse(toWorld);
    double latitude = 0.0;
    double longitude = 0.0;
    double altitude = 0.0;
    ellipsoid->convertXYZToLatLongHeight(ecef.x(), ecef.y(), ecef.z(), latitude, longitude, altitude);
    return altitude;
}

}  // namespace osgAnalyticBin
