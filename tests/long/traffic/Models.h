// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Group>

#include <atomic>

namespace osgAnalyticBin::test {

/// Models that stand on terrain or fly up to 300 m above it, each with a HiddenByTerrainCallback.
class Models {
public:
    /// `count`: of models.
    explicit Models(unsigned int count);

    /// The models, to be added to a scene behind its database. Empty until scatter().
    [[nodiscard]] osg::Group& group() { return *_models; }

    /// Puts the models at random places up to `reach` metres from the eye, the same ones every time. Ground is what is
    /// loaded of the scene. Between frames only. Cost: one intersection with the scene for each model.
    void scatter(osg::Node& scene, const osg::Vec3d& eye, double reach);

    /// Sets whether the models ask whether terrain hides them.
    void setAsking(bool asks);

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
};

}  // namespace osgAnalyticBin::test
