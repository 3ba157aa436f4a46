// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/GLExtensions>
#include <osg/GraphicsContext>
#include <osg/State>

namespace osgAnalyticBin::flight {

/// A realize operation for pictures: Mesa's software renderer (22.3) never comes back from filtering the terrain's
/// textures anisotropically where they are seen at a grazing angle.
class WithoutAnisotropy : public osg::Operation {
public:
    WithoutAnisotropy() : osg::Operation("without anisotropic filtering", false) {}

    void operator()(osg::Object* object) override {
        const auto* const surface = dynamic_cast<osg::GraphicsContext*>(object);
        if (!surface || !surface->getState()) return;
        osg::GLExtensions::Get(surface->getState()->getContextID(), true)->isTextureFilterAnisotropicSupported = false;
    }
};

}  // namespace osgAnalyticBin::flight
