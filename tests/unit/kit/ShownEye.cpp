// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShownEye.h"

#include "../../../osgAnalyticBin/src/kit/cull/CullTraversal.h"
#include "../../../osgAnalyticBin/src/kit/cull/ShownDepth.h"
#include "CameraGlobe.h"

#include <glm/geometric.hpp>
#include <osg/Math>

#include <cmath>

namespace osgAnalyticBin::test {

namespace {

core::PlaneSet planesOf(osg::CullStack& cullStack) {
    core::PlaneSet planes;
    for (const osg::Plane& plane : cullStack.getCurrentCullingSet().getFrustum().getPlaneList()) {
        planes.push_back({{plane[0], plane[1], plane[2]}, plane[3]});
    }
    return planes;
}

// Asks for the eye in a real cull traversal.
class Asker : public osg::NodeCallback {
public:
    Asker(double startDepth, double deepest) : depth(startDepth), _deepest(deepest) {}

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        osg::CullStack& cullStack = *nv->asCullStack();
        const auto viewpoint = Viewpoint::of(cullStack, *nv, false);
        if (!viewpoint) return;
        TileSelection selection;
        const DatabaseView view{*node->asGroup(),
                                *nv,
                                CullTraversal::of(*nv),
                                cullStack,
                                cullStack.getModelViewMatrix(),
                                cullStack.getProjectionMatrix(),
                                planesOf(cullStack),
                                nullptr,
                                earth(),
                                {},
                                &selection,
                                &selection};
        const auto found = eyeAboveWhatIsShown(view, *viewpoint, _deepest, depth);
        if (found && found->isAboveGround) eye = found->horizon;
    }

    double depth;
    std::optional<core::HorizonEye> eye;

private:
    double _deepest;
};

}  // namespace

Picture::Picture(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& roll, double degrees)
    : eye(from), forward(glm::normalize(to - from)), fov(degrees) {
    right = glm::normalize(glm::cross(forward, roll));
    up = glm::cross(right, forward);
}

CullView Picture::view() const {
    return CullView::lookAt(osgVector(eye), osgVector(eye + forward * 1e6), osgVector(up), fov);
}

glm::dvec3 Picture::ray(double x, double y) const {
    const double reach = std::tan(fov * osg::PI / 360.0);
    return glm::normalize(forward + right * (x * reach) + up * (y * reach));
}

ShownEye askForEye(osg::Group& database, const Picture& picture, double startDepth, double deepest) {
    const osg::ref_ptr<Asker> asker = new Asker(startDepth, deepest);
    asker->setNestedCallback(database.getCullCallback());
    database.setCullCallback(asker);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    (void)cull(database, picture.view(), *visitor);
    database.setCullCallback(asker->getNestedCallback());
    return {asker->eye, asker->depth};
}

bool hidesPoint(const core::HorizonEye& eye, const glm::dvec3& point) {
    const core::Geodetic g = earth().toGeodetic(point);
    const core::GeodeticBin bin({g.latitude, g.latitude}, {g.longitude, g.longitude}, {g.altitude, g.altitude});
    return eye.hides(core::HorizonBin(earth(), bin));
}

double occluderDepth(const core::HorizonEye& eye, const glm::dvec3& from) {
    const glm::dvec3 toEye = glm::normalize(inUnitSpace(from));
    const glm::dvec3 side = glm::normalize(glm::cross(toEye, glm::dvec3(0.3, 0.5, 0.8)));
    const auto pointAt = [&](double angle) {
        return (toEye * std::cos(angle) + side * std::sin(angle)) *
               glm::dvec3(kEarthRadius, kEarthRadius, kPolarRadius);
    };
    double seen = 0.0;
    double hidden = osg::PI;
    for (int i = 0; i < 60; ++i) {
        const double angle = 0.5 * (seen + hidden);
        (hidesPoint(eye, pointAt(angle)) ? hidden : seen) = angle;
    }
    double shallow = 0.0;
    double deep = 1e6;
    for (int i = 0; i < 60; ++i) {
        const double depth = 0.5 * (shallow + deep);
        const auto other = core::HorizonEye::fromEye(earth(), depth, from);
        // an eye inside the occluder has to have a deeper one
        (!other || hidesPoint(*other, pointAt(hidden)) ? shallow : deep) = depth;
    }
    return shallow;
}

std::optional<double> entryIntoOccluder(const glm::dvec3& eye, const glm::dvec3& ray, double depth) {
    const double scale = 1.0 - depth / kPolarRadius;
    const glm::dvec3 e = inUnitSpace(eye) / scale;
    const glm::dvec3 v = inUnitSpace(ray) / scale;
    const double a = glm::dot(v, v);
    const double b = glm::dot(e, v);
    const double c = glm::dot(e, e) - 1.0;
    const double discriminant = b * b - a * c;
    if (discriminant <= 0.0 || b >= 0.0) return std::nullopt;
    return (-b - std::sqrt(discriminant)) / a;
}

glm::dvec3 inUnitSpace(const glm::dvec3& ecef) {
    return ecef / glm::dvec3(kEarthRadius, kEarthRadius, kPolarRadius);
}

}  // namespace osgAnalyticBin::test
