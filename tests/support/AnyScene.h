// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What tests do with any scene.

#pragma once

#include <osg/NodeVisitor>
#include <osgDB/Options>
#include <osgDB/Registry>

#include <sstream>

namespace osgAnalyticBin::test {

/// The scene as it comes back from a file, .osgt or .osgb. Returns: nullptr when it cannot be written or read.
[[nodiscard]] inline osg::ref_ptr<osg::Node> writtenAndRead(const osg::Node& scene, bool asText) {
    osgDB::ReaderWriter* const plugin =
        osgDB::Registry::instance()->getReaderWriterForExtension(asText ? "osgt" : "osgb");
    if (!plugin) return nullptr;
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("precision 17");
    options->setPluginStringData("fileType", asText ? "Ascii" : "Binary");
    std::stringstream stream;
    if (!plugin->writeNode(scene, stream, options).success()) return nullptr;
    return plugin->readNode(stream, options).takeNode();
}

/// Calls `visit(osg::Node&)` with a node and all below it, drawables too, a node before what it holds.
template <class Visit>
void visitNodes(osg::Node& scene, const Visit& visit) {
    class Visitor : public osg::NodeVisitor {
    public:
        explicit Visitor(const Visit& visit) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _visit(visit) {}
        void apply(osg::Node& node) override {
            _visit(node);
            traverse(node);
        }

    private:
        const Visit& _visit;
    };
    Visitor visitor(visit);
    scene.accept(visitor);
}

}  // namespace osgAnalyticBin::test
