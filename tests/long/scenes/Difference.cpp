// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Oracle.h"

#include <osg/Transform>
#include <osg/UserDataContainer>

#include <typeinfo>

namespace osgAnalyticBin::test {

namespace {

// Of scenes that were saved without plain ones, which only traverse: OSG stores callbacks of the kit as such.
std::string namesOf(const osg::Callback* callback, bool wereSaved) {
    std::string names;
    for (; callback; callback = callback->getNestedCallback()) {
        if (wereSaved && typeid(*callback) == typeid(osg::NodeCallback)) continue;
        names += std::string(" ") + callback->libraryName() + "::" + callback->className();
    }
    return names;
}

std::string boundCallbackOf(const osg::Node& node) {
    const osg::Object* const callback = node.getComputeBoundingSphereCallback();
    return callback ? std::string(callback->libraryName()) + "::" + callback->className() : std::string();
}

std::string userValuesOf(const osg::Node& node) {
    std::string names;
    const osg::UserDataContainer* values = node.getUserDataContainer();
    for (unsigned int i = 0; values && i < values->getNumUserObjects(); ++i) {
        const osg::Object* value = values->getUserObject(i);
        if (value) names += " \"" + value->getName() + "\" (" + value->className() + ")";
    }
    return names;
}

std::string expiryOf(const osg::Node& node) {
    const auto* paged = dynamic_cast<const osg::PagedLOD*>(&node);
    std::string times;
    for (unsigned int i = 0; paged && i < paged->getNumMinimumExpiryTimes(); ++i)
        times += ' ' + std::to_string(paged->getMinimumExpiryTime(i));
    return times;
}

// The options with which a node's files are read, and the callback that reads them.
std::string readingOf(const osg::Node& node) {
    const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&node);
    const auto* const options = paged ? dynamic_cast<const osgDB::Options*>(paged->getDatabaseOptions()) : nullptr;
    if (!options) return {};
    const osgDB::ReadFileCallback* const reader = options->getReadFileCallback();
    return "options \"" + options->getOptionString() + '"' + (reader ? typeid(*reader).name() : "");
}

/// In the order in which they are told.
enum Kind {
    Culling,
    CullCallbacks,
    UpdateCallbacks,
    EventCallbacks,
    BoundCallbacks,
    UserValues,
    Expiry,
    Reading,
    Structure,
    Kinds
};
constexpr std::array<const char*, Kinds> kKindNames{"culling active",  "cull callbacks",  "update callbacks",
                                                    "event callbacks", "bound callbacks", "user values",
                                                    "expiry times",    "read options",    "structure"};

class Comparison {
public:
    explicit Comparison(bool wereSaved) : _wereSaved(wereSaved) {}

    void compare(osg::Node& without, osg::Node& with) {
        if (!_compared.insert({&without, &with}).second) return;
        osg::Node& counterpart = belowAdded(without, with);
        compareNodes(without, counterpart);
        // the children of a terrain tile are its technique's own
        if (dynamic_cast<osgTerrain::TerrainTile*>(&without) || !without.asGroup() || !counterpart.asGroup()) return;
        osg::Group& a = *without.asGroup();
        osg::Group& b = *counterpart.asGroup();
        note(Structure, without, std::to_string(a.getNumChildren()) + " children",
             std::to_string(b.getNumChildren()) + " children");
        for (unsigned int i = 0; i < std::min(a.getNumChildren(), b.getNumChildren()); ++i)
            compare(*a.getChild(i), *b.getChild(i));
    }

    [[nodiscard]] std::optional<Difference> first() const {
        for (std::size_t kind = 0; kind < Kinds; ++kind)
            if (!_texts[kind].empty()) return Difference{kKindNames[kind], _texts[kind]};
        return std::nullopt;
    }

private:
    // A group without a name may have been put in; what is below it is compared all the same.
    osg::Node& belowAdded(osg::Node& without, osg::Node& with) {
        const bool isAdded = with.getName().empty() && !without.getName().empty() && with.asGroup() &&
                             with.asGroup()->getNumChildren() == 1;
        if (!isAdded) return with;
        note(Structure, without, "no group above", "a group above");
        return *with.asGroup()->getChild(0);
    }

