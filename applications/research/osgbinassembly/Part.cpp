// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Part.h"

#include "Angles.h"

#include <osgAnalyticBin/core/formula/AutodiffMapping.h>
#include <osgAnalyticBin/core/formula/CylinderSegment.h>
#include <osgAnalyticBin/core/formula/TorusSegment.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::assembly {

namespace {

using support::kPi;

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
    return makePart(core::AutodiffMapping(core::TorusSegment(frame, bendRadius)), box, kBendSteps);
}

Part makePanel(const core::BezierSolid& panel) {
    return makePart(core::AutodiffMapping(panel), {glm::dvec3(0.5), glm::dvec3(0.5)}, kPanelSteps);
}

}  // namespace osgAnalyticBin::assembly
