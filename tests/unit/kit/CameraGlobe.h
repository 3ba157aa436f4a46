// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A globe that notes for every camera that is culled for what it looks through and which tiles it reaches, and truth
// about what a camera sees that shares nothing with the kit: samples, projected by the camera's own matrices.

#pragma once

#include "CullFixture.h"

#include <osgAnalyticBin/Declarations.h>

#include <mutex>
#include <support/View.h>

namespace osgAnalyticBin::test {

/// Metres, as OSG has WGS 84.
inline constexpr double kEarthRadius = 6378137.0;
inline constexpr double kPolarRadius = 6356752.3142;

[[nodiscard]] inline core::Ellipsoid earth() {
    return {kEarthRadius, kPolarRadius};
}

[[nodiscard]] inline osg::Vec3d osgVector(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

[[nodiscard]] inline RealVector realOf(const osg::Vec3d& v) {
    return {Real{v.x()}, Real{v.y()}, Real{v.z()}};
}

/// A point from `lowest` to 20000 km above a sphere of the earth's radius, in any direction.
[[nodiscard]] inline osg::Vec3d randomEyeAbove(Random& random, double lowest) {
    return osgVector(random.direction()) * (kEarthRadius + random.logUniform(lowest, 2e7));
}

/// A view matrix from such an eye to any point of that sphere, rolled at random.
[[nodiscard]] inline osg::Matrixd randomViewMatrix(Random& random, double lowest = 2e4) {
    const osg::Vec3d eye = randomEyeAbove(random, lowest);
    return osg::Matrixd::lookAt(eye, osgVector(random.direction()) * kEarthRadius, osgVector(random.direction()));
}

/// One traversal of the globe for one camera.
struct Look {
    std::string camera;  // name of the innermost one in the scene; empty: the view's own
    const osg::NodeVisitor* visitor = nullptr;
    osg::Matrixd modelView, projection;
    std::set<std::size_t> reached;
};

/// Where in clip space sight begins.
enum class NearPlane {
    AtMinusOne,  ///< as OpenGL has it
    AtPlusOne,   ///< reversed depth
    AtTheEye     ///< not known yet: near and far are computed from what is kept
};

/// What a look does to samples.
struct Sight {
    osg::Matrixd toClip;
    osg::Matrixd back;  // from clip space; where sight begins at the eye, from eye space
    NearPlane nearPlane;
    std::optional<double> occluderDepth;

    [[nodiscard]] bool isSeen(const osg::Vec3d& sample) const {
        const osg::Vec4d clip = osg::Vec4d(sample, 1.0) * toClip;
        const double w = clip.w();
        if (!(std::abs(clip.x()) <= w && std::abs(clip.y()) <= w)) return false;
        const bool fromEye = nearPlane == NearPlane::AtTheEye;
        if (!fromEye && !(std::abs(clip.z()) <= w)) return false;
        if (!occluderDepth) return true;
        const double start = nearPlane == NearPlane::AtPlusOne ? 1.0 : -1.0;
        const osg::Vec3d end = (fromEye ? osg::Vec3d() : osg::Vec3d(clip.x() / w, clip.y() / w, start)) * back;
        return segmentMissesOccluder(earth(), *occluderDepth, realOf(sample), realOf(end));
    }
};

/// Looks of a globe of 128 tiles with bins. Any number of threads may cull it.
class CameraGlobe {
public:
    explicit CameraGlobe(const CullOptions& options = {}, const std::vector<AnalyticBin>& tiles = startTiles()) {
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
            const osg::ref_ptr<Before> reached =
                new Before([this, number = _tiles.size()](osgUtil::CullVisitor& visitor) {
                    const std::lock_guard lock(_mutex);
                    const auto look = std::find_if(_looks.rbegin(), _looks.rend(), [&](const Look& candidate) {
                        return candidate.visitor == &visitor;
                    });
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
            _samples.push_back(samples(bin, 9));
        }
    }

    [[nodiscard]] osg::Group& root() { return *_root; }
    [[nodiscard]] std::size_t size() const { return _tiles.size(); }
    [[nodiscard]] const std::vector<osg::Vec3d>& samplesOf(std::size_t tile) const { return _samples[tile]; }

    /// Takes what has been noted since the last call.
    [[nodiscard]] std::vector<Look> takeLooks() {
        const std::lock_guard lock(_mutex);
        return std::exchange(_looks, {});
    }

    /// Tiles with a sample in the picture: inside in clip space and, where a depth of the occluder is given, with a
    /// line of sight to the near plane that misses it.
    [[nodiscard]] std::set<std::size_t> seen(const Look& look, NearPlane nearPlane = NearPlane::AtTheEye,
                                             std::optional<double> occluderDepth = std::nullopt) const {
        const osg::Matrixd toClip = look.modelView * look.projection;
        const bool fromEye = nearPlane == NearPlane::AtTheEye;
        const Sight sight{toClip, osg::Matrixd::inverse(fromEye ? look.modelView : toClip), nearPlane, occluderDepth};
        std::set<std::size_t> tiles;
        for (std::size_t i = 0; i < _tiles.size(); ++i)
            if (std::any_of(_samples[i].begin(), _samples[i].end(),
                            [&](const osg::Vec3d& sample) { return sight.isSeen(sample); }))
                tiles.insert(i);
        return tiles;
    }

private:
    static std::string innermostCamera(const osg::NodePath& path) {
        for (auto node = path.rbegin(); node != path.rend(); ++node)
            if ((*node)->asCamera()) return (*node)->getName();
        return {};
    }

    osg::ref_ptr<osg::Group> _root = new osg::Group;
    std::vector<osg::ref_ptr<osg::Group>> _tiles;
    std::vector<std::vector<osg::Vec3d>> _samples;
    std::mutex _mutex;
    std::vector<Look> _looks;
};

/// Sums over looks, for what is to hold on the whole.
struct LookTotals {
    std::size_t tiles = 0, reached = 0, seen = 0;

    /// Adds a look. Returns: the tiles that are seen and have not been reached: none, if the kit is right.
    std::vector<std::size_t> add(const CameraGlobe& globe, const Look& look, NearPlane nearPlane = NearPlane::AtTheEye,
                                 std::optional<double> occluderDepth = std::nullopt) {
        const std::set<std::size_t> visible = globe.seen(look, nearPlane, occluderDepth);
        tiles += globe.size();
        reached += look.reached.size();
        seen += visible.size();
        std::vector<std::size_t> missing;
        std::set_difference(visible.begin(), visible.end(), look.reached.begin(), look.reached.end(),
                            std::back_inserter(missing));
        return missing;
    }
};

/// The horizon, with the ground 1000 m below the ellipsoid.
inline constexpr double kOccluderDepth = 1000.0;
[[nodiscard]] inline CullOptions horizonOptions(Method method = Method::Quadratic) {
    CullOptions options = by(method);
    options.horizonUse = HorizonUse::Given;
    options.horizon = -kOccluderDepth;
    return options;
}

/// A camera in a scene with the globe below it.
[[nodiscard]] inline osg::ref_ptr<osg::Camera> makeCamera(const std::string& name, CameraGlobe& globe,
                                                          osg::Transform::ReferenceFrame frame,
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
