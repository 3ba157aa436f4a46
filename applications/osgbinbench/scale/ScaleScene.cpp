// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ScaleScene.h"

#include "Failure.h"
#include "Quantiles.h"
#include "VerdictReplay.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osgDB/Options>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgUtil/UpdateVisitor>

#include <CullWatcher.h>
#include <TileCensus.h>
#include <algorithm>
#include <typeinfo>

namespace osgAnalyticBin::scale {

using support::Failure;

namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

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

// Drawn tiles of the deepest level: those that carry a bin, or stand beside such, and page nothing.
class LeafCounter : public flight::CullWatcher {
public:
    std::uint64_t count = 0;

private:
    static bool isLeaf(const osg::Node& node) { return typeid(node) == typeid(osg::Group) && hasStoredBin(node); }
    void enter(osg::Node& node) override { _depth += isLeaf(node) ? 1 : 0; }
    void leave(osg::Node& node) override { _depth -= isLeaf(node) ? 1 : 0; }
    void draw(osg::Drawable&) override { count += _depth > 0 ? 1U : 0U; }

    int _depth = 0;
};

osg::ref_ptr<osg::Group> readGlobe(const ScaleMethod& method, const globe::GlobeOptions& options) {
    const std::string name = globe::rootFileOf(options) + ".(" + method.parameters + ")." + method.loader;
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(name, nullptr);
    const osg::ref_ptr<osg::Node> node = result.getNode();
    if (node && node->asGroup()) return node->asGroup();
    throw Failure(name + ": cannot be read" + (result.message().empty() ? "" : ": " + result.message()) +
                  "; install this project's modules or set OSG_LIBRARY_PATH");
}

}  // namespace

void TileTally::add(const TileTally& other) {
    tested += other.tested;
    kept += other.kept;
    drawn += other.drawn;
    leaves += other.leaves;
}

Timing timingOf(std::vector<double> values) {
    const support::Quantiles quantiles(std::move(values));
    return {quantiles.at(1, 4), quantiles.at(3, 4) - quantiles.at(1, 4)};
}

std::vector<osg::ref_ptr<osg::PagedLOD>> loadChildren(osg::PagedLOD& node) {
    constexpr unsigned int kFiner = 1;
    const auto* const options = dynamic_cast<const osgDB::Options*>(node.getDatabaseOptions());
    const osg::ref_ptr<osg::Node> file =
        osgDB::readRefNodeFile(node.getDatabasePath() + node.getFileName(kFiner), options);
    if (!file) throw Failure(node.getFileName(kFiner) + ": cannot be made");
    node.addChild(file);
    return pagedLodsBelow(*file);
}

void TileLoader::requestNodeFile(const std::string&, osg::NodePath& nodePath, float, const osg::FrameStamp*,
                                 osg::ref_ptr<osg::Referenced>&, const osg::Referenced*) {
    if (auto* const paged = dynamic_cast<osg::PagedLOD*>(nodePath.back())) _pending.emplace_back(paged);
}

bool TileLoader::load(std::size_t& pagedLods) {
    const bool isAsked = !_pending.empty();
    for (const osg::ref_ptr<osg::PagedLOD>& node : _pending) pagedLods += loadChildren(*node).size();
    _pending.clear();
    return isAsked;
}

ScaleScene::ScaleScene(const ScaleMethod& method, const globe::GlobeOptions& options)
    : _method(method),
      _options(options),
      _camera(new osg::Camera),
      _frameStamp(new osg::FrameStamp),
      _loader(new TileLoader),
      _deaf(new flight::RequestCounter),
      _stage(*_loader) {
    _camera->setViewport(0, 0, kWidth, kHeight);
    if (method.cullsNothing) _camera->setCullingMode(osg::CullSettings::NO_CULLING);
    readRoot();
    nextFrame();
}

void ScaleScene::readRoot() {
    _root = readGlobe(_method, _options);
    _camera->removeChildren(0, _camera->getNumChildren());
    _camera->addChild(_root);
    _globe = flight::globeOf(*_root);
    _pagedLods = pagedLodsBelow(*_root).size();
    _isReplaying = false;
}

void ScaleScene::replay() {
    bench::replayVerdicts(*_camera, *_frameStamp);
    _isReplaying = true;
}

void ScaleScene::nextFrame() {
    constexpr double kFrameRate = 60.0;
    const unsigned int frame = _frameStamp->getFrameNumber() + 1;
    _frameStamp->setFrameNumber(frame);
    _frameStamp->setReferenceTime(frame / kFrameRate);
    _frameStamp->setSimulationTime(frame / kFrameRate);
}

void ScaleScene::settle(const flight::CameraPose& pose) {
    if (_isReplaying) readRoot();
    flight::placeCamera(*_camera, pose, _globe);
    _globe.ellipsoid->convertLatLongHeightToXYZ(pose.eye.latitude, pose.eye.longitude, pose.eye.altitude, _eyeEcef.x(),
                                                _eyeEcef.y(), _eyeEcef.z());
    do {
        nextFrame();
        _stage.setRequestHandler(*_loader);
        (void)_stage.cull(*_camera, *_frameStamp);
    } while (loadAndUpdate());
}

bool ScaleScene::loadAndUpdate() {
    const bool isAsked = _loader->load(_pagedLods);
    if (isAsked) (void)updateMs();
    return isAsked;
}

void ScaleScene::fill(std::size_t pagedLods) {
    if (!_isFilling) {
        for (const auto& node : pagedLodsBelow(*_root)) {
            const bool isBeyond = osg::Vec3d(node->getCenter()) * _eyeEcef < 0.0;
            if (isBeyond && node->getNumChildren() == 1) _frontier.push_back(node);
        }
        _isFilling = true;
    }
    while (_pagedLods < pagedLods) {
        if (_frontier.empty())
            throw Failure("--residents: a globe of this depth has no " + std::to_string(pagedLods) +
                          " PagedLODs away from the eye");
        const auto children = loadChildren(*_frontier.front());
        _frontier.pop_front();
        _frontier.insert(_frontier.end(), children.begin(), children.end());
        _pagedLods += children.size();
    }
    // what was loaded is noticed by the next cull traversal, which has the next update traversal look after it
    (void)cullMs();
    (void)updateMs();
}

TileTally ScaleScene::tally() {
    const flight::Census counts = flight::TileCensus::take(*_camera, *_frameStamp);
    const osg::ref_ptr<LeafCounter> leaves = new LeafCounter;
    leaves->watch(*_camera, *_frameStamp);
    return {counts.tested, counts.kept, counts.drawn, leaves->count};
}

double ScaleScene::cullMs() {
    nextFrame();
    _stage.setRequestHandler(*_deaf);
    return _stage.cull(*_camera, *_frameStamp);
}

double ScaleScene::updateMs() {
    nextFrame();
    const osg::ref_ptr<osgUtil::UpdateVisitor> visitor = new osgUtil::UpdateVisitor;
    visitor->setFrameStamp(_frameStamp);
    visitor->setTraversalNumber(_frameStamp->getFrameNumber());
    const Stopwatch watch;
    _camera->accept(*visitor);
    return watch.ms();
}

}  // namespace osgAnalyticBin::scale
