// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a cull traversal delivers, and which files it asks for.

#pragma once

#include "Painter.h"
#include "Parts.h"

namespace osgAnalyticBin::test {

/// A drawable at one place in the scene, that a cull traversal delivered.
struct Delivered {
    std::string camera;  ///< names of the cameras in the scene that it is drawn by
    osg::ref_ptr<const osg::Drawable> drawable;
    osg::Matrixd modelView;
    osg::ref_ptr<const osg::RefMatrix> projection;  ///< after the traversal, with its near and far planes
    osg::Matrixd givenProjection;                   ///< before
    bool isFilled = true;                           ///< whether its polygons are
    bool isPlain = true;                            ///< whether it is drawn where it is, and hides what is behind
    bool ignoresDepth = false;                      ///< nothing hides it
    bool isCountedCulled = false;                   ///< whether a bin on it was counted as culled all the same
};

/// A database that a cull traversal met.
struct MetDatabase {
    int number = 0;
    std::string camera;
    osg::Matrixd modelView;
};

/// What one cull traversal delivers.
struct Delivery {
    /// By names of nodes on the way to the drawable: nodes that the kit puts in have none.
    std::map<std::string, Delivered> drawables;
    std::vector<MetDatabase> databases;
    osg::Matrixd projection;         ///< of the view, with its near and far planes
    bool arePlanesComputed = false;  ///< by OSG
    /// Where there is a painter.
    Painting painting;
};

/// A PagedLOD by its name, and the file that it pages.
using Request = std::pair<std::string, std::string>;

/// Notes the files that a cull traversal asks for. Applications expect a DatabasePager.
class Requests : public osgDB::DatabasePager {
public:
    void requestNodeFile(const std::string& fileName, osg::NodePath& path, float /*priority*/,
                         const osg::FrameStamp* /*stamp*/, osg::ref_ptr<osg::Referenced>& /*request*/,
                         const osg::Referenced* /*options*/) override {
        const auto isPaged = [](const osg::Node* node) { return dynamic_cast<const osg::PagedLOD*>(node) != nullptr; };
        const auto paged = std::find_if(path.rbegin(), path.rend(), isPaged);
        if (paged != path.rend()) files.insert({(*paged)->getName(), fileName});
    }

    std::set<Request> files;
};

/// A cull visitor that notes what it delivers.
class Recorder : public osgUtil::CullVisitor {
public:
    Recorder() {
        setDatabaseRequestHandler(_requests);
        setDrawsAsCullVisitor(*this);
    }

    using osgUtil::CullVisitor::apply;
    void apply(osg::Drawable& drawable) override {
        const unsigned int before = _currentReuseRenderLeafIndex;
        const bool hasCallback = drawable.getCullCallback() != nullptr;
        const std::uint32_t culledBefore = hasCallback ? culledBins(*this) : 0;
        std::string key = newKey();
        const States found = states(drawable.getStateSet());
        if (_painter) pushStateSet(_painter->paintFor(key, found.hasProgram));
        osgUtil::CullVisitor::apply(drawable);
        if (_painter) popStateSet();
        if (_currentReuseRenderLeafIndex == before) return;
        deliver(std::move(key), drawable, *getModelViewMatrix(), found,
                hasCallback && culledBins(*this) != culledBefore);
    }

    // The cull visitor does not visit the drawables of a billboard. Each has its own matrix.
    void apply(osg::Billboard& node) override {
        const unsigned int before = _traversalOrderNumber;
        const States found = states(node.getStateSet());
        if (_painter) pushStateSet(_painter->paintFor(newKey(), found.hasProgram));
        osgUtil::CullVisitor::apply(node);
        if (_painter) popStateSet();
        for (const osg::ref_ptr<osgUtil::RenderLeaf>& leaf : _reuseRenderLeafList) {
            // the others belong to another node or to an earlier frame
            if (!leaf->getDrawable() || leaf->_traversalOrderNumber < before || !node.containsNode(leaf->getDrawable()))
                continue;
            deliver(newKey(), *leaf->getDrawable(), *leaf->_modelview, found, false);
        }
    }

