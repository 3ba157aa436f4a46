// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Copies.h"

#include <osg/Camera>
#include <osg/CopyOp>
#include <osgDB/Registry>

#include <sstream>
#include <stdexcept>

namespace osgAnalyticBin::test {

namespace {

// OSG does not store that a camera computes no near and far planes. Those that it computes follow from what is
// delivered: where a nested camera draws into the depths of the view, other culling shows another picture.
void keepNearAndFar(const osg::Group& scene, osg::Group& loaded) {
    for (unsigned int i = 0; i < scene.getNumChildren(); ++i) {
        const osg::Camera* const from = scene.getChild(i)->asCamera();
        osg::Camera* const to = loaded.getChild(i)->asCamera();
        const bool isOwn = from && !(from->getInheritanceMask() & osg::CullSettings::COMPUTE_NEAR_FAR_MODE);
        if (isOwn && to) to->setComputeNearFarMode(from->getComputeNearFarMode());
    }
}

}  // namespace

osg::ref_ptr<osg::Group> writtenAndRead(const osg::Group& scene, bool asText) {
    const char* const extension = asText ? "osgt" : "osgb";
    osgDB::ReaderWriter* const plugin = osgDB::Registry::instance()->getReaderWriterForExtension(extension);
    if (!plugin) throw std::runtime_error("no plugin for osgb");
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("precision 17");
    options->setPluginStringData("fileType", asText ? "Ascii" : "Binary");
    std::stringstream stream;
    if (!plugin->writeNode(scene, stream, options).success()) throw std::runtime_error("the scene cannot be saved");
    osgDB::ReaderWriter::ReadResult result = plugin->readNode(stream, options);
    osg::Group* const loaded = result.getNode() ? result.getNode()->asGroup() : nullptr;
    if (!loaded) throw std::runtime_error("the scene cannot be loaded");
    keepNearAndFar(scene, *loaded);
    return loaded;
}

osg::ref_ptr<osg::Group> clonedScene(const osg::Group& scene, int variant) {
    constexpr osg::CopyOp::CopyFlags kFlags[] = {osg::CopyOp::DEEP_COPY_NODES | osg::CopyOp::DEEP_COPY_CALLBACKS,
                                                 osg::CopyOp::SHALLOW_COPY, osg::CopyOp::DEEP_COPY_ALL,
                                                 osg::CopyOp::DEEP_COPY_NODES};
    return osg::clone(&scene, osg::CopyOp(kFlags[variant % 4]));
}

}  // namespace osgAnalyticBin::test
