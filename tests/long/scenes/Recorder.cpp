// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Recorder.h"

#include "States.h"

namespace osgAnalyticBin::test {

namespace {

std::string pathText(const osg::NodePath& path) {
    std::string text;
    for (const osg::Node* node : path)
        if (!node->getName().empty() && node->getName().front() == '#') text += node->getName();
    return text;
}

std::string cameraText(const osg::NodePath& path) {
    std::string text;
    for (osg::Node* node : path)
        if (node->asCamera()) text += node->getName();
    return text;
}

// As osg::State would have it at the end of the path.
bool isFilled(const osg::NodePath& path) {
    bool result = true;
    bool isFixed = false;
    for (const osg::Node* node : path) {
        const osg::StateSet* states = node->getStateSet();
        const auto* pair = states ? states->getAttributePair(osg::StateAttribute::POLYGONMODE) : nullptr;
        if (!pair || (isFixed && !(pair->second & osg::StateAttribute::PROTECTED))) continue;
        const auto* mode = static_cast<const osg::PolygonMode*>(pair->first.get());
        result = mode->getMode(osg::PolygonMode::FRONT) == osg::PolygonMode::FILL &&
                 mode->getMode(osg::PolygonMode::BACK) == osg::PolygonMode::FILL;
        isFixed = (pair->second & osg::StateAttribute::OVERRIDE) != 0;
    }
    return result;
}

std::uint32_t culledBins(const osg::NodeVisitor& visitor) {
    const BinStatistics* statistics = BinStatistics::find(visitor);
    return statistics ? statistics->getCounts().outside : 0;
}

}  // namespace

void Requests::requestNodeFile(const std::string& fileName, osg::NodePath& path, float /*priority*/,
                               const osg::FrameStamp* /*stamp*/, osg::ref_ptr<osg::Referenced>& /*request*/,
                               const osg::Referenced* /*options*/) {
    const auto isPaged = [](const osg::Node* node) { return dynamic_cast<const osg::PagedLOD*>(node) != nullptr; };
    const auto paged = std::find_if(path.rbegin(), path.rend(), isPaged);
    if (paged != path.rend()) files.insert({(*paged)->getName(), fileName});
}

Recorder::Recorder() {
    setDatabaseRequestHandler(_requests);
    setDrawsAsCullVisitor(*this);
}

void Recorder::apply(osg::Drawable& drawable) {
    const unsigned int before = _currentReuseRenderLeafIndex;
    const bool hasCallback = drawable.getCullCallback() != nullptr;
    const std::uint32_t culledBefore = hasCallback ? culledBins(*this) : 0;
    std::string key = newKey();
    const States found = states(drawable.getStateSet());
    if (_painter) pushStateSet(_painter->paintFor(key, found.hasProgram));
    osgUtil::CullVisitor::apply(drawable);
    if (_painter) popStateSet();
    if (_currentReuseRenderLeafIndex == before) return;
    deliver(std::move(key), drawable, *getModelViewMatrix(), found.isPlain,
            hasCallback && culledBins(*this) != culledBefore);
}

void Recorder::deliver(std::string key, const osg::Drawable& drawable, const osg::Matrixd& modelView, bool isPlain,
                       bool isCountedCulled) {
    Delivered delivered{
        cameraText(getNodePath()), &drawable, modelView,      getProjectionMatrix(), *getProjectionMatrix(),
        isFilled(getNodePath()),   isPlain,   isCountedCulled};
    _delivery.drawables.emplace(std::move(key), std::move(delivered));
}

// The cull visitor does not visit the drawables of a billboard. Each has its own matrix.
void Recorder::apply(osg::Billboard& node) {
    const unsigned int before = _traversalOrderNumber;
    const States found = states(node.getStateSet());
    if (_painter) pushStateSet(_painter->paintFor(newKey(), found.hasProgram));
    osgUtil::CullVisitor::apply(node);
    if (_painter) popStateSet();
    for (const osg::ref_ptr<osgUtil::RenderLeaf>& leaf : _reuseRenderLeafList) {
        // the others belong to another node or to an earlier frame
        if (!leaf->getDrawable() || leaf->_traversalOrderNumber < before || !node.containsNode(leaf->getDrawable()))
            continue;
        deliver(newKey(), *leaf->getDrawable(), *leaf->_modelview, found.isPlain, false);
    }
}

Recorder::States Recorder::states(const osg::StateSet* own) {
    States result;
    if (!_painter) return result;
    result.isPlain = isViewPlain;
    const auto add = [&](const osg::StateSet* set) {
        if (!set) return;
        result.hasProgram = result.hasProgram || set->getAttribute(osg::StateAttribute::PROGRAM) != nullptr;
        result.isPlain = result.isPlain && isHarmless(*set);
    };
    add(own);
    const osgUtil::StateGraph* graph = getCurrentStateGraph();
    // the first that is pushed is the view's
    for (; graph && graph->_parent && graph->_parent->_parent; graph = graph->_parent) add(graph->getStateSet());
    if (graph && graph->getStateSet())
        result.hasProgram = result.hasProgram || graph->getStateSet()->getAttribute(osg::StateAttribute::PROGRAM);
    return result;
}

std::string Recorder::newKey() const {
    std::string key = pathText(getNodePath());
    // several drawables of one node
    while (_delivery.drawables.count(key) > 0) key += '+';
    return key;
}

void Recorder::apply(osg::CoordinateSystemNode& node) {
    const std::string start = "#globe ";
    if (node.getName().rfind(start, 0) == 0)
        _delivery.databases.push_back(
            {std::atoi(node.getName().c_str() + start.size()), cameraText(getNodePath()), *getModelViewMatrix()});
    enter(static_cast<osg::Group&>(node));
}

}  // namespace osgAnalyticBin::test
