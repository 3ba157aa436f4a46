// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileGeometry.h"

#include "Hypsometry.h"
#include "TileTopology.h"

#include <osg/Texture2D>

namespace osgbindem {

namespace {

osg::Vec3f toOsg(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

osg::ref_ptr<osg::Vec4ubArray> vertexColours(const HeightGrid& heights) {
    const osg::ref_ptr<osg::Vec4ubArray> colours = new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX);
    colours->setNormalize(true);
    const int posts = heights.cells() + 1;
    for (const std::size_t surface : surfaceVertices(heights.cells())) {
        const int place = static_cast<int>(surface);
        const Rgb colour = hypsometricColour(heights.at(place % posts, place / posts));
        colours->push_back(osg::Vec4ub(colour[0], colour[1], colour[2], 255));
    }
    return colours;
}

void drape(osg::Geometry& geometry, osg::Image& image) {
    const osg::ref_ptr<osg::Vec4ubArray> white = new osg::Vec4ubArray(osg::Array::BIND_OVERALL);
    white->setNormalize(true);
    white->push_back(osg::Vec4ub(255, 255, 255, 255));
    geometry.setColorArray(white);
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(&image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    geometry.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
}

}  // namespace

osg::ref_ptr<osg::Geometry> makeGeometry(const TileMesh& mesh, const HeightGrid& heights, osg::Image* image) {
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    for (const glm::dvec3& vertex : mesh.verticesEcef) vertices->push_back(toOsg(glm::vec3(vertex - mesh.originEcef)));
    for (const glm::vec3& normal : mesh.normals) normals->push_back(toOsg(normal));
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals);
    if (image != nullptr) {
        drape(*geometry, *image);
    } else {
        geometry->setColorArray(vertexColours(heights));
    }
    return geometry;
}

}  // namespace osgbindem
