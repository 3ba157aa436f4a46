// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TrafficBenchmark.h"

#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/HiddenByTerrainCallback.h>
#include <osgAnalyticBin/InstallBins.h>

#include <benchmark/benchmark.h>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/NodeCallback>

#include <cstdint>
#include <functional>
#include <kit/RidgeGlobe.h>
#include <memory>
#include <string>
#include <support/Random.h>
#include <utility>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

constexpr int kModels = 2000;

// Counts the models that are drawn, and does not traverse them.
class Drawn : public osg::NodeCallback {
public:
    Drawn() { setTraversesAlways(*this); }
    void operator()(osg::Node*, osg::NodeVisitor*) override { ++models; }
    int models = 0;
};

// Does something in the place of its node.
class Doing : public osg::NodeCallback {
public:
    void operator()(osg::Node*, osg::NodeVisitor* nv) override {
        if (action) action(*nv);
    }
    std::function<void(osg::NodeVisitor&)> action;
};

// Random places in front of a ridge, or behind it.
class Models {
public:
    explicit Models(bool areBehind) : _areBehind(areBehind) {
        _globe.scene = new osg::Group;
        _globe.scene->addChild(_globe.root);
        installBins(*_globe.root, withOcclusion());
        const osg::ref_ptr<osg::Group> last = new osg::Group;
        last->addCullCallback(_doing);
        last->setCullingActive(false);
        _globe.scene->addChild(last);
        Random random(1750);
        for (int i = 0; i < kModels; ++i) {
            const double longitude = areBehind ? random.uniform(0.65, 1.1) : random.uniform(0.2, 0.38);
            const osg::ref_ptr<osg::MatrixTransform> tower =
                makeTower(ecefDeg(random.uniform(0.095, 0.105), longitude, random.uniform(100.0, 800.0)));
            const osg::ref_ptr<osg::Group> model = new osg::Group;
            auto& vertices = static_cast<osg::Vec3Array&>(*drawableOf(*tower)->asGeometry()->getVertexArray());
            for (osg::Vec3& vertex : vertices) vertex = osg::Vec3d(vertex) * tower->getMatrix();
            model->addChild(tower->getChild(0));
            const osg::ref_ptr<HiddenByTerrainCallback> callback = new HiddenByTerrainCallback;
            callback->setNestedCallback(_drawn);
            model->setCullCallback(callback);
            (void)model->getBound();
            _models.push_back(model);
        }
    }

    // Runs it in a cull traversal, after the terrain was traversed.
    void traverse(const std::function<void(osg::NodeVisitor&)>& action) {
        _doing->action = action;
        (void)_globe.draws(*_globe.row[0], RidgeGlobe::alongRow());
        _doing->action = nullptr;
    }

    // All models once.
    void ask(osg::NodeVisitor& visitor) {
        _drawn->models = 0;
        for (const auto& model : _models) model->getCullCallback()->run(model.get(), &visitor);
    }

    [[nodiscard]] bool isRight() {
        traverse([&](osg::NodeVisitor& visitor) { ask(visitor); });
        return _drawn->models == (_areBehind ? 0 : kModels);
    }

    // The question alone is to be timed.
    void drawNothing() {
        for (const auto& model : _models) {
            model->getCullCallback()->setNestedCallback(nullptr);
            model->getChild(0)->setNodeMask(0);
        }
    }

private:
    const bool _areBehind;
    RidgeGlobe _globe;
    const osg::ref_ptr<Doing> _doing = new Doing;
    const osg::ref_ptr<Drawn> _drawn = new Drawn;
    std::vector<osg::ref_ptr<osg::Group>> _models;
};

}  // namespace

bool addTrafficBenchmark() {
    bool areRight = true;
    for (const bool areBehind : {false, true}) {
        const auto models = std::make_shared<Models>(areBehind);
        areRight = models->isRight() && areRight;
        models->drawNothing();
        const std::string name = std::string("BM_HiddenByTerrain/") + (areBehind ? "behind" : "before");
        benchmark::RegisterBenchmark(name.c_str(), [models](benchmark::State& state) {
            models->traverse([&](osg::NodeVisitor& visitor) {
                for (auto _ : state) models->ask(visitor);
            });
            state.SetItemsProcessed(state.iterations() * kModels);
        });
    }
    return areRight;
}

}  // namespace osgAnalyticBin::test
