// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Memory.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <support/VisitNodes.h>
#include <typeinfo>

namespace osgAnalyticBin::test {

namespace {

bool isOurs(const osg::Object& object) {
    return std::strstr(typeid(object).name(), "osgAnalyticBin") != nullptr;
}

}  // namespace

std::size_t KitObjects::note(osg::Node& scene) {
    std::set<osg::Object*> found;
    visitNodes(scene, [&](osg::Node& node) {
        for (osg::Callback* at : {node.getCullCallback(), node.getUpdateCallback()})
            for (; at; at = at->getNestedCallback())
                if (isOurs(*at)) found.insert(at);
    });
    for (osg::Object* object : found) {
        osg::observer_ptr<osg::Object>& known = _known[object];
        if (!known.valid()) known = object;
    }
    return found.size();
}

std::size_t KitObjects::alive() {
    for (auto entry = _known.begin(); entry != _known.end();) {
        entry = entry->second.valid() ? std::next(entry) : _known.erase(entry);
    }
    return _known.size();
}

std::string KitObjects::kinds() const {
    std::map<std::string, int> counts;
    for (const auto& [address, observed] : _known) {
        osg::ref_ptr<osg::Object> object;
        if (observed.lock(object)) ++counts[object->className()];
    }
    std::string text;
    for (const auto& [name, count] : counts) text += name + " " + std::to_string(count) + "  ";
    return text;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double growthPercent(const std::vector<double>& samples, double whole) {
    if (samples.size() < 20) return 0.0;
    const auto warm = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 5);
    const auto tenth = static_cast<std::ptrdiff_t>(std::max<std::size_t>(samples.size() / 10, 3));
    return 100.0 * (median({samples.end() - tenth, samples.end()}) - median({warm, warm + tenth})) / whole;
}

}  // namespace osgAnalyticBin::test
