// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Memory.h"

#include <osg/NodeVisitor>

#include <algorithm>
#include <cstring>
#include <typeinfo>

namespace osgAnalyticBin::test {

namespace {

bool isOurs(const osg::Object& object) {
    return std::strstr(typeid(object).name(), "osgAnalyticBin") != nullptr;
}

class Finder : public osg::NodeVisitor {
public:
    Finder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    using osg::NodeVisitor::apply;

    void apply(osg::Node& node) override {
        addChain(node.getCullCallback());
        addChain(node.getUpdateCallback());
        traverse(node);
    }

    std::vector<osg::Object*> found;

private:
    void addChain(osg::Callback* first) {
        for (osg::Callback* at = first; at; at = at->getNestedCallback()) {
            if (isOurs(*at)) found.push_back(at);
        }
    }
};

}  // namespace

std::size_t KitObjects::note(osg::Node& scene) {
    Finder finder;
    scene.accept(finder);
    std::sort(finder.found.begin(), finder.found.end());
    finder.found.erase(std::unique(finder.found.begin(), finder.found.end()), finder.found.end());
    for (osg::Object* object : finder.found) {
        osg::observer_ptr<osg::Object>& known = _known[object];
        if (!known.valid()) known = object;
    }
    return finder.found.size();
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
