// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Handlers.h"

#include <atomic>

namespace osgAnalyticBin::viewer {

/// Models that stand on terrain or fly up to 300 m above it, each with a HiddenByTerrainCallback.
class Traffic {
public:
    /// `count`: of models.
    explicit Traffic(unsigned int count);

    /// The models, to be added to a scene behind its database. Empty until scatter().
    [[nodiscard]] osg::Group& models() { return *_models; }

    /// Puts the models at random places up to `reach` metres from the eye, the same ones every time. Ground is what is
    /// loaded of the scene. Between frames only. Cost: one intersection with the scene for each model.
    void scatter(osg::Node& scene, const osg::Vec3d& eye, double reach);

    /// Sets whether the models ask whether terrain hides them. At first they do.
    void setAsking(bool asks);
    [[nodiscard]] bool isAsking() const { return _asks; }

    /// How many models the cull traversals since the last call have drawn.
    [[nodiscard]] unsigned int takeDrawn() { return _drawn->models.exchange(0); }

private:
    struct Drawn : public osg::Referenced {
        std::atomic<unsigned int> models{0};
    };
    class Counter;

    const unsigned int _count;
    const osg::ref_ptr<osg::Group> _models = new osg::Group;
    const osg::ref_ptr<Drawn> _drawn = new Drawn;
    bool _asks = true;
};

/// Scatters models about the camera once the terrain there is loaded, and says how many of them are drawn. Key `T`
/// scatters them anew, `G` stops and starts that terrain hides them.
class TrafficHandler : public KeyHandler {
public:
    /// Adds `count` models to the scene, behind all that is there.
    TrafficHandler(osg::Group& scene, unsigned int count);

protected:
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    Traffic _traffic;
    bool _isDue = true;
    const osg::ref_ptr<TextPanel> _panel = new TextPanel(TextPanel::Corner::BottomRight);
};

}  // namespace osgAnalyticBin::viewer
