// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Part.h"

#include "Angles.h"
#include "TorusSegment.h"

#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/AutodiffMapping.h>
#include <osgAnalyticBin/mappings/CylinderSegment.h>

#include <glm/geometric.hpp>
#include <osg/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace osgAnalyticBin::assembly {

namespace {

using support::kPi;

/// Cells of a mesh in each parameter.
using Steps = glm::ivec3;

osg::Vec3 toFloat(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// A face of the unit box, across one axis, as a grid over the other two.
class Face {
public:
    Face(const core::AnalyticMapping& mapping, const core::ParameterBox& box, const Steps& steps, int axis, double end)
        : _columns(steps[(axis + 1) % 3]), _rows(steps[(axis + 2) % 3]) {
        for (int row = 0; row <= _rows; ++row) {
            for (int column = 0; column <= _columns; ++column) {
                glm::dvec3 unit(0.0);
                unit[axis] = end;
                unit[(axis + 1) % 3] = 2.0 * column / _columns - 1.0;
                unit[(axis + 2) % 3] = 2.0 * row / _rows - 1.0;
                _points.push_back(mapping.value(box.center + unit * box.halfSize));
            }
        }
    }

    // `outward` is 1 when columns, rows and the outside are a right-handed triple, else -1.
    void append(osg::Vec3Array& vertices, osg::Vec3Array& normals, osg::DrawElementsUInt& triangles,
                double outward) const {
        const auto first = static_cast<unsigned int>(vertices.size());
        for (int row = 0; row <= _rows; ++row) {
            for (int column = 0; column <= _columns; ++column) {
                vertices.push_back(toFloat(at(column, row)));
                normals.push_back(toFloat(outward * normal(column, row)));
            }
        }
        const auto index = [&](int column, int row) {
            return first + static_cast<unsigned int>(row * (_columns + 1) + column);
        };
        for (int row = 0; row < _rows; ++row) {
            for (int column = 0; column < _columns; ++column) {
                std::array<unsigned int, 4> corner{index(column, row), index(column + 1, row),
                                                   index(column + 1, row + 1), index(column, row + 1)};
                if (outward < 0.0) std::swap(corner[1], corner[3]);
                for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) triangles.push_back(corner[i]);
            }
        }
    }

private:
    [[nodiscard]] const glm::dvec3& at(int column, int row) const {
        return _points[static_cast<std::size_t>(row * (_columns + 1) + column)];
    }

    [[nodiscard]] glm::dvec3 normal(int column, int row) const {
        const glm::dvec3 along = at(std::min(column + 1, _columns), row) - at(std::max(column - 1, 0), row);
        const glm::dvec3 across = at(column, std::min(row + 1, _rows)) - at(column, std::max(row - 1, 0));
        return glm::normalize(glm::cross(along, across));
    }

    int _columns;
    int _rows;
    std::vector<glm::dvec3> _points;
};

// 1 when the mapping keeps the handedness of the parameters, -1 when it mirrors them.
double handedness(const core::AnalyticMapping& mapping, const core::ParameterBox& box) {
    const glm::dmat3 j = mapping.jacobian(box.center);
    return glm::dot(glm::cross(j[0], j[1]), j[2]) < 0.0 ? -1.0 : 1.0;
}

/// The six faces of a mapped box as triangles, with normals that point out of it. Vertices are mapped positions of the
/// box, rounded to float.
osg::ref_ptr<osg::Geometry> meshOf(const core::AnalyticMapping& mapping, const core::ParameterBox& box,
                                   const Steps& steps) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    const osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    const double hand = handedness(mapping, box);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double end : {-1.0, 1.0}) {
            Face(mapping, box, steps, axis, end).append(*vertices, *normals, *triangles, end * hand);
        }
    }
    osg::ref_ptr<osg::Geometry> mesh = new osg::Geometry;
    mesh->setVertexArray(vertices.get());
    mesh->setNormalArray(normals.get(), osg::Array::BIND_PER_VERTEX);
    mesh->addPrimitiveSet(triangles.get());
    return mesh;
}

/// How far the rounding to float moves a vertex at most.
double floatRounding(const osg::Geometry& mesh) {
    double largest = 0.0;
    for (const osg::Vec3& v : static_cast<const osg::Vec3Array&>(*mesh.getVertexArray())) {
        largest = std::max({largest, std::abs(double{v.x()}), std::abs(double{v.y()}), std::abs(double{v.z()})});
    }
    // Half a unit in the last place of a float in each of three coordinates.
    constexpr double kHalfUnit = 1.0 / (1 << 24);
    return largest * kHalfUnit * 2.0;
}

constexpr float kSampleStep = 0.5f;  // metres

const Steps kPipeSteps{12, 1, 1};  // angle, radius, height
const Steps kBendSteps{8, 8, 1};   // bend, tube, radius
const Steps kPanelSteps{8, 8, 1};  // u, v, thickness

// The bin's margin is what the mesh leaves the mapped box by: its chords, and the rounding of its vertices.
template <class F>
Part makePart(const core::AutodiffMapping<F>& mapping, const core::ParameterBox& box, const Steps& steps) {
    const osg::ref_ptr<osg::Geometry> mesh = meshOf(mapping, box, steps);
    const double sag = mapping.triangleSagBound(box, 2.0 * box.halfSize / glm::dvec3(steps));
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(mesh.get());
    return {geode, core::QuadraticBin(mapping, box, sag + floatRounding(*mesh))};
}

}  // namespace

std::vector<osg::Vec3> Part::samples() const {
    const osg::Geometry& mesh = *geode->getDrawable(0)->asGeometry();
    const auto& vertices = static_cast<const osg::Vec3Array&>(*mesh.getVertexArray());
    const auto& corners = static_cast<const osg::DrawElementsUInt&>(*mesh.getPrimitiveSet(0));
    std::vector<osg::Vec3> points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const osg::Vec3& from = vertices[corners[i]];
        const osg::Vec3 edge = vertices[corners[i % 3 == 2 ? i - 2 : i + 1]] - from;
        const int steps = std::max(1, static_cast<int>(std::ceil(edge.length() / kSampleStep)));
        for (int k = 0; k < steps; ++k) {
            points.push_back(from + edge * (static_cast<float>(k) / static_cast<float>(steps)));
        }
    }
    return points;
}

Part makePipeQuarter(const core::Frame& frame, double radius, double wall, double length, int quarter) {
    const core::ParameterBox box{{(0.25 + 0.5 * quarter) * kPi, radius - 0.5 * wall, 0.5 * length},
                                 {0.25 * kPi, 0.5 * wall, 0.5 * length}};
    return makePart(core::AutodiffMapping(core::CylinderSegment(frame)), box, kPipeSteps);
}

Part makeBendQuarter(const core::Frame& frame, double bendRadius, double radius, double wall, int half, int quarter) {
    const core::ParameterBox box{{(0.125 + 0.25 * half) * kPi, (0.25 + 0.5 * quarter) * kPi, radius - 0.5 * wall},
                                 {0.125 * kPi, 0.25 * kPi, 0.5 * wall}};
    return makePart(core::AutodiffMapping(TorusSegment(frame, bendRadius)), box, kBendSteps);
}

Part makePanel(const BezierSolid& panel) {
    return makePart(core::AutodiffMapping(panel), {glm::dvec3(0.5), glm::dvec3(0.5)}, kPanelSteps);
}

}  // namespace osgAnalyticBin::assembly
