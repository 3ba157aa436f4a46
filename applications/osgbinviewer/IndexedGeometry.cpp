// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexedGeometry.h"

namespace osgAnalyticBin::viewer {

osg::ref_ptr<osg::Geometry> makeIndexed(osg::Vec3Array& vertices, GLenum primitives,
                                        const std::vector<unsigned int>& indices, const osg::Vec4& colour) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(&vertices);
    const osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
    (*colours)[0] = colour;
    geometry->setColorArray(colours);
    geometry->addPrimitiveSet(
        new osg::DrawElementsUInt(primitives, static_cast<unsigned int>(indices.size()), indices.data()));
    return geometry;
}

}  // namespace osgAnalyticBin::viewer
