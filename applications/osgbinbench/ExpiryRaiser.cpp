// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ExpiryRaiser.h"

#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osgDB/Registry>
#include <osgTerrain/TerrainTile>

#include <algorithm>

namespace osgAnalyticBin::bench {

namespace {

class ExpiryWalk : public osg::NodeVisitor {
public:
    explicit ExpiryWalk(double seconds) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _seconds(seconds) {
        setNodeMaskOverride(~0U);
    }

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        // One that is traversed before its first update never finds its Terrain.
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }
    void apply(osg::PagedLOD& node) override {
        for (unsigned int i = 0; i < node.getNumFileNames(); ++i)
            if (!node.getFileName(i).empty())
                node.setMinimumExpiryTime(i, std::max(_seconds, node.getMinimumExpiryTime(i)));
        traverse(node);
    }

private:
    double _seconds;
};

}  // namespace

osg::ref_ptr<ExpiryRaiser> ExpiryRaiser::install() {
    const osg::ref_ptr<ExpiryRaiser> raiser = new ExpiryRaiser;
    osgDB::Registry& registry = *osgDB::Registry::instance();
    // A plain callback does what the Registry does by itself.
    raiser->_next = registry.getReadFileCallback();
    if (!raiser->_next) raiser->_next = new osgDB::ReadFileCallback;
    registry.setReadFileCallback(raiser);
    return raiser;
}

osgDB::ReaderWriter::ReadResult ExpiryRaiser::readNode(const std::string& fileName, const osgDB::Options* options) {
    osgDB::ReaderWriter::ReadResult result = _next->readNode(fileName, options);
    ExpiryWalk walk(_seconds);
    if (result.getNode() && _seconds > 0.0) result.getNode()->accept(walk);
    return result;
}

}  // namespace osgAnalyticBin::bench
