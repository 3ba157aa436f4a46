// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <vector>

namespace osgAnalyticBin::test {

/// A mesh of ECEF vertices as databases have them: floats about the first one, below a static transform.
inline osg::ref_ptr<osg::MatrixTransform> placedMesh(const std::vector<glm::dvec3>& vertices, GLenum mode) {
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> array = new osg::Vec3Array;
    for (const glm::dvec3& v : vertices) {
        const glm::dvec3 local = v - vertices[0];
        array->push_back(osg::Vec3(osg::Vec3d(local.x, local.y, local.z)));
    }
    geometry->setVertexArray(array);
    geometry->addPrimitiveSet(new osg::DrawArrays(mode, 0, static_cast<GLsizei>(array->size())));
    const osg::ref_ptr<osg::MatrixTransform> placed =
        new osg::MatrixTransform(osg::Matrixd::translate(vertices[0].x, vertices[0].y, vertices[0].z));
    placed->setDataVariance(osg::Object::STATIC);
    placed->addChild(geometry);
    return placed;
}

}  // namespace osgAnalyticBin::test
