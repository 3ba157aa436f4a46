// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Picks.h"

#include <osg/Geode>
#include <osg/LOD>
#include <osg/Transform>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>

#include <sstream>

namespace osgAnalyticBin::test {

namespace {

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
    for (const osg::Node* node : hit.nodePath) {
        if (!node->getName().empty() && node->getName().front() == '#') text << node->getName();
    }
    const osg::Vec3d at = hit.getWorldIntersectPoint();
    text << " at " << at.x() << " " << at.y() << " " << at.z();
    return text.str();
}

}  // namespace

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