    void compareNodes(osg::Node& a, osg::Node& b) {
        note(Culling, a, std::to_string(a.getCullingActive()), std::to_string(b.getCullingActive()));
        note(CullCallbacks, a, namesOf(a.getCullCallback(), _wereSaved), namesOf(b.getCullCallback(), _wereSaved));
        note(UpdateCallbacks, a, namesOf(a.getUpdateCallback(), _wereSaved),
             namesOf(b.getUpdateCallback(), _wereSaved));
        note(EventCallbacks, a, namesOf(a.getEventCallback(), _wereSaved), namesOf(b.getEventCallback(), _wereSaved));
        note(BoundCallbacks, a, boundCallbackOf(a), boundCallbackOf(b));
        note(UserValues, a, userValuesOf(a), userValuesOf(b));
        note(Expiry, a, expiryOf(a), expiryOf(b));
        note(Reading, a, readingOf(a), readingOf(b));
        note(Structure, a, a.className() + (' ' + a.getName()), b.className() + (' ' + b.getName()));
    }

    void note(Kind kind, const osg::Node& node, const std::string& before, const std::string& after) {
        if (before == after || !_texts[kind].empty()) return;
        _texts[kind] = std::string("of a ") + node.className() + " \"" + node.getName() + "\": without bins <" +
                       before + ">, after them <" + after + ">";
    }

    const bool _wereSaved;
    std::array<std::string, Kinds> _texts;
    std::set<std::pair<const osg::Node*, const osg::Node*>> _compared;
};

// With bins a pick may visit this many times as many nodes, and so many more: the kit puts a group above leaves that
// are transforms, and such a leaf has three nodes.
constexpr double kMostVisits = 4.0 / 3.0;
constexpr double kMoreVisits = 6.0;

class CountingVisitor : public osgUtil::IntersectionVisitor {
public:
    using osgUtil::IntersectionVisitor::apply;
    using osgUtil::IntersectionVisitor::IntersectionVisitor;
    void apply(osg::Node& node) override { count(node); }
    void apply(osg::Drawable& node) override { count(node); }
    // OSG takes all that is below a Geode for drawables
    void apply(osg::Geode& node) override { count(static_cast<osg::Group&>(node)); }
    void apply(osg::Group& node) override { count(node); }
    void apply(osg::LOD& node) override { count(node); }
    void apply(osg::Transform& node) override { count(node); }

    std::size_t visited = 0;

private:
    template <class NodeType>
    void count(NodeType& node) {
        ++visited;
        osgUtil::IntersectionVisitor::apply(node);
    }
};

std::string textOf(const osgUtil::LineSegmentIntersector::Intersection& hit) {
    std::ostringstream text;
    text.precision(12);
    for (const osg::Node* node : hit.nodePath)
        if (!node->getName().empty() && node->getName().front() == '#') text << node->getName();
    const osg::Vec3d at = hit.getWorldIntersectPoint();
    text << " at " << at.x() << " " << at.y() << " " << at.z();
    return text.str();
}

}  // namespace

std::optional<Difference> findDifference(osg::Node& without, osg::Node& with, bool wereSaved) {
    Comparison comparison(wereSaved);
    comparison.compare(without, with);
    return comparison.first();
}

Picked pick(osg::Node& scene, const osg::Vec3d& from, const osg::Vec3d& to) {
    const osg::ref_ptr<osgUtil::LineSegmentIntersector> line = new osgUtil::LineSegmentIntersector(from, to);
    CountingVisitor visitor(line);
    scene.accept(visitor);
    Picked picked;
    picked.visited = visitor.visited;
    for (const auto& hit : line->getIntersections()) picked.hits.push_back(textOf(hit));
    return picked;
}

std::optional<std::string> findPickDifference(const Picked& without, const Picked& with, bool comparesVisits) {
    std::ostringstream text;
    if (with.hits != without.hits) {
        const auto first = [](const Picked& picked) { return picked.hits.empty() ? "nothing" : picked.hits.front(); };
        text << without.hits.size() << " hits without bins, " << with.hits.size() << " with them, the first are <"
             << first(without) << "> and <" << first(with) << ">";
        return text.str();
    }
    if (!comparesVisits ||
        static_cast<double>(with.visited) <= kMostVisits * static_cast<double>(without.visited) + kMoreVisits)
        return std::nullopt;
    text << without.visited << " nodes visited without bins, " << with.visited << " with them";
    return text.str();
}

}  // namespace osgAnalyticBin::test