    void apply(osg::CoordinateSystemNode& node) override {
        const std::string start = "#globe ";
        if (node.getName().rfind(start, 0) == 0)
            _delivery.databases.push_back(
                {std::atoi(node.getName().c_str() + start.size()), cameraText(getNodePath()), *getModelViewMatrix()});
        osgUtil::CullVisitor::apply(static_cast<osg::Group&>(node));
    }

    /// Has drawables drawn in the painter's colours, by their keys in the delivery. nullptr: as they are.
    void setPainter(Painter* painter) { _painter = painter; }

    [[nodiscard]] Delivery takeDelivery() { return std::exchange(_delivery, {}); }
    [[nodiscard]] std::set<Request> takeRequests() { return std::exchange(_requests->files, {}); }

    /// Whether states that are pushed above the scene let it be drawn where it is.
    bool isViewPlain = true;

private:
    /// What is in force at the end of the path.
    struct States {
        bool isPlain = true, hasProgram = false, ignoresDepth = false, obeysDepth = false;
    };
    [[nodiscard]] States states(const osg::StateSet* own) {
        States result;
        result.isPlain = isViewPlain;
        const auto add = [&](const osg::StateSet* set) {
            if (!set) return;
            result.hasProgram = result.hasProgram || set->getAttribute(osg::StateAttribute::PROGRAM) != nullptr;
            result.isPlain = result.isPlain && isHarmless(*set);
            const auto* const depth = dynamic_cast<const osg::Depth*>(set->getAttribute(osg::StateAttribute::DEPTH));
            if (depth) (depth->getFunction() == osg::Depth::ALWAYS ? result.ignoresDepth : result.obeysDepth) = true;
        };
        add(own);
        const osgUtil::StateGraph* graph = getCurrentStateGraph();
        // the first that is pushed is the view's
        for (; graph && graph->_parent && graph->_parent->_parent; graph = graph->_parent) add(graph->getStateSet());
        if (graph && graph->getStateSet())
            result.hasProgram = result.hasProgram || graph->getStateSet()->getAttribute(osg::StateAttribute::PROGRAM);
        return result;
    }

    void deliver(std::string key, const osg::Drawable& drawable, const osg::Matrixd& modelView, const States& states,
                 bool isCountedCulled) {
        Delivered delivered{cameraText(getNodePath()), &drawable, modelView, getProjectionMatrix(),
                            *getProjectionMatrix()};
        delivered.isFilled = isFilled(getNodePath());
        delivered.isPlain = states.isPlain;
        delivered.ignoresDepth = states.ignoresDepth && !states.obeysDepth;
        delivered.isCountedCulled = isCountedCulled;
        _delivery.drawables.emplace(std::move(key), std::move(delivered));
    }

    // For what is at the end of the path: a key that no drawable has yet.
    [[nodiscard]] std::string newKey() const {
        std::string key = pathText(getNodePath());
        // several drawables of one node
        while (_delivery.drawables.count(key) > 0) key += '+';
        return key;
    }

    static std::string pathText(const osg::NodePath& path) {
        std::string text;
        for (const osg::Node* node : path)
            if (!node->getName().empty() && node->getName().front() == '#') text += node->getName();
        return text;
    }

    static std::string cameraText(const osg::NodePath& path) {
        std::string text;
        for (osg::Node* node : path)
            if (node->asCamera()) text += node->getName();
        return text;
    }

    // As osg::State would have it at the end of the path.
    static bool isFilled(const osg::NodePath& path) {
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

    static std::uint32_t culledBins(const osg::NodeVisitor& visitor) {
        const BinStatistics* statistics = BinStatistics::find(visitor);
        return statistics ? statistics->getCounts().outside : 0;
    }

    const osg::ref_ptr<Requests> _requests = new Requests;
    Delivery _delivery;
    Painter* _painter = nullptr;
};

}  // namespace osgAnalyticBin::test
