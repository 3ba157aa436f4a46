// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ScaleScene.h"

#include "Quantiles.h"
#include "VerdictReplay.h"

#include <osgDB/Options>
#include <osgDB/ReadFile>
#include <osgUtil/UpdateVisitor>

namespace osgAnalyticBin::scale {

using support::Failure;

namespace {

class PagedLodFinder : public osg::NodeVisitor {
public:
    PagedLodFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    using osg::NodeVisitor::apply;
    void apply(osg::PagedLOD& node) override {
        found.emplace_back(&node);
        traverse(node);
    }

    std::vector<osg::ref_ptr<osg::PagedLOD>> found;
};

std::vector<osg::ref_ptr<osg::PagedLOD>> pagedLodsBelow(osg::Node& node) {
    PagedLodFinder finder;
    node.accept(finder);
    return finder.found;
}

// Reads the finer children of a PagedLOD and merges them as the DatabasePager does.
std::vector<osg::ref_ptr<osg::PagedLOD>> loadChildren(osg::PagedLOD& node) {
    constexpr unsigned int kFiner = 1;
    const auto* const options = dynamic_cast<const osgDB::Options*>(node.getDatabaseOptions());
    const osg::ref_ptr<osg::Node> file =
        osgDB::readRefNodeFile(node.getDatabasePath() + node.getFileName(kFiner), options);
    if (!file) throw Failure(node.getFileName(kFiner) + ": cannot be made");
    node.addChild(file);
    return pagedLodsBelow(*file);
}

bench::Settings settingsFor(const globe::GlobeOptions& options) {
    bench::Settings settings;
    settings.database = globe::rootFileOf(options);
    settings.binOptions = "index=off";
    return settings;
}

}  // namespace

Timing timingOf(std::vector<double> values) {
    const support::Quantiles quantiles(std::move(values));
    return {quantiles.at(1, 4), quantiles.at(3, 4) - quantiles.at(1, 4)};
}

ScaleScene::ScaleScene(const bench::CullMethod& method, const globe::GlobeOptions& options, bench::FileWatch& watch)
    : _settings(settingsFor(options)),
      _scene(method, _settings, watch),
      _deaf(new flight::RequestCounter),
      _stage(*_deaf) {
    load();
}

void ScaleScene::load() {
    _scene.load();
    _scene.pause();
    _isReplaying = false;
}

void ScaleScene::replay() {
    bench::replayVerdicts(_scene.camera(), _scene.frameStamp());
    _isReplaying = true;
}

void ScaleScene::nextFrame() {
    constexpr double kFrameRate = 60.0;
    osg::FrameStamp& stamp = _scene.frameStamp();
    stamp.setFrameNumber(stamp.getFrameNumber() + 1);
    stamp.setReferenceTime(stamp.getReferenceTime() + 1.0 / kFrameRate);
    stamp.setSimulationTime(stamp.getReferenceTime());
}

void ScaleScene::settle(const flight::CameraPose& pose) {
    if (_isReplaying) load();
    _scene.resume();
    _scene.settle(pose);
    _scene.pause();
}

std::size_t ScaleScene::pagedLods() {
    return pagedLodsBelow(root()).size();
}

void ScaleScene::fill(std::size_t pagedLods) {
    const osg::Vec3d eye = osg::Matrixd::inverse(_scene.camera().getViewMatrix()).getTrans();
    const auto loaded = pagedLodsBelow(root());
    for (const auto& node : loaded)
        if (osg::Vec3d(node->getCenter()) * eye < 0.0 && node->getNumChildren() == 1) _frontier.push_back(node);
    for (std::size_t count = loaded.size(); count < pagedLods;) {
        if (_frontier.empty())
            throw Failure("--residents: a globe of this depth has no " + std::to_string(pagedLods) +
                          " PagedLODs away from the eye");
        const auto children = loadChildren(*_frontier.front());
        _frontier.pop_front();
        _frontier.insert(_frontier.end(), children.begin(), children.end());
        count += children.size();
    }
    // what was loaded is noticed by the next cull traversal, which has the next update traversal look after it
    (void)cullMs();
    (void)updateMs();
}

void ScaleScene::addCounts(report::Json& row) {
    const flight::Census census = _scene.census();
    for (const auto& [column, count] :
         {std::pair("tested_tiles", census.tested), {"kept_tiles", census.kept}, {"drawn_tiles", census.drawn}})
        row[column] = row.value(column, std::uint64_t{0}) + count;
}

double ScaleScene::cullMs() {
    nextFrame();
    return _stage.cull(_scene.camera(), _scene.frameStamp());
}

double ScaleScene::updateMs() {
    nextFrame();
    const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
    visitor->setFrameStamp(&_scene.frameStamp());
    visitor->setTraversalNumber(_scene.frameStamp().getFrameNumber());
    const Stopwatch watch;
    _scene.camera().accept(*visitor);
    return watch.ms();
}

}  // namespace osgAnalyticBin::scale
