// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GlmBridge.h"
#include "ViewTools.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <glm/trigonometric.hpp>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Transform>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace osgAnalyticBin::viewer {

namespace {

constexpr int kFewestSteps = 16;
const osg::Vec4 kBackground(0.2F, 0.2F, 0.4F, 1.0F);  // OSG's, of a window
constexpr double kInFront = 1e-3;                     // of the distance: more than depth buffers tell apart

// Of a box's parameter: chords of at most a degree, and finer in tiles near by, so that terrain does not come through.
int stepsOf(const core::Interval& angles) {
    return std::max(kFewestSteps, static_cast<int>(std::ceil(glm::degrees(angles.width()))));
}

// Maps the unit box [-1, 1]^3 to ECEF.
using Surface = std::function<glm::dvec3(const glm::dvec3& unit)>;

// The face where one parameter is -1 or 1, counterclockwise from outside: latitude, longitude and altitude are a
// left-handed frame. And two of its sides, so that all faces together have each edge of the box once.
void addFace(const Surface& surface, const std::array<int, 3>& steps, int fixed, double side, SlabMesh& mesh) {
    const auto unitAt = [&](int axis, int step) { return 2.0 * step / steps[std::size_t(axis)] - 1.0; };
    const int u = (fixed + 1) % 3;
    const int v = (fixed + 2) % 3;
    const int columns = steps[std::size_t(u)];
    const int rows = steps[std::size_t(v)];
    const auto first = static_cast<unsigned int>(mesh.vertices.size());
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            glm::dvec3 unit;
            unit[fixed] = side;
            unit[u] = unitAt(u, i);
            unit[v] = unitAt(v, j);
            mesh.vertices.emplace_back(toOsg(surface(unit)) - mesh.origin);
        }
    }
    const auto width = static_cast<unsigned int>(columns + 1);
    for (unsigned int j = 0; j < static_cast<unsigned int>(rows); ++j) {
        for (unsigned int i = 0; i < static_cast<unsigned int>(columns); ++i) {
            const unsigned int at = first + j * width + i;
            const unsigned int right = side > 0.0 ? at + width : at + 1;
            const unsigned int left = side > 0.0 ? at + 1 : at + width;
            for (const unsigned int index : {at, right, at + width + 1, at, at + width + 1, left})
                mesh.triangles.push_back(index);
        }
    }
    for (const unsigned int row : {first, first + static_cast<unsigned int>(rows) * width})
        for (unsigned int i = 0; i < static_cast<unsigned int>(columns); ++i)
            mesh.lines.insert(mesh.lines.end(), {row + i, row + i + 1});
}

SlabMesh meshOf(const Surface& surface, const std::array<int, 3>& steps) {
    SlabMesh mesh;
    mesh.origin = toOsg(surface(glm::dvec3(0.0)));
    for (int fixed = 0; fixed < 3; ++fixed)
        for (const double side : {-1.0, 1.0}) addFace(surface, steps, fixed, side, mesh);
    return mesh;
}

// Brings a node nearer to the eye by a share of the distance. The picture of a perspective view stays the same.
class Nearer : public osg::Transform {
public:
    explicit Nearer(double share) : _scale(1.0 - share) {}

    bool computeLocalToWorldMatrix(osg::Matrix& matrix, osg::NodeVisitor* visitor) const override {
        osgUtil::CullVisitor* const view = visitor ? visitor->asCullVisitor() : nullptr;
        const bool isPerspective = view && (*view->getProjectionMatrix())(2, 3) != 0.0;
        if (isPerspective) matrix.postMultScale(osg::Vec3d(_scale, _scale, _scale));
        return true;
    }

private:
    const double _scale;
};

osg::ref_ptr<osg::Node> nearer(double share, osg::Node& node) {
    osg::ref_ptr<Nearer> transform = new Nearer(share);
    transform->addChild(&node);
    return transform;
}

}  // namespace

SlabMesh slabMesh(const core::GeodeticBin& of, const core::Ellipsoid& ellipsoid) {
    const std::array<int, 3> steps{stepsOf(of.latitude()), stepsOf(of.longitude()), 1};
    // of chords, both ways: the top lies outside, or flat terrain would come through
    const double sag = 0.126 * ellipsoid.equatorialRadius() *
                       (std::pow(of.latitude().width() / steps[0], 2) + std::pow(of.longitude().width() / steps[1], 2));
    const core::GeodeticBin bin = of.withAltitude({of.altitude().lower, of.altitude().upper + sag});
    const core::GeodeticMapping mapping(ellipsoid);
    const auto at = [](const core::Interval& interval, double unit) {
        return interval.middle() + 0.5 * unit * interval.width();
    };
    return meshOf(
        [&](const glm::dvec3& unit) {
            return mapping.value({at(bin.latitude(), unit.x), at(bin.longitude(), unit.y), at(bin.altitude(), unit.z)});
        },
        steps);
}

osg::ref_ptr<osg::Node> makeSlab(const SlabMesh& mesh, const osg::Vec4& faces, const osg::Vec4& edges, int edgesBin) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(mesh.vertices.begin(), mesh.vertices.end());
    const osg::Matrixd place = osg::Matrixd::translate(mesh.origin);
    const osg::ref_ptr<osg::Group> slab = new osg::Group;
    if (faces.a() > 0.0F) {
        // Of what is behind each other the nearest face alone is drawn, so that colours do not mix.
        const auto depths = makeIndexed(*vertices, GL_TRIANGLES, mesh.triangles, faces, 18);
        const auto colours = makeIndexed(*vertices, GL_TRIANGLES, mesh.triangles, faces, 19);
        depths->getStateSet()->setAttribute(new osg::ColorMask(false, false, false, false));
        depths->getStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, true));
        // Beyond the far plane all have the same depth: there the nearest slab covers the others.
        osg::Vec4 mixed = faces * faces.a() + kBackground * (1.0F - faces.a());
        mixed.a() = 1.0F;
        const auto beyond = makeIndexed(*vertices, GL_TRIANGLES, mesh.triangles, mixed, 20);
        beyond->getStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 1.0, 1.0, false));
        beyond->getStateSet()->setRenderBinDetails(20, "DepthSortedBin");
        for (const auto& part : {depths, colours, beyond}) part->getStateSet()->setAttributeAndModes(new osg::CullFace);
        slab->addChild(nearer(kInFront, *placed(place, {depths, colours, beyond})));
    }
    const auto lines = makeIndexed(*vertices, GL_LINES, mesh.lines, edges, edgesBin);
    // Edges of neighbours nearly coincide: the last one drawn wins along its length.
    // What is clamped to the far plane has no lines.
    lines->getStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
    slab->addChild(nearer(2.0 * kInFront, *placed(place, {lines})));
    return slab;
}

}  // namespace osgAnalyticBin::viewer
