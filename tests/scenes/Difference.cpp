// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Difference.h"

#include <osg/Group>
#include <osg/PagedLOD>
#include <osg/UserDataContainer>
#include <osg/ValueObject>
#include <osgTerrain/TerrainTile>

#include <set>
#include <utility>

namespace osgAnalyticBin::test {

namespace {

std::string namesOf(const osg::Callback* callback) {
    std::string names;
    for (; callback; callback = callback->getNestedCallback())
        names += std::string(" ") + callback->libraryName() + "::" + callback->className();
    return names;
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

class Comparison {
public:
    explicit Comparison(bool ignoresUpdate) : _ignoresUpdate(ignoresUpdate) {}

    std::optional<std::string> compare(osg::Node& without, osg::Node& with) {
        if (!_compared.insert({&without, &with}).second) return std::nullopt;
        if (auto difference = compareNodes(without, with)) return difference;
        // the children of a terrain tile are its technique's own
        if (dynamic_cast<osgTerrain::TerrainTile*>(&without) || !without.asGroup()) return std::nullopt;
        osg::Group& a = *without.asGroup();
        osg::Group& b = *with.asGroup();
        for (unsigned int i = 0; i < a.getNumChildren(); ++i)
            if (auto difference = compare(*a.getChild(i), *b.getChild(i))) return difference;
        return std::nullopt;
    }

private:
    std::optional<std::string> compareNodes(osg::Node& a, osg::Node& b) {
        const auto differ = [&](const char* what, const std::string& before, const std::string& after) {
            return std::string(what) + " of a " + a.className() + " \"" + a.getName() + "\": before <" + before +
                   ">, after <" + after + ">";
        };
        const auto differing = [&](const char* what, const std::string& before,
                                   const std::string& after) -> std::optional<std::string> {
            return before == after ? std::nullopt : std::optional(differ(what, before, after));
        };
        const auto children = [](osg::Node& node) {
            return std::to_string(node.asGroup() ? node.asGroup()->getNumChildren() : 0);
        };
        if (auto d = differing("the class", a.className(), b.className())) return d;
        if (auto d = differing("the name", a.getName(), b.getName())) return d;
        if (auto d = differing("the number of children", children(a), children(b))) return d;
        if (auto d =
                differing("culling active", std::to_string(a.getCullingActive()), std::to_string(b.getCullingActive())))
            return d;
        if (auto d = differing("cull callbacks", namesOf(a.getCullCallback()), namesOf(b.getCullCallback()))) return d;
        if (auto d = differing("event callbacks", namesOf(a.getEventCallback()), namesOf(b.getEventCallback())))
            return d;
        if (!_ignoresUpdate) {
            if (auto d = differing("update callbacks", namesOf(a.getUpdateCallback()), namesOf(b.getUpdateCallback())))
                return d;
        }
        if (auto d = differing("user values", userValuesOf(a), userValuesOf(b))) return d;
        return differing("expiry times", expiryOf(a), expiryOf(b));
    }

    const bool _ignoresUpdate;
    std::set<std::pair<const osg::Node*, const osg::Node*>> _compared;
};

}  // namespace

std::optional<std::string> firstDifference(osg::Node& without, osg::Node& with, bool ignoresUpdate) {
    return Comparison(ignoresUpdate).compare(without, with);
}

}  // namespace osgAnalyticBin::test
