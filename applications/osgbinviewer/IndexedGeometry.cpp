// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "IndexedGeometry.h"

#include <osg/Depth>
#include <osg/LineWidth>
#include <osg/MatrixTransform>

namespace osgAnalyticBin::viewer {

osg::ref_ptr<osg::Geometry> makeIndexed(osg::Vec3Array& vertices, GLenum primitives,
                                        const std::vector<unsigned int>& indices, const osg::Vec4& colour,
                                        int renderBin) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(&vertices);
    const osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
    (*colours)[0] = colour;
    geometry->setColorArray(colours);
    geometry->addPrimitiveSet(
        new osg::DrawElementsUInt(primitives, static_cast<unsigned int>(indices.size()), indices.data()));
    osg::StateSet& state = *geometry->getOrCreateStateSet();
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    state.setAttributeAndModes(new osg::LineWidth(1.5F));
    state.setRenderBinDetails(renderBin, "RenderBin");
    return geometry;
}

osg::ref_ptr<osg::Node> placed(const osg::Matrixd& toWorld, std::initializer_list<osg::ref_ptr<osg::Geometry>> parts) {
    osg::ref_ptr<osg::MatrixTransform> node = new osg::MatrixTransform(toWorld);
    for (const auto& part : parts) node->addChild(part);
    return node;
}

}  // namespace osgAnalyticBin::viewer
