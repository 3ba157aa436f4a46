// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What is stored with a tile as text: its bin, and the properties of a cull callback, line by line. Whatever they are,
// a bin holds what its text says, and the callback culls nothing by an invalid one.

#include "Fuzz.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/Group>
#include <osg/Notify>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <sstream>

using namespace osgAnalyticBin;

namespace {

class Reached : public osg::NodeCallback {
public:
    void operator()(osg::Node*, osg::NodeVisitor*) override { isReached = true; }
    bool isReached = false;
};

bool isReached(AnalyticBinCullCallback& callback) {
    const osg::ref_ptr<Reached> reached = new Reached;
    callback.setNestedCallback(reached);
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    tile->setCullCallback(&callback);
    tile->setCullingActive(false);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    visitor->setStateGraph(new osgUtil::StateGraph);
    visitor->setRenderStage(new osgUtil::RenderStage);
    visitor->pushViewport(new osg::Viewport(0, 0, 64, 64));
    visitor->pushProjectionMatrix(new osg::RefMatrix(osg::Matrixd::perspective(30.0, 1.0, 1.0, 1e9)));
    const osg::Matrixd view = osg::Matrixd::lookAt(osg::Vec3d(2e7, 0, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    visitor->pushModelViewMatrix(new osg::RefMatrix(view), osg::Transform::ABSOLUTE_RF);
    tile->accept(*visitor);
    return reached->isReached;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    osg::setNotifyLevel(osg::ALWAYS);
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::array<std::string, 4> text;
    for (std::string& line : text) std::getline(lines, line);

    const AnalyticBin bin = AnalyticBin::fromText(text[0]);
    if (bin.valid()) {
        const AnalyticBin again = AnalyticBin::fromText(bin.toText());
        test::require(again.valid() && again.contains(bin));
    } else {
        test::require(bin.toText().empty());
    }
    const osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback;
    callback->setOptionsText(text[1]);
    callback->setBinText(text[0]);
    if (!text[2].empty()) callback->setRadiiText(text[2]);
    if (!text[3].empty()) callback->setLocalToEcefText(text[3]);
    const bool reached = isReached(*callback);
    if (!callback->getBin().valid()) test::require(reached);
    return 0;
}
