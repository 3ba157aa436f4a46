// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PrimitiveSet>

#include <vector>

namespace osgAnalyticBin::test {

[[nodiscard]] inline osg::ref_ptr<osg::Geometry> makeGeometry(osg::Vec3Array* vertices, osg::PrimitiveSet* primitives) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(primitives);
    return geometry;
}

/// A drawable in a Geode below a transform.
[[nodiscard]] inline osg::ref_ptr<osg::MatrixTransform> placed(osg::Drawable* drawable, const osg::Matrixd& frame) {
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(drawable);
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(frame);
    transform->addChild(geode);
    return transform;
}

/// The triangles of a square grid of posts, row by row.
template <class Elements = osg::DrawElementsUInt>
[[nodiscard]] osg::ref_ptr<Elements> gridTriangles(unsigned int posts) {
    osg::ref_ptr<Elements> triangles = new Elements(GL_TRIANGLES);
    for (unsigned int j = 0; j + 1 < posts; ++j) {
        for (unsigned int i = 0; i + 1 < posts; ++i) {
            const unsigned int a = j * posts + i;
            for (const unsigned int post : {a, a + 1, a + posts + 1, a, a + posts + 1, a + posts})
                triangles->push_back(static_cast<typename Elements::value_type>(post));
        }
    }
    return triangles;
}

/// The posts around such a grid, counter-clockwise, each of them once.
[[nodiscard]] inline std::vector<unsigned int> gridBorder(unsigned int posts) {
    const unsigned int last = posts - 1;
    std::vector<unsigned int> border;
    for (unsigned int i = 0; i < last; ++i) border.push_back(i);
    for (unsigned int j = 0; j < last; ++j) border.push_back(j * posts + last);
    for (unsigned int i = last; i > 0; --i) border.push_back(last * posts + i);
    for (unsigned int j = last; j > 0; --j) border.push_back(j * posts);
    return border;
}

}  // namespace osgAnalyticBin::test
