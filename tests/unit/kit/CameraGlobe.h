// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A globe that notes for every camera that is culled for what it looks through and which tiles it reaches, and truth
// about what a camera sees that shares nothing with the kit: samples, projected by the camera's own matrices.

#pragma once

#include "CullFixture.h"

#include <mutex>
#include <support/Random.h>

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

/// A point from `lowest` to 20000 km above a sphere of the earth's radius, in any direction.
[[nodiscard]] osg::Vec3d randomEyeAbove(Random& random, double lowest);

/// A view matrix from such an eye to any point of that sphere, rolled at random.
[[nodiscard]] osg::Matrixd randomViewMatrix(Random& random, double lowest = 2e4);

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

/// Looks of a globe of 128 tiles with bins. Any number of threads may cull it.
class CameraGlobe {
public:
    explicit CameraGlobe(const CullOptions& options = {}, const std::vector<AnalyticBin>& tiles = startTiles());

    [[nodiscard]] osg::Group& root() { return *_root; }
    [[nodiscard]] std::size_t size() const { return _tiles.size(); }
    [[nodiscard]] const std::vector<osg::Vec3d>& samplesOf(std::size_t tile) const { return _samples[tile]; }

    /// Takes what has been noted since the last call.
    [[nodiscard]] std::vector<Look> takeLooks();

    /// Tiles with a sample in the picture: inside in clip space and, where a depth of the occluder is given, with a
    /// line of sight to the near plane that misses it.
    [[nodiscard]] std::set<std::size_t> seen(const Look& look, NearPlane nearPlane = NearPlane::AtTheEye,
                                             std::optional<double> occluderDepth = std::nullopt) const;

private:
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
                                 std::optional<double> occluderDepth = std::nullopt);
};

/// The horizon, with the ground 1000 m below the ellipsoid.
inline constexpr double kOccluderDepth = 1000.0;
[[nodiscard]] CullOptions horizonOptions(Method method = Method::Quadratic);

/// A camera in a scene with the globe below it.
[[nodiscard]] osg::ref_ptr<osg::Camera> makeCamera(const std::string& name, CameraGlobe& globe,
                                                   osg::Transform::ReferenceFrame frame, osg::Camera::RenderOrder order,
                                                   const osg::Matrixd& view, const osg::Matrixd& projection);

}  // namespace osgAnalyticBin::test
