// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraGlobe.h"

#include <osgAnalyticBin/Declarations.h>

#include <osg/Viewport>

#include <iterator>
#include <support/View.h>

namespace osgAnalyticBin::test {

namespace {

constexpr int kSamplesAcross = 9;

std::string innermostCamera(const osg::NodePath& path) {
    for (auto node = path.rbegin(); node != path.rend(); ++node)
        if ((*node)->asCamera()) return (*node)->getName();
    return {};
}

RealVector real(const osg::Vec3d& v) {
    return {Real{v.x()}, Real{v.y()}, Real{v.z()}};
}

}  // namespace

osg::Vec3d randomEyeAbove(Random& random, double lowest) {
    return osgVector(random.direction()) * (kEarthRadius + random.logUniform(lowest, 2e7));
}

osg::Matrixd randomViewMatrix(Random& random, double lowest) {
    const osg::Vec3d eye = randomEyeAbove(random, lowest);
    return osg::Matrixd::lookAt(eye, osgVector(random.direction()) * kEarthRadius, osgVector(random.direction()));
}

CameraGlobe::CameraGlobe(const CullOptions& options, const std::vector<AnalyticBin>& tiles) {
    _root->setCullCallback(new Before([this](osgUtil::CullVisitor& visitor) {
        const std::lock_guard lock(_mutex);
        _looks.push_back({innermostCamera(visitor.getNodePath()),
                          &visitor,
                          *visitor.getModelViewMatrix(),
                          *visitor.getProjectionMatrix(),
                          {}});
    }));
    const osg::EllipsoidModel wgs84;
    for (const AnalyticBin& bin : tiles) {
        const osg::ref_ptr<Before> reached = new Before([this, number = _tiles.size()](osgUtil::CullVisitor& visitor) {
            const std::lock_guard lock(_mutex);
            const auto look = std::find_if(_looks.rbegin(), _looks.rend(),
                                           [&](const Look& candidate) { return candidate.visitor == &visitor; });
            look->reached.insert(number);
        });
        setTraversesAlways(*reached);
        osg::ref_ptr<osg::Group> tile = new osg::Group;
        osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback(bin, wgs84, options);
        callback->setNestedCallback(reached);
        tile->setCullCallback(callback.get());
        tile->setCullingActive(false);
        _root->addChild(tile);
        _tiles.push_back(tile);
        _samples.push_back(samples(bin, kSamplesAcross));
    }
}

std::vector<Look> CameraGlobe::takeLooks() {
    const std::lock_guard lock(_mutex);
    return std::exchange(_looks, {});
}

namespace {

// What a look does to samples.
struct Sight {
    osg::Matrixd toClip;
    osg::Matrixd back;  // from clip space; where sight begins at the eye, from eye space
    NearPlane nearPlane;
    std::optional<double> occluderDepth;
};

bool isSeen(const osg::Vec3d& sample, const Sight& sight) {
    const osg::Vec4d clip = osg::Vec4d(sample, 1.0) * sight.toClip;
    const double w = clip.w();
    if (!(std::abs(clip.x()) <= w && std::abs(clip.y()) <= w)) return false;
    const bool fromEye = sight.nearPlane == NearPlane::AtTheEye;
    if (!fromEye && !(std::abs(clip.z()) <= w)) return false;
    if (!sight.occluderDepth) return true;
    const double start = sight.nearPlane == NearPlane::AtPlusOne ? 1.0 : -1.0;
    const osg::Vec3d end = (fromEye ? osg::Vec3d() : osg::Vec3d(clip.x() / w, clip.y() / w, start)) * sight.back;
    return segmentMissesOccluder(earth(), *sight.occluderDepth, real(sample), real(end));
}

}  // namespace

std::set<std::size_t> CameraGlobe::seen(const Look& look, NearPlane nearPlane,
                                        std::optional<double> occluderDepth) const {
    const osg::Matrixd toClip = look.modelView * look.projection;
    const bool fromEye = nearPlane == NearPlane::AtTheEye;
    const Sight sight{toClip, osg::Matrixd::inverse(fromEye ? look.modelView : toClip), nearPlane, occluderDepth};
    std::set<std::size_t> tiles;
    for (std::size_t i = 0; i < _tiles.size(); ++i)
        if (std::any_of(_samples[i].begin(), _samples[i].end(),
                        [&](const osg::Vec3d& sample) { return isSeen(sample, sight); }))
            tiles.insert(i);
    return tiles;
}

std::vector<std::size_t> LookTotals::add(const CameraGlobe& globe, const Look& look, NearPlane nearPlane,
                                         std::optional<double> occluderDepth) {
    const std::set<std::size_t> visible = globe.seen(look, nearPlane, occluderDepth);
    tiles += globe.size();
    reached += look.reached.size();
    seen += visible.size();
    std::vector<std::size_t> missing;
    std::set_difference(visible.begin(), visible.end(), look.reached.begin(), look.reached.end(),
                        std::back_inserter(missing));
    return missing;
}

CullOptions horizonOptions(Method method) {
    CullOptions options;
    options.method = method;
    options.horizonUse = HorizonUse::Given;
    options.horizon = -kOccluderDepth;
    return options;
}

osg::ref_ptr<osg::Camera> makeCamera(const std::string& name, CameraGlobe& globe, osg::Transform::ReferenceFrame frame,
                                     osg::Camera::RenderOrder order, const osg::Matrixd& view,
                                     const osg::Matrixd& projection) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setName(name);
    camera->setReferenceFrame(frame);
    camera->setRenderOrder(order);
    camera->setViewMatrix(view);
    camera->setProjectionMatrix(projection);
    if (order != osg::Camera::NESTED_RENDER) camera->setViewport(0, 0, 256, 256);
    camera->addChild(&globe.root());
    return camera;
}

}  // namespace osgAnalyticBin::test
