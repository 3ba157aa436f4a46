// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Handlers.h"
#include "ViewTools.h"

#include <osg/Geometry>
#include <osgText/Text>

#include <algorithm>

namespace osgAnalyticBin::viewer {

namespace {

constexpr float kCharacterSize = 18.0F;
constexpr float kLineHeight = 1.35F * kCharacterSize;
constexpr float kMargin = 12.0F;

osg::ref_ptr<osgText::Text> makeText(const TextPanel::Line& line, const osg::Vec3& position) {
    osg::ref_ptr<osgText::Text> text = new osgText::Text;
    text->setDataVariance(osg::Object::DYNAMIC);
    text->setFont("fonts/arial.ttf");
    text->setCharacterSize(kCharacterSize);
    text->setPosition(position);
    text->setColor(line.colour);
    text->setText(line.text);
    return text;
}

osg::ref_ptr<osg::Geometry> makeBackground(float left, float bottom, float width, float height) {
    osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry(
        osg::Vec3(left, bottom, -0.5F), osg::Vec3(width, 0.0F, 0.0F), osg::Vec3(0.0F, height, 0.0F));
    quad->setUseVertexBufferObjects(true);
    const osg::ref_ptr<osg::Vec4Array> colour = new osg::Vec4Array(osg::Array::BIND_OVERALL, 1);
    (*colour)[0].set(0.0F, 0.0F, 0.1F, 0.75F);
    quad->setColorArray(colour);
    return quad;
}

}  // namespace

TextPanel::TextPanel(Corner corner) : _corner(corner), _hud(new osg::Camera) {
    _hud->setNodeMask(0);
    _hud->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    // In the window's own render stage: where two cull threads meet the panel for the first time, both would make OSG's
    // cache of stages.
    _hud->setRenderOrder(osg::Camera::NESTED_RENDER);
    _hud->setAllowEventFocus(false);
    osg::StateSet& state = *_hud->getOrCreateStateSet();
    state.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    constexpr int kLast = 1000;
    state.setRenderBinDetails(kLast, "TraversalOrderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
}

void TextPanel::show(osg::Camera& camera, const std::vector<Line>& lines) {
    osg::Group& overlay = CameraCulling::of(camera).overlay();
    if (!overlay.containsNode(_hud)) {
        while (_hud->getNumParents() > 0) _hud->getParent(0)->removeChild(_hud);
        overlay.addChild(_hud);
    }
    _hud->setNodeMask(~0U);
    const double width = camera.getViewport() ? camera.getViewport()->width() : 1.0;
    if (_lines == lines && _width == width) return;
    _lines = lines;
    _width = width;
    const osg::ref_ptr<osg::Geode> texts = new osg::Geode;
    float widest = 0.0F;
    float y = kMargin * 1.7F + kLineHeight * static_cast<float>(lines.size() - 1);
    for (const Line& line : lines) {
        const auto text = makeText(line, osg::Vec3(2.0F * kMargin, y, 0.0F));
        widest = std::max(widest, text->getBoundingBox().xMax() + kMargin);
        texts->addDrawable(text);
        y -= kLineHeight;
    }
    texts->insertChild(0, makeBackground(kMargin, kMargin, widest - kMargin,
                                         kLineHeight * static_cast<float>(lines.size()) + 0.5F * kMargin));
    const double height = camera.getViewport() ? camera.getViewport()->height() : 1.0;
    const double right = _corner == Corner::BottomLeft ? 0.0 : width - widest - kMargin;
    const double up =
        _corner == Corner::TopRight ? height - kLineHeight * static_cast<double>(lines.size()) - 2.5 * kMargin : 0.0;
    _hud->setProjectionMatrixAsOrtho(-right, width - right, -up, height - up, -1.0, 1.0);
    _hud->removeChildren(0, _hud->getNumChildren());
    _hud->addChild(texts);
    computeBounds(*_hud);
}

}  // namespace osgAnalyticBin::viewer
